#!/usr/bin/env python3
"""convergence.py [PROGRAM] [SCENE ...]: how long the program's integrator `path` needs for a given error.

    python3 scripts/convergence.py build/tyndall                     all scenes; minutes, and hours for the first references
    python3 scripts/convergence.py build/tyndall street spot --spp 64
    python3 scripts/convergence.py build/tyndall --make-references --spp 4096     again, and better

Scenes: street, room and landscape of examples/; spot, bank and lamps of examples/bench/make_scenes.py. Each is rendered small (the
error of a pixel does not depend on how many there are), with one thread, and compared with a reference picture of another seed that
is kept in --folder. The error is

    relMSE = mean((x - r)^2 / (r^2 + 0.01 m^2)),     m: the reference's mean

over all pixels and channels, once with all of them and once without the worst 0.1 %. It falls as 1 / samples, so processor seconds
(without those of loading the scene) times relMSE is what a renderer is worth; printed as the seconds to relMSE 0.01 of a 512 x 512 picture on two cores. The next columns
say in which layers of the picture the error is: the same figure of each layer over the value of the whole pixel. Standard library only.
"""
import argparse
import math
import os
import resource
import subprocess
import sys

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "examples")
sys.path.insert(0, os.path.join(EXAMPLES, "bench"))
import exr  # noqa: E402  (beside this script)
import make_scenes  # noqa: E402

# Sizes of the pictures, samples, samples of a reference.
WIDE, SQUARE = (96, 54), (64, 64)
SCENES = {"street": (WIDE, 16, 2048), "room": (WIDE, 128, 16384), "landscape": (WIDE, 16, 2048),
          "spot": (SQUARE, 64, 8192), "bank": (SQUARE, 64, 8192), "lamps": (SQUARE, 16, 2048)}
LAYERS = ("surface", "single", "multiple")
REFERENCE_SEED = 777


def paths(folder):
    made = make_scenes.write(os.path.join(folder, "scenes"))
    return {name: made.get(name, os.path.join(EXAMPLES, name + ".scene.json")) for name in SCENES}


def render(program, scene, size, spp, seed, out, threads):
    """Processor seconds of a rendering."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "render", scene, "--allow-path", "--quiet", "--size", "%dx%d" % size, "--spp", str(spp), "--seed", str(seed),
                    "--threads", str(threads), "-o", out], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def errors(picture, reference):
    """relMSE of the beauty, the same without the worst 0.1 % of pixels, and that of each layer over the beauty's value."""
    mean = math.fsum(math.fsum(reference[c]) for c in "RGB") / (3 * len(reference["R"]))
    floor = 0.01 * mean * mean

    def squares(prefix):
        per_pixel = [0.0] * len(reference["R"])
        for c in "RGB":
            for i, (x, r, whole) in enumerate(zip(picture[prefix + c], reference[prefix + c], reference[c])):
                per_pixel[i] += (x - r) ** 2 / (whole * whole + floor) / 3
        return per_pixel

    whole = sorted(squares(""))
    kept = whole[:max(1, len(whole) - max(1, len(whole) // 1000))]
    return (math.fsum(whole) / len(whole), math.fsum(kept) / len(kept),
            [math.fsum(squares(layer + ".")) / len(whole) for layer in LAYERS])


def measure(program, name, scene, folder, arguments):
    size, spp, reference_spp = SCENES[name]
    reference = os.path.join(folder, name + ".reference.exr")
    if arguments.make_references or not os.path.exists(reference):
        wanted = arguments.spp if arguments.make_references and arguments.spp else reference_spp
        render(program, scene, size, wanted, REFERENCE_SEED, reference, arguments.threads)
        if arguments.make_references:
            return
    spp = arguments.spp or spp
    truth, out = exr.read(reference)[2], os.path.join(folder, name + ".exr")
    # What loading takes is no part of the race.
    loading = render(program, scene, (1, 1), 1, 1, out, 1)
    seconds, rows = -loading, []
    for seed in range(1, arguments.seeds + 1):
        seconds += render(program, scene, size, spp, seed, out, 1) / arguments.seeds
        rows.append(errors(exr.read(out)[2], truth))
    error, kept = (math.fsum(row[k] for row in rows) / len(rows) for k in (0, 1))
    layers = [math.fsum(row[2][k] for row in rows) / len(rows) for k in range(len(LAYERS))]
    pixels = size[0] * size[1]
    to_hundredth = seconds / 0.01 * (512 * 512 / pixels) / 2
    print("| %s | %d | %.2f | %.4f | %.4f | %.0f | %.0f | %.0f | %s |" % (
        name, spp, seconds * 1e6 / (pixels * spp), error, kept, 1e-3 * pixels * spp / seconds, error * to_hundredth, kept * to_hundredth,
        " | ".join("%.4f" % x for x in layers)), flush=True)


def main():
    parser = argparse.ArgumentParser(description="Seconds that the path integrator needs for a given error.")
    parser.add_argument("program", nargs="?", default=os.path.join(HERE, "..", "build", "tyndall"))
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="which of: " + ", ".join(SCENES) + " (default: all)")
    parser.add_argument("--spp", type=int, help="samples per pixel instead of the scene's own")
    parser.add_argument("--seeds", type=int, default=2, help="pictures to average over")
    parser.add_argument("--threads", type=int, default=2, help="threads for references; measurements use one")
    parser.add_argument("--folder", default=os.path.join(HERE, "..", "build-bench", "convergence"), help="for pictures and references")
    parser.add_argument("--make-references", action="store_true", help="make the references again, with --spp, and stop")
    arguments = parser.parse_args()
    for name in arguments.scenes:
        if name not in SCENES:
            parser.error("%r is no scene; there are %s" % (name, ", ".join(SCENES)))
    os.makedirs(arguments.folder, exist_ok=True)
    program = os.path.abspath(arguments.program)
    scenes = paths(arguments.folder)
    if not arguments.make_references:
        print("| scene | samples | us/sample | relMSE | without worst 0.1 % | 1000 samples/s | s to 0.01 | s without worst | " + " | ".join(LAYERS) + " |")
        print("|" + "---|" * (8 + len(LAYERS)))
    for name in arguments.scenes or SCENES:
        measure(program, name, scenes[name], arguments.folder, arguments)


if __name__ == "__main__":
    main()
