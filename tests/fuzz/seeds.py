#!/usr/bin/env python3
"""seeds.py FOLDER: tiny good files for the fuzz targets to start from, in FOLDER/<target>/, and what words the JSON readers
know, in FOLDER/words.dict, from the committed schemas. JSON seeds are the examples and the bad files of the tests."""
import json
import os
import shutil
import struct
import sys
import zlib

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def radiance_pictures():
    head = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n"
    pixels = bytes((128, 64, 32, 129)) * 6
    yield head + b"-Y 2 +X 3\n" + pixels
    yield head + b"+Y 2 -X 3\n" + pixels[:8] + b"\x01\x01\x01\x04" + pixels[:4]  # the old run: the pixel before, four times
    row = b"\x02\x02\x00\x08" + b"".join(bytes((128 + 8, v)) for v in (10, 20, 30)) + b"\x08" + bytes(range(120, 128))
    yield head + b"-Y 2 +X 8\n" + row * 2


def exr_picture(compression):
    def attribute(name, kind, value):
        return name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value

    width, height = 3, 2
    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute(b"channels", b"chlist", channels)
    header += attribute(b"compression", b"compression", bytes((compression,)))
    header += attribute(b"dataWindow", b"box2i", window) + attribute(b"displayWindow", b"box2i", window)
    header += attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    rows = [struct.pack("<9f", *[0.5 + y] * 9) for y in range(height)]
    if compression:  # ZIPS, a row at a time: bytes split into halves, differences, deflate
        def packed(row):
            halves = row[0::2] + row[1::2]
            steps = bytes([halves[0]] + [(b - a + 384) % 256 for a, b in zip(halves, halves[1:])])
            return zlib.compress(steps)
        rows = [packed(row) if len(packed(row)) < len(row) else row for row in rows]
    body, table = b"", b""
    for y, row in enumerate(rows):
        table += struct.pack("<Q", len(header) + 8 * height + len(body))
        body += struct.pack("<ii", y, len(row)) + row
    return header + table + body


def png():
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(bytes((y,)) + bytes(range(9)) for y in (0, 1))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 3, 2, 8, 2, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def gltf_files():
    positions = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    binary = positions + struct.pack("<3H2x", 0, 1, 2)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [0, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "emissiveFactor": [1, 1, 1]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"},
            {"componentType": 5126, "count": 3, "type": "VEC2", "sparse": {
                "count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 8}],
        "buffers": [{"byteLength": 44}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(binary), 0x004E4942) + binary
    yield b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="
    yield json.dumps(document).encode()


def words_of(schema, words):
    if isinstance(schema, dict):
        words.update(schema.get("properties", {}))
        words.update(w for w in schema.get("enum", []) + [schema.get("const")] if isinstance(w, str))
        for value in schema.values():
            words_of(value, words)
    elif isinstance(schema, list):
        for value in schema:
            words_of(value, words)


def main():
    folder = sys.argv[1]

    def put(target, name, data):
        os.makedirs(os.path.join(folder, target), exist_ok=True)
        with open(os.path.join(folder, target, name), "wb") as file:
            file.write(data)

    for target, files in (("radiance", radiance_pictures()), ("exr", (exr_picture(c) for c in (0, 2))), ("picture", [png()]),
                          ("gltf", gltf_files())):
        for i, data in enumerate(files):
            put(target, "seed%d" % i, data)
    for target in ("medium", "scene"):
        for top in ("examples", "presets", os.path.join("tests", "bad")):
            for path, _, names in os.walk(os.path.join(ROOT, top)):
                for name in names:
                    if name.endswith(".%s.json" % target):
                        os.makedirs(os.path.join(folder, target), exist_ok=True)
                        shutil.copy(os.path.join(path, name), os.path.join(folder, target, name))
    # Each example over the one before, as variants that keep, replace and take away.
    media = os.path.join(ROOT, "examples", "media")
    names = sorted(name for name in os.listdir(media) if name.endswith(".medium.json"))
    for i, name in enumerate(names):
        with open(os.path.join(media, name), encoding="utf-8") as file, open(os.path.join(media, names[i - 1]), "rb") as base:
            variant = {"base": "base.medium.json", **{k: v for k, v in json.load(file).items() if k != "name"}, "description": None}
            put("variant", name, base.read() + b"\0" + json.dumps(variant).encode())
    with open(os.path.join(media, "cloud_c1.csv"), "rb") as file:
        put("rows", "cloud", b"".join(file.readlines()[:8]))
    for i, text in enumerate((b"0;1\r\n180;2\r\n", b"a b\n0 1\n\n#\n1e2 -2.5e-3\n", b"1,2,3,4\n")):
        put("rows", "seed%d" % i, text)
    words = {name[: -len(".medium.json")] for name in os.listdir(os.path.join(ROOT, "presets"))} | {"base", "base.medium.json"}
    for name in ("medium", "scene"):
        with open(os.path.join(ROOT, "schema", "tyndall-%s-1.schema.json" % name), encoding="utf-8") as file:
            words_of(json.load(file), words)
    with open(os.path.join(folder, "words.dict"), "w", encoding="utf-8") as file:
        for word in sorted(words):
            file.write('"\\"%s\\""\n' % word)
        for token in ("1e999", "-0", "1e-320", "1e308", "null", "true", "[[[[", "\\\\ud800", "\\xef\\xbb\\xbf", "NaN", "//"):
            file.write('"%s"\n' % token)


if __name__ == "__main__":
    main()
