#!/usr/bin/env python3
"""plots_test.py PROGRAM: SVG plots are well-formed XML whatever media are called, and their curves are what the program prints.

An XML parser of its own reads them: names with quotes, tags, control characters, marks that turn writing round, invalid UTF-8.
"""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

SVG = "{http://www.w3.org/2000/svg}"
NAMES = [
    "Quotes \" ' & <b> </script> ]]> <!-- -->", "</text><script>alert(1)</script>", "\u05e9\u05dc\u05d5\u05dd fog", "\u4e0a\u6d77\u306e\u9727",
    "long " * 200, "control \u0001\u001b[31m\u202eabc\u0085", "Z" + "\u0300" * 60, "\ufffe\uffff\U0001fffe \ufdd0", "", "&amp;", "\u2028",
]  # yapf: disable
FILE_NAMES = [b"\xff\xfe.medium.json", b"<a b='c'>\".medium.json", b"line\nbreak.medium.json", b"\xed\xa0\x80.medium.json"]


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, check=False)
    assert done.returncode == 0, (arguments, done.returncode, done.stderr)
    return done.stdout


def draw(program, folder, *arguments):
    out = os.path.join(folder, "out.svg")
    run(program, "plot", *arguments, "-o", out)
    return ElementTree.parse(out).getroot()


def medium(folder, file_name, name):
    path = os.path.join(os.fsencode(folder), file_name)
    content = {"format": "tyndall-medium/1", "species": [{"name": name or "x", "scattering": [0.01, 0.02, 0.04], "absorption": 0.001}]}
    if name is not None:
        content["name"] = name
    with open(path, "w", encoding="utf-8") as file:
        json.dump(content, file)
    return path


def names_are_data(program, folder):
    files = [medium(folder, b"%d.medium.json" % i, name) for i, name in enumerate(NAMES)]
    files += [medium(folder, name, None) for name in FILE_NAMES]
    for path in files:
        root = draw(program, folder, path, "--species")
        allowed = {"svg", "title", "rect", "g", "path", "circle", "text"}
        assert {element.tag.removeprefix(SVG) for element in root.iter()} <= allowed, path
        for element in root.iter():
            assert not any(key.startswith("on") or "href" in key or key == "id" for key in element.attrib), (path, element.attrib)
    draw(program, folder, *files[:8])
    shown = "".join(text.text for text in draw(program, folder, files[1]).iter(SVG + "text"))
    assert "</text><script>alert(1)</script>" in shown


def axis(words):
    kind, low, high, begin, end = words.split()
    low, high, begin, end = map(float, (low, high, begin, end))

    def value(at):
        share = (at - begin) / (end - begin)
        return low * (high / low)**share if kind == "log" else low + share * (high - low)

    return value


def curves(root):
    """(x axis, y axis, attributes, points) of every curve with two axes."""
    axes = None
    for group in root.iter(SVG + "g"):
        if group.get("class") == "frame":
            axes = (axis(group.get("data-x-axis")), axis(group.get("data-y-axis"))) if group.get("data-x-axis") else None
        for path in group.iter(SVG + "path"):
            if path.get("class") == "curve" and axes:
                points = [tuple(map(float, p.split(","))) for p in path.get("d").strip("MZ").replace("L", " ").split()]
                yield *axes, path.attrib, points


def density_is_what_phase_prints(program, folder, subject, log):
    root = draw(program, folder, subject, "--what", "phase", *(["--log"] if log else []))
    checked = 0
    for x_axis, y_axis, attributes, points in curves(root):
        channel = ["red", "green", "blue"].index(attributes["data-channel"])
        half = 0.0006  # a coordinate's rounding, in both directions
        angles = [min(180.0, max(0.0, x_axis(x + d))) for x, _ in points for d in (-half, 0, half)]
        mus = ",".join(repr(math.cos(math.radians(angle))) for angle in angles)
        densities = json.loads(run(program, "phase", subject, "--at=" + mus, "--json"))["density"]
        densities = [p[channel] if isinstance(p, list) else p for p in densities]
        for i, (_, y) in enumerate(points):
            near = densities[3 * i:3 * i + 3]
            # cos() of a small angle knows it to 1e-16 / angle^2 only.
            slack = 1e-6 + 1e-15 / max(1e-12, math.radians(angles[3 * i + 1]))**2
            assert min(near) * (1 - slack) <= y_axis(y - half) and y_axis(y + half) <= max(near) * (1 + slack), (subject, angles[3 * i + 1])
            checked += 1
    assert checked > 0, subject
    return checked


def transmittance_is_what_show_prints(program, folder, path):
    extinction = json.loads(run(program, "show", path, "--json"))["extinction"]
    checked = 0
    for x_axis, y_axis, attributes, points in curves(draw(program, folder, path, "--what", "transmittance")):
        sigma = extinction[["red", "green", "blue"].index(attributes["data-channel"])]
        for x, y in points:
            assert abs(y_axis(y) - 100 * math.exp(-sigma * x_axis(x))) < 0.01, (x, y)  # visibilities under a kilometre: metres
            checked += 1
    assert checked > 30, checked


def pictures_of_the_page_are_what_its_commands_write(program, folder):
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    with open(os.path.join(root, "docs/plots.md"), encoding="utf-8") as file:
        commands = re.findall(r"^build/tyndall (plot .* -o )(docs/.*)$", file.read(), re.MULTILINE)
    assert len(commands) == 2, commands
    for arguments, picture in commands:
        out = os.path.join(folder, "picture.svg")
        words = [os.path.join(root, w) if w.startswith("examples/") else w for w in arguments.split()]
        run(program, *words, out)
        with open(out, "rb") as new, open(os.path.join(root, picture), "rb") as old:
            assert new.read() == old.read(), picture + " is not what its command in docs/plots.md writes: run it again"


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        names_are_data(program, folder)
        pictures_of_the_page_are_what_its_commands_write(program, folder)
        coloured = medium(folder, b"coloured.medium.json", "Coloured")
        fog = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "examples/media/harbour_fog.medium.json")
        points = 0
        for subject in ("isotropic", "rayleigh", "mie_murky", "henyey_greenstein:g=0.9999", "henyey_greenstein:g=-0.9", fog):
            for log in (False, True):
                points += density_is_what_phase_prints(program, folder, subject, log)
        transmittance_is_what_show_prints(program, folder, coloured)
    print("plots: %d names, %d points of phase functions" % (len(NAMES) + len(FILE_NAMES), points))


main()
