#!/usr/bin/env python3
"""race_cycles.py [PROGRAM] [SCENE ...]: the program's integrator `path` against Blender's Cycles, for the same time on the same processors.

    apt-get install blender        (Debian 12: Blender 3.4)
    python3 scripts/race_cycles.py build/tyndall                      four scenes, 60 s for each of eight pictures and once more: 18 minutes
    python3 scripts/race_cycles.py build/tyndall cloud --seconds 20
    python3 scripts/race_cycles.py build/tyndall --folder race --sheet docs/pictures/cycles.png

Scenes: spot, bank, cloud and lamps (examples/bench/make_scenes.py, examples/cloud.scene.json), 512 x 512, two threads. Each renderer makes
two pictures a and b of different seeds. Both are unbiased but for how Cycles steps through grids, so half the squared difference of two
pictures is the squared error of one, without a reference that one of them would have to make:

    relMSE = mean((a - b)^2 / 2 / (r^2 + 0.01 m^2)),   r: Tyndall's two pictures averaged over 3 x 3 pixels, m: their mean

over all pixels and channels, and without the worst 0.1 % of pixels (each renderer's own). It falls as 1 / time, so the ratio of two figures
is that of the times to one error. Fireflies that no picture happened to have are not counted: heavy tails look better than they are. The last
column is how much brighter Cycles is: medians over blocks of 32 x 32 pixels, then the median of their ratios; surfaces differ a little
(scripts/cycles_scene.py), and where Cycles' noise is sparks medians see less than there is. --sheet puts side by side, of each scene:
Tyndall's pictures, Cycles', and their difference over blocks of 8 x 8 pixels, blue where Cycles is darker and red where it is brighter, full
at 20 % of the mean of both and a fiftieth of the picture's mean. Needs python3-numpy. --folder keeps the pictures.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy
except ImportError:
    numpy = None

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "examples")
sys.path.insert(0, os.path.join(EXAMPLES, "bench"))
import contact_sheet  # noqa: E402  (beside this script)
import exr  # noqa: E402
import make_scenes  # noqa: E402

# Where Blender has to end a medium without bounds: outside the room's walls.
BOUNDS = {"spot": ["--bounds=-5.5,-0.5,-5.5,5.5,6.5,5.5"]}
NAMES = ("spot", "bank", "cloud", "lamps")


def picture(path):
    width, height, planes = exr.read(path)
    return numpy.stack([numpy.array(planes[c], dtype=float).reshape(height, width) for c in "RGB"], -1)


def smoothed(p):
    around = numpy.pad(p, ((1, 1), (1, 1), (0, 0)), mode="edge")
    return sum(around[y:y + p.shape[0], x:x + p.shape[1]] for y in range(3) for x in range(3)) / 9.0


def errors(a, b, reference):
    """relMSE of all pixels, and without the worst 0.1 %."""
    per_pixel = numpy.sort(((a - b) ** 2 / 2.0 / (reference**2 + 0.01 * reference.mean() ** 2)).mean(-1).ravel())
    return per_pixel.mean(), per_pixel[:len(per_pixel) - len(per_pixel) // 1000].mean()


def codes(p):
    """8-bit sRGB of linear RGB, bright parts rolled off by x / (1 + x)."""
    p = p / (1.0 + p)
    return (255.0 * numpy.where(p <= 0.0031308, 12.92 * p, 1.055 * numpy.maximum(p, 1e-9) ** (1.0 / 2.4) - 0.055) + 0.5).astype(numpy.uint8)


def difference(ours, theirs, edge=8):
    """The picture that --sheet shows last."""
    means = [p.sum(-1)[:p.shape[0] // edge * edge, :p.shape[1] // edge * edge].reshape(p.shape[0] // edge, edge, -1, edge).mean((1, 3))
             for p in (ours, theirs)]
    share = (means[1] - means[0]) / (0.5 * (means[0] + means[1]) + 0.02 * means[0].mean()) / 0.2
    share = numpy.clip(share, -1.0, 1.0).repeat(edge, 0).repeat(edge, 1)
    white = 1.0 - numpy.abs(share)
    return (255.0 * numpy.stack([numpy.where(share > 0.0, 1.0, white), white, numpy.where(share < 0.0, 1.0, white)], -1)).astype(numpy.uint8)


def write_sheet(path, rows):
    gap, height = contact_sheet.GAP, rows[0][0].shape[0]
    width = len(rows[0]) * (rows[0][0].shape[1] + gap) + gap
    sheet = numpy.full((len(rows) * (height + gap) + gap, width, 3), contact_sheet.GREY, dtype=numpy.uint8)
    for y, row in enumerate(rows):
        for x, p in enumerate(row):
            sheet[gap + y * (height + gap):, gap + x * (p.shape[1] + gap):][:height, :p.shape[1]] = p
    contact_sheet.write_png(path, width, [line.tobytes() for line in sheet])


def blocks(p, edge=32):
    p = p.sum(-1)[:p.shape[0] // edge * edge, :p.shape[1] // edge * edge]
    grid = p.reshape(p.shape[0] // edge, edge, p.shape[1] // edge, edge).transpose(0, 2, 1, 3)
    return numpy.median(grid.reshape(grid.shape[0], grid.shape[1], -1), -1)


def scene_files(folder):
    made = make_scenes.write(os.path.join(folder, "scenes"))
    cloud = os.path.join(folder, "scenes", "cloud.scene.json")
    shutil.copy(os.path.join(EXAMPLES, "cloud.scene.json"), cloud)
    os.makedirs(os.path.join(folder, "scenes", "media"), exist_ok=True)
    shutil.copy(os.path.join(EXAMPLES, "media", "cumulus.vdb"), os.path.join(folder, "scenes", "media"))
    return dict(made, cloud=cloud)


def run(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        sys.exit("race_cycles: %s\n%s" % (" ".join(command), done.stdout[-2000:]))


def main():
    parser = argparse.ArgumentParser(description="Race the program against Blender's Cycles.")
    parser.add_argument("program", nargs="?", default="build/tyndall")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--folder")
    parser.add_argument("--sheet", metavar="OUT.png")
    arguments = parser.parse_args()
    names = arguments.scenes or NAMES
    if not set(names) <= set(NAMES):
        parser.error("scenes are " + ", ".join(NAMES))
    if numpy is None:
        sys.exit("race_cycles: no numpy for this Python (Debian: apt-get install python3-numpy)")
    if not shutil.which("blender"):
        sys.exit("race_cycles: no blender on this machine (Debian: apt-get install blender)")
    folder = arguments.folder or tempfile.mkdtemp()
    os.makedirs(folder, exist_ok=True)
    files = scene_files(folder)
    print("%g s, %s, %d threads" % (arguments.seconds, arguments.size, arguments.threads))
    print("| scene | Tyndall | without the worst 0.1 % | Cycles | without the worst 0.1 % | ratio | ratio without | Tyndall's seconds to 0.01 | Cycles / Tyndall |")
    print("|---|---|---|---|---|---|---|---|---|")
    sheet = []
    for name in names:
        pictures = {"tyndall": [], "cycles": []}
        for seed in (1, 2):
            for renderer in pictures:
                out = os.path.join(folder, "%s.%s.%d.exr" % (name, renderer, seed))
                common = [files[name], "--size", arguments.size, "--seconds", str(arguments.seconds), "--seed", str(seed),
                          "--threads", str(arguments.threads)]
                if renderer == "tyndall":
                    run([arguments.program, "render"] + common + ["--spp", "1000000", "--quiet", "-o", out])
                else:
                    run(["blender", "-b", "--factory-startup", "--python", os.path.join(HERE, "cycles_scene.py"), "--"] + common[:1] +
                        [out] + common[1:] + BOUNDS.get(name, []))
                pictures[renderer].append(picture(out))
        reference = smoothed(sum(pictures["tyndall"]) / 2.0)
        (ours, ours_kept), (theirs, theirs_kept) = (errors(*pictures[r], reference) for r in ("tyndall", "cycles"))
        brighter = numpy.median(blocks(sum(pictures["cycles"])) / blocks(sum(pictures["tyndall"]))) - 1.0
        print("| %s | %.2g | %.2g | %.2g | %.2g | %.1f | %.1f | %.0f | %+.1f %% |" %
              (name, ours, ours_kept, theirs, theirs_kept, theirs / ours, theirs_kept / ours_kept, arguments.seconds * ours_kept / 0.01,
               100.0 * brighter), flush=True)
        means = [sum(pictures[r]) / 2.0 for r in ("tyndall", "cycles")]
        exposure = 0.5 / max(numpy.median(means[0]), 0.05 * means[0].mean())
        # Half the size: 2 x 2 pixels make one.
        small = [p[::2, ::2] / 4.0 + p[1::2, ::2] / 4.0 + p[::2, 1::2] / 4.0 + p[1::2, 1::2] / 4.0 for p in means]
        sheet.append([codes(p * exposure) for p in small] + [difference(*means)[::2, ::2]])
    if arguments.sheet:
        write_sheet(arguments.sheet, sheet)
    if not arguments.folder:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
