#!/usr/bin/env python3
"""Reads the scanline float pictures that the program writes (OpenEXR 2, ZIP compression). Standard library only.

As a program it prints the mean and the largest value of each channel.
"""
import argparse
import struct
import zlib
from array import array


def read(path):
    """(width, height, {channel name: array of floats, row by row from the top})."""
    with open(path, "rb") as file:
        data = file.read()
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError("%s: not an OpenEXR file" % path)
    at, attributes = 8, {}
    while data[at] != 0:
        end = data.index(0, at)
        name = data[at:end].decode()
        kind_end = data.index(0, end + 1)
        (size,) = struct.unpack_from("<i", data, kind_end + 1)
        attributes[name] = data[kind_end + 5 : kind_end + 5 + size]
        at = kind_end + 5 + size
    at += 1
    channels, raw, k = [], attributes["channels"], 0
    while raw[k] != 0:
        end = raw.index(0, k)
        if struct.unpack_from("<i", raw, end + 1)[0] != 2:
            raise ValueError("%s: only float channels" % path)
        channels.append(raw[k:end].decode())
        k = end + 17
    if attributes["compression"][0] not in (0, 2, 3):
        raise ValueError("%s: only ZIP compression" % path)
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    lines = {0: 1, 2: 1, 3: 16}[attributes["compression"][0]]
    planes = {name: array("f", bytes(4 * width * height)) for name in channels}
    blocks = (height + lines - 1) // lines
    for offset in struct.unpack_from("<%dQ" % blocks, data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        rows = min(lines, y1 + 1 - y)
        expected = 4 * width * rows * len(channels)
        block = data[offset + 8 : offset + 8 + size]
        if size < expected:
            block = unpredict(zlib.decompress(block))
        numbers = array("f")
        numbers.frombytes(block)
        k = 0
        for row in range(y - y0, y - y0 + rows):
            for name in channels:
                planes[name][row * width : (row + 1) * width] = numbers[k : k + width]
                k += width
    return width, height, planes


def unpredict(block):
    """Undoes OpenEXR's byte differences and the split into even and odd bytes."""
    out, total = bytearray(len(block)), 0
    total = block[0]
    sums = bytearray([total])
    for byte in block[1:]:
        total = (total + byte - 128) & 255
        sums.append(total)
    half = (len(block) + 1) // 2
    out[0::2] = sums[:half]
    out[1::2] = sums[half:]
    return bytes(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("picture", help="an .exr that tyndall wrote")
    width, height, planes = read(parser.parse_args().picture)
    print("%d x %d" % (width, height))
    for name, values in sorted(planes.items()):
        print("%-16s mean %-12.6g largest %.6g" % (name, sum(values) / len(values), max(values)))


if __name__ == "__main__":
    main()
