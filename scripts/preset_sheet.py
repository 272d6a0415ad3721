#!/usr/bin/env python3
"""Writes docs/pictures/presets.png and docs/presets.md from the presets.

Both come from the program: the picture is one scene rendered in each preset, the page is what `presets --json` says.
--page writes the page only, --check says whether it is current. The standard library only.

Presets differ in scale from steam to the air of a planet, so the scene is as large as the preset's visibility in green: its
unit is a hundredth of it. Pillars stand 8, 14, 26, 50 and 100 units away (so the last one is at the visibility), a lamp 18, in a layer
14 units deep under sun and sky.
"""
import argparse
import concurrent.futures
import json
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path[:0] = [os.path.join(ROOT, "scripts"), os.path.join(ROOT, "examples", "geometry")]
import contact_sheet  # noqa: E402
import glb  # noqa: E402
import mesh  # noqa: E402
import small_letters  # noqa: E402

WIDTH, HEIGHT, COLUMNS, GAP, CAPTION = 336, 190, 4, 10, 30
GREY, WHITE, DIM = (32, 32, 34), (235, 235, 235), (150, 150, 155)
# From what is clear to what is thick, by what it is made of.
ORDER = """clear_air standard_air mountain_air mars light_haze sea_haze haze mist
  moderate_radiation_fog radiation_fog moderate_advection_fog advection_fog rain steam dust sand
  smog smoke black_smoke note_w000 note_w025 note_w050 note_w075 note_w100 coastal_water murky_water""".split()


def presets(program):
    done = subprocess.run([program, "presets", "--json"], check=True, capture_output=True, text=True)
    entries = {entry["preset"]: entry for entry in json.loads(done.stdout)["presets"]}
    return [entries[name] for name in ORDER if name in entries] + [e for n, e in sorted(entries.items()) if n not in ORDER]


def length(metres):
    if metres >= 1000:
        return "%.3g km" % (metres / 1000)
    return "%.3g m" % metres


def geometry():
    """The pillars, the lamp and the ground, in units of a hundredth of the visibility."""
    stone = mesh.Material("stone", (0.36, 0.30, 0.25))
    dark = mesh.Material("dark", (0.06, 0.06, 0.065))
    ground = mesh.Material("ground", (0.19, 0.19, 0.17))
    lamp = mesh.Material("lamp", (0.8, 0.8, 0.8), radiance=(120.0, 76.0, 36.0))
    scene = mesh.Mesh("scene")
    scene.quad(ground, (-400.0, 0.0, 60.0), (400.0, 0.0, 60.0), (400.0, 0.0, -500.0), (-400.0, 0.0, -500.0))
    for number, (x, z) in enumerate([(-3.0, 8.0), (-2.1, 14.0), (0.4, 26.0), (6.0, 50.0), (22.0, 100.0)]):
        half, high = 0.42 + 0.018 * z, 3.9 + 0.075 * z
        material = stone if number % 2 == 0 else dark
        scene.box(material, (x - half, 0.0, -z - half), (x + half, high, -z + half))
    scene.turned(dark, [(0.07, 0.0), (0.07, 3.2)], 12, (4.0, -18.0))
    radius, steps = 0.36, 8
    centre = 3.2 + radius
    points = [(-1.0, 0.0), (-0.924, 0.383), (-0.707, 0.707), (-0.383, 0.924), (0.0, 1.0), (0.383, 0.924), (0.707, 0.707),
              (0.924, 0.383), (1.0, 0.0)]  # yapf: disable
    scene.turned(lamp, [(radius * out, centre + radius * up) for up, out in points], 2 * steps, (4.0, -18.0))
    document = glb.Document("presets")
    document.node("scene", mesh=scene)
    return document.to_bytes()


def scene_in(preset):
    unit = preset["visibility_5"][1] / 100.0
    return {
        "format": "tyndall-scene/1", "meters_per_unit": unit,
        "geometry": [{"file": "presets.glb", "meters_per_unit": unit}],
        "volumes": [{"medium": preset["preset"],
                     "profile": {"law": "box", "min": [-300, -1, -400], "max": [300, 14, 50]}}],
        "lights": [{"type": "sun", "direction": [-0.75, -0.5, 0.45], "irradiance": [9.5, 8.6, 7.2], "angular_diameter": 0.53},
                   {"type": "environment", "radiance": [0.38, 0.55, 0.9]}],
        "camera": {"position": [0, 2.1, 0], "look_at": [0.3, 2.7, -10], "up": [0, 1, 0], "vertical_fov": 34},
        "film": {"width": WIDTH, "height": HEIGHT},
        "integrator": {"name": "path"},
    }  # yapf: disable


def picture(program, folder, preset, spp):
    path = os.path.join(folder, preset["preset"])
    with open(path + ".scene.json", "w", encoding="utf-8") as file:
        json.dump(scene_in(preset), file)
    subprocess.run([program, "render", path + ".scene.json", "--spp", str(spp), "--quiet", "--threads", "1", "--exposure", "-1.1", "-o", path + ".png"],
                   check=True)  # yapf: disable
    return contact_sheet.read_png(path + ".png")[2]


def draw_sheet(program, entries, spp):
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "presets.glb"), "wb") as file:
            file.write(geometry())
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            pictures = list(pool.map(lambda preset: picture(program, folder, preset, spp), entries))
    lines = -(-len(entries) // COLUMNS)
    wide, high = COLUMNS * (WIDTH + GAP) + GAP, lines * (HEIGHT + CAPTION + GAP) + GAP
    sheet = [bytearray(bytes(GREY) * wide) for _ in range(high)]
    for index, (entry, rows) in enumerate(zip(entries, pictures)):
        left = GAP + index % COLUMNS * (WIDTH + GAP)
        top = GAP + index // COLUMNS * (HEIGHT + CAPTION + GAP)
        for y, row in enumerate(rows):
            sheet[top + y][3 * left : 3 * (left + WIDTH)] = row
        seen = length(entry["visibility_5"][1])
        small_letters.write(sheet, entry["preset"], left, top + HEIGHT + 8, 2, WHITE)
        right = left + WIDTH - small_letters.WIDTH * 2 * len(seen)
        small_letters.write(sheet, seen, right, top + HEIGHT + 8, 2, DIM)
    path = os.path.join(ROOT, "docs", "pictures", "presets.png")
    contact_sheet.write_png(path, wide, [bytes(row) for row in sheet])
    print(path)


def cell(text):
    return text.replace("|", "\\|").replace("<", "&lt;")


def page(entries):
    out = [
        "# Presets",
        "",
        "Media that come with Tyndall. Their names stand for a medium wherever one is asked for (`tyndall show haze`, `render --medium",
        "haze`, `\"medium\": \"haze\"` in a scene), and as the `base` of a file of one's own ([files.md](files.md#variants-base)). `tyndall",
        "presets` lists them, `tyndall presets haze` prints the file. Written by `scripts/preset_sheet.py build/tyndall` from the files in",
        "`presets/`; do not edit.",
        "",
        "![Each preset in the same scene](pictures/presets.png)",
        "",
        "One scene for all, as large as each preset's visibility (the grey number): pillars at 8, 14, 26, 50 and 100 % of it, a lamp at 18 %,",
        "in a layer 14 % deep under sun and sky, the same exposure throughout.",
        "",
        "| preset | visibility | what |",
        "|---|---|---|",
    ]
    for entry in entries:
        out.append("| `%s` | %s | %s: %s |" % (
            entry["preset"], length(entry["visibility_5"][1]), cell(entry["name"]), cell(entry["description"])))
    out += ["", "Visibility: 5 % contrast, at 550 nm (green), at the origin.", "", "## Sources", ""]
    out.append("Value and unit as the source has them; what is our own choice says so.")
    for entry in entries:
        out += ["", "### %s" % entry["preset"], "", "| number | value | at | source |", "|---|---|---|---|"]
        for source in entry["sources"]:
            number = source.get("value")
            value = "" if number is None else numbers(number) + " " + source["unit"] if source["unit"] != "1" else numbers(number)
            at = numbers(source["wavelength_nm"]) + " nm" if "wavelength_nm" in source else ""
            out.append("| `%s` | %s | %s | %s |" % (source["of"], value, at, cell(source["source"])))
    return "\n".join(out) + "\n"


def numbers(value):
    values = value if isinstance(value, list) else [value]
    if len(set(values)) == 1:
        values = values[:1]
    return ", ".join(re.sub(r"e([+-])0*", r"e\1", "%.6g" % x) for x in values)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="build/tyndall")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 where the page is not current")
    parser.add_argument("--page", action="store_true", help="write the page only")
    parser.add_argument("--spp", type=int, default=256, help="samples per pixel of the picture (default 256)")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    entries = presets(program)
    path = os.path.join(ROOT, "docs", "presets.md")
    text = page(entries)
    if arguments.check:
        with open(path, encoding="utf-8") as file:
            if file.read() != text:
                sys.exit("preset_sheet: docs/presets.md is not current; to write it anew: scripts/preset_sheet.py build/tyndall")
        return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    if not arguments.page:
        draw_sheet(program, entries, arguments.spp)


if __name__ == "__main__":
    main()
