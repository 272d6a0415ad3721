#!/usr/bin/env python3
"""Writes docs/bench.md from BUILD/bench/*.json, which scripts/bench.sh leaves. Run by `make bench`."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))


def results(build, name):
    with open(os.path.join(build, "bench", name + ".json"), encoding="utf-8") as file:
        return json.load(file)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return "%s, %d threads" % (names[0] if names else "unknown", os.cpu_count())


def phase_tables(runs):
    values = {}
    for run in runs["benchmarks"]:
        what, law, way = run["name"].rsplit("/", 2)
        values.setdefault(what, {}).setdefault(law, {})[way] = run["seconds_per_value"] * 1e9
    for what, laws in sorted(values.items()):
        ways = list(dict.fromkeys(way for row in laws.values() for way in row))
        widest = ways[-1]
        yield "### ns per %s" % what
        yield ""
        yield "| law | %s | scalar / %s |" % (" | ".join(ways), widest)
        yield "|---|%s" % ("---|" * (len(ways) + 1))
        for law, row in laws.items():
            yield "| %s | %s | %.1f |" % (law, " | ".join("%.3g" % row[way] for way in ways), row["scalar"] / row[widest])
        yield ""


def plain_table(runs, unit, value, name=lambda run: run["name"]):
    yield "| case | %s |" % unit
    yield "|---|---|"
    for run in runs["benchmarks"]:
        yield "| %s | %.3g |" % (name(run), value(run))
    yield ""


def seconds(command):
    """Processor time, which a busy machine does not stretch as it does the clock's."""
    before = os.times()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


SIZE, FEW, MANY = (160, 90), 4, 24


def path_table(build):
    """Samples per second of `path`, from the difference of two runs, so that loading the scene does not count."""
    yield "| scene | thousand samples per second of one processor |"
    yield "|---|---|"
    for scene in ("street", "room", "landscape"):
        with tempfile.TemporaryDirectory() as folder:
            command = [os.path.join(build, "tyndall"), "render", os.path.join(HERE, "..", "examples", scene + ".scene.json"), "--quiet",
                       "--threads", "1", "--size", "%dx%d" % SIZE, "-o", os.path.join(folder, "x.exr"), "--spp"]
            took = seconds(command + [str(MANY)]) - seconds(command + [str(FEW)])
        yield "| %s | %.3g |" % (scene, SIZE[0] * SIZE[1] * (MANY - FEW) / took / 1000 if took > 0 else float("nan"))
    yield ""


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", help="the build folder of `make bench`: build-bench")
    build = parser.parse_args().build
    measured = min(results(build, name)["context"]["date"][:10] for name in ("phase_bench", "slab_bench", "airlight_bench"))
    lines = [
        "# Speed", "",
        "Made by `make bench` on %s: %s. Machines are shared and noisy: trust ratios within a table." % (measured, processor()), "",
        "## Laws", "", "`build-bench/bin/phase_bench`", "",
        "One thread, inputs and results in arrays of 4096 floats. Scalar is the same text at -O2 without vectorisation and, like all portable",
        "x86-64 code, without fused multiply-add instructions; the others are its kernels.", "",
        *phase_tables(results(build, "phase_bench")),
        "## Slabs: millions of paths per second and thread", "", "`build-bench/bin/slab_bench`", "",
        "Optical depth 8 (chromatic: 4, 8, 16, a walk for each), albedo 0.999, Henyey-Greenstein g 0.85.", "",
        *plain_table(results(build, "slab_bench"), "Mpaths/s", lambda run: run["items_per_second"] * 1e-6),
        "## Airlight: microseconds per ray and light", "", "`build-bench/bin/airlight_bench`", "",
        *plain_table(results(build, "airlight_bench"), "microseconds", lambda run: run["per_ray_and_light"] * 1e6,
                     lambda run: run["name"].split("/")[0].replace("_", " ") + ": " + run["label"]),
        "## Pictures: `path`", "",
        "`build-bench/tyndall render examples/SCENE.scene.json --threads 1 --size %dx%d --spp %d`, less the same with `--spp %d`."
        % (*SIZE, MANY, FEW), "",
        *path_table(build)]
    with open(os.path.join(HERE, "..", "docs", "bench.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
