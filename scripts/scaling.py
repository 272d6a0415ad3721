#!/usr/bin/env python3
"""scaling.py [PROGRAM]: how much faster two threads, and two processes, are than one; and what a large grid takes.

    python3 scripts/scaling.py build/tyndall                 six minutes; wants two idle processors
    python3 scripts/scaling.py build/tyndall cloud --runs 3
    python3 scripts/scaling.py build/tyndall --grid 512      instead: memory and time for a grid of so many voxels along an edge

Wall-clock time of `tyndall render` between a few samples and many, so that loading does not count; the least of some runs, one and two in
turn. Processes are those of `mpirun -n`, each with one thread; one process alone is run by mpirun too. --grid makes the example's cloud
of more voxels (examples/media/make_cloud.py: Debian's python3-openvdb and python3-numpy, run by /usr/bin/python3) and renders a small picture of it.
"""
import argparse
import os
import resource
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "examples")
SCENES = {"street": (4, 16), "landscape": (8, 32), "cloud": (16, 80)}
SIZE = "320x180"


def wall(command):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    begin = time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=environment)
    return time.monotonic() - begin


def seconds(program, scene, folder, threads, ranks):
    few, many = SCENES[scene]
    before = ["mpirun", "--bind-to", "none", "--oversubscribe", "-n", str(ranks)] if ranks else []
    command = before + [program, "render", os.path.join(EXAMPLES, scene + ".scene.json"), "--size", SIZE, "--quiet", "--threads",
                        str(threads), "-o", os.path.join(folder, "x.exr"), "--spp"]
    return wall(command + [str(many)]) - wall(command + [str(few)])


def scaling(program, scenes, runs):
    print("| scene | 1 thread | 2 threads | ratio | 1 rank | 2 ranks | ratio |")
    print("|---|---|---|---|---|---|---|")
    for scene in scenes:
        least = {}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(runs):
                for way in ((1, 0), (2, 0), (1, 1), (1, 2)):
                    least[way] = min(least.get(way, 1e9), seconds(program, scene, folder, *way))
        print("| %s | %.1f s | %.1f s | %.2f | %.1f s | %.1f s | %.2f |" %
              (scene, least[1, 0], least[2, 0], least[1, 0] / least[2, 0], least[1, 1], least[1, 2], least[1, 1] / least[1, 2]), flush=True)


def grid(program, voxels):
    with tempfile.TemporaryDirectory() as folder:
        media = os.path.join(folder, "media")
        os.mkdir(media)
        subprocess.run(["/usr/bin/python3", os.path.join(EXAMPLES, "media", "make_cloud.py"), "--voxels", str(voxels), "-o",
                        os.path.join(media, "cumulus.vdb")], check=True, stdout=subprocess.DEVNULL)
        for name in ("cloud.scene.json", os.path.join("media", "cloud.medium.json"), os.path.join("media", "cloud_c1.csv")):
            if os.path.exists(os.path.join(EXAMPLES, name)):
                with open(os.path.join(EXAMPLES, name), "rb") as source, open(os.path.join(folder, name), "wb") as copy:
                    copy.write(source.read())
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        took = wall([program, "render", os.path.join(folder, "cloud.scene.json"), "--allow-path", "--size", "64x40", "--spp", "1", "--threads",
                     "1", "--quiet", "-o", os.path.join(folder, "x.exr")])
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        print("%d voxels along the longest edge, a file of %.0f MB: %.1f s until a picture of 64 x 40 samples, most memory of a process %.0f MB"
              % (voxels, os.path.getsize(os.path.join(media, "cumulus.vdb")) / 1e6, took, max(before.ru_maxrss, after.ru_maxrss) / 1e3))


def main():
    parser = argparse.ArgumentParser(description="Threads, processes, large grids.")
    parser.add_argument("program", nargs="?", default="build/tyndall")
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--runs", type=int, default=2)
    parser.add_argument("--grid", type=int, metavar="VOXELS")
    arguments = parser.parse_args()
    if not set(arguments.scenes) <= set(SCENES):
        parser.error("scenes are " + ", ".join(SCENES))
    if arguments.grid:
        grid(arguments.program, arguments.grid)
    else:
        scaling(arguments.program, arguments.scenes or SCENES, arguments.runs)


if __name__ == "__main__":
    main()
