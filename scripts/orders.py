#!/usr/bin/env python3
"""Writes docs/orders.md: how much of the three example scenes' light is scattered more than once.

    python3 scripts/orders.py build/tyndall

Each scene is rendered in four airs, whose extinction is chosen so that the optical depth over the scene's typical view is about
0.3, 1, 3 and 10: by `path` (all orders; several seeds, whose spread gives the errors) and by `single` (one scattering). Standard
library only.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
import exr  # noqa: E402  (beside this script)

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "examples")
DEPTHS = (0.3, 1, 3, 10)
SIZE, SAMPLES, SEEDS = (96, 54), 32, 4
SINGLE_SIZE = (32, 18)  # exact, but slow where many windows shine
# How far one typically looks through each scene's air [m], and the profile of that air.
VIEWS = {
    "street": (100.0, {"law": "exponential", "scale_height": 40}),
    "room": (12.0, None),
    "landscape": (10000.0, {"law": "exponential", "scale_height": 1000}),
}
LUMINANCE = (0.2126, 0.7152, 0.0722)


def scene_in(name, depth, folder):
    """A copy of the scene with the air of that depth, in `folder`."""
    with open(os.path.join(EXAMPLES, name + ".scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    view, profile = VIEWS[name]
    conditions = {"model": "simple", "w": 0.7, "thickness": depth / view}
    if profile:
        conditions["profile"] = profile
    background = {"air": "note", "profile": {"law": "exponential", "scale_height": 8000}}
    medium = {"format": "tyndall-medium/1", "background": background, "conditions": conditions}
    scene["geometry"] = [os.path.relpath(os.path.join(EXAMPLES, g), folder) for g in scene["geometry"]]
    if scene.get("volumes"):
        for volume in scene["volumes"]:
            volume["medium"] = medium
        scene.pop("medium", None)
    else:
        scene["medium"] = medium
    path = os.path.join(folder, name + ".scene.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(scene, file)
    return path


def render(program, scene, integrator, size, seed):
    out = os.path.splitext(scene)[0] + ".exr"
    subprocess.run([program, "render", scene, "--allow-path", "--quiet", "--integrator", integrator, "--size", "%dx%d" % size, "--spp",
                    str(SAMPLES), "--seed", str(seed), "-o", out], check=True, stdout=subprocess.DEVNULL)
    return exr.read(out)[2]


def mean(planes, layer):
    return [math.fsum(planes[layer + c]) / len(planes[layer + c]) for c in "RGB"]


def luminance(rgb):
    return sum(a * b for a, b in zip(LUMINANCE, rgb))


def average(colors):
    return [sum(c) / len(colors) for c in zip(*colors)]


def color(rgb):
    """Red and blue over green."""
    return "%.2f : 1 : %.2f" % (rgb[0] / rgb[1], rgb[2] / rgb[1]) if rgb[1] > 0 else "-"


def share(parts, wholes):
    """sum(parts) / sum(wholes) in luminance, and its standard error from the spread of the runs (delta method)."""
    a, b = [luminance(p) for p in parts], [luminance(w) for w in wholes]
    ratio, n = sum(a) / sum(b), len(a)
    spread = math.sqrt(sum((x - ratio * y) ** 2 for x, y in zip(a, b)) / (n * (n - 1))) / (sum(b) / n)
    return ratio, spread


def percent(ratio, error):
    return "%.1f ± %.1f %%" % (100 * ratio, 100 * error)


def row(program, name, depth, folder):
    scene = scene_in(name, depth, folder)
    runs = [render(program, scene, "path", SIZE, seed) for seed in range(1, SEEDS + 1)]
    all_light, first, later = ([mean(run, layer) for run in runs] for layer in ("", "single.", "multiple."))
    scattered = [[a + b for a, b in zip(f, l)] for f, l in zip(first, later)]
    exact = [mean(render(program, scene, "single", SINGLE_SIZE, 1), "single.")] * SEEDS
    return "| %s | %g | %s | %s | %s | %s | %.3f ± %.3f |" % (
        name, depth, percent(*share(later, all_light)), percent(*share(later, scattered)), color(average(first)), color(average(later)),
        *share(exact, scattered))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(HERE, "..", "build", "tyndall"), help="default: build/tyndall")
    program = os.path.abspath(parser.parse_args().program)
    lines = [
        "# How much light is scattered more than once", "",
        "Made by `python3 scripts/orders.py build/tyndall`: the example scenes at %dx%d by `path` with %d times %d samples, in air of the" % (*SIZE, SEEDS, SAMPLES),
        "simple model at w = 0.7 with albedo 1. tau is the optical depth over the view: 100 m of street (scale height 40 m), 12 m of room,",
        "10 km of landscape (scale height 1 km), at the ground. Shares are of mean luminance, ± one standard error of `path`; `single` is",
        "without noise, of %dx%d of the same view." % SINGLE_SIZE,
        "\"Later\" is the layer `multiple`: two or more scatterings, or scattering and surface together. Colours are red : green : blue.", "",
        "| scene | tau | later, of all light | later, of scattered light | colour of one scattering | colour of later ones | `single` over all scattered light |",
        "|---|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        for name in VIEWS:
            for depth in DEPTHS:
                lines.append(row(program, name, depth, folder))
                print(lines[-1], flush=True)
    lines += ["", "A preview that stops at one scattering lacks the fourth column, and in the colour of the sixth: what an approximation of the",
              "later orders has to supply.", ""]
    os.makedirs(os.path.join(HERE, "..", "docs"), exist_ok=True)
    with open(os.path.join(HERE, "..", "docs", "orders.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
