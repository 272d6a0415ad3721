#!/usr/bin/env python3
"""Writes docs/bench.md, or only one of its sections, from BUILD/bench/*.json, which scripts/bench.sh leaves. Run by
`make bench`."""
import argparse
import json
import os

HERE = os.path.dirname(os.path.abspath(__file__))


def results(build, name):
    with open(os.path.join(build, "bench", name + ".json"), encoding="utf-8") as file:
        return json.load(file)


def processor():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return "%s, %d threads" % (names[0] if names else "unknown", os.cpu_count())


# What laws are to reach on an AVX-512 core [ns], and by what Lanes are to surpass scalar code; tables are exempt.
MOST = {"density": 0.5, "sample": 1.5}
MOST_OF = {("density", "henyey_greenstein"): 0.7}
LEAST_RATIO = 6.0

# Why a target is missed, by the beginning of the law's name.
CAUSES = {
    ("density", "fournier_forand"): "its powers take two logarithms and three exponentials",
    ("sample", "fournier_forand"): "one evaluation of the lobe alone is more than half of this",
    ("density", "droplet:diameter=5"): "four lobes, where two fits are cross-faded",
    ("sample", "droplet"): "the search takes 0.6 ns, each step Draine's lobe 0.4 ns for every fit in use and Henyey-Greenstein's 0.2 ns",
    ("sample", "draine:g=0.3"): "next to no light is scattered sideways: two steps, where one is enough for most",
    ("sample", "draine"): "the search alone takes 0.6 ns and the lobe 0.4",
    ("sample", "cornette_shanks"): "the search alone takes 0.6 ns and the lobe 0.4",
    ("sample", "mixture:"): "peaks both ways on a faint ground: three steps, where one is enough for most",
}


def phase_values(runs):
    """{what: {law: {way: ns}}}: the least of the repetitions."""
    values = {}
    for run in runs["benchmarks"]:
        if run["aggregate_name"] == "least":
            what, law, way = run["run_name"].split("/")[:3]
            values.setdefault(what, {}).setdefault(law, {})[way] = run["seconds_per_value"] * 1e9
    return dict(sorted(values.items()))


def cause_of(what, law):
    return next((cause for (of, start), cause in CAUSES.items() if of == what and law.startswith(start)), "not looked into")


def phase_verdicts(values):
    met, missed = 0, []
    for what, laws in values.items():
        for law, row in laws.items():
            if law.startswith("tabulated"):
                continue
            most, found = MOST_OF.get((what, law.split(":")[0]), MOST[what]), row["avx512"]
            if found <= most:
                met += 1
            else:
                missed.append("%s of %s: %.3g ns, not %.2g: %s." % (what, law, found, most, cause_of(what, law)))
            if row["scalar"] >= LEAST_RATIO * found:
                met += 1
            else:
                missed.append("%s of %s: Lanes are %.1f times as fast as scalar, not %g." % (what, law, row["scalar"] / found, LEAST_RATIO))
    yield "Targets on an AVX-512 core, for every law without a table: a density in at most %.2g ns (Henyey-Greenstein %.2g), a sample in" % (
        MOST["density"], MOST_OF["density", "henyey_greenstein"])
    yield "at most %.2g ns, Lanes at least %g times as fast as scalar code. %d met, %d missed%s" % (
        MOST["sample"], LEAST_RATIO, met, len(missed), ":" if missed else ".")
    yield ""
    yield from ("- " + line for line in missed)
    if missed:
        yield ""


def phase_tables(runs):
    values = phase_values(runs)
    widest = None
    for what, laws in values.items():
        ways = list(dict.fromkeys(way for row in laws.values() for way in row))
        widest = ways[-1]
        yield "### ns per %s" % what
        yield ""
        yield "| law | %s | scalar / %s |" % (" | ".join(ways), widest)
        yield "|---|%s" % ("---|" * (len(ways) + 1))
        for law, row in laws.items():
            yield "| %s | %s | %.1f |" % (law, " | ".join("%.3g" % row[way] for way in ways), row["scalar"] / row[widest])
        yield ""
    yield "### Targets"
    yield ""
    if widest == "avx512":
        yield from phase_verdicts(values)
    else:
        yield "This machine has no AVX-512, for which they are stated."
        yield ""


def plain_table(runs, unit, value, name=lambda run: run["name"]):
    yield "| case | %s |" % unit
    yield "|---|---|"
    for run in runs["benchmarks"]:
        yield "| %s | %.3g |" % (name(run), value(run))
    yield ""


def path_table(runs):
    yield "| scene | thousand paths | thousand rays | thousand collisions | thousand reflections |"
    yield "|---|---|---|---|---|"
    for run in runs["benchmarks"]:
        yield "| %s | %s |" % (run["name"].split("/")[1],
                               " | ".join("%d" % round(run[what] / 1e3) for what in ("paths", "rays", "collisions", "reflections")))
    yield ""


def picture_section(build):
    return [
        "## Pictures: `path`, per second of one processor", "", "`build-bench/bin/path_bench`", "",
        "Rays are those asked of surfaces, shadow rays included; collisions those that walks go on from (light of lamps and suns is besides",
        "gathered along segments).", "",
        *path_table(results(build, "path_bench"))]


def law_section(build):
    return [
        "## Laws", "", "`build-bench/bin/phase_bench`", "",
        "One thread, inputs and results in arrays of 4096 floats in memory, the least of nine runs of a hundredth of a second. Scalar is the",
        "same text at -O2 without vectorisation and, like all portable x86-64 code, without fused multiply-add instructions; the others are",
        "its kernels, two registers at a time. Where sampling is a search (sums of lobes, Draine's, Fournier and Forand's lobe), both start",
        "from the same small table (`phase/quantile_start.h`).", "",
        *phase_tables(results(build, "phase_bench"))]


def page(build):
    measured = min(results(build, name)["context"]["date"][:10] for name in ("phase_bench", "slab_bench", "airlight_bench"))
    return [
        "# Speed", "",
        "Made by `make bench` on %s: %s. Machines are shared and noisy: trust ratios within a table." % (measured, processor()), "",
        *law_section(build),
        "## Slabs: millions of paths per second and thread", "", "`build-bench/bin/slab_bench`", "",
        "Optical depth 8 (chromatic: 4, 8, 16, a walk for each), albedo 0.999, Henyey-Greenstein g 0.85.", "",
        *plain_table(results(build, "slab_bench"), "Mpaths/s", lambda run: run["items_per_second"] * 1e-6),
        "## Airlight: microseconds per ray and light", "", "`build-bench/bin/airlight_bench`", "",
        *plain_table(results(build, "airlight_bench"), "microseconds", lambda run: run["per_ray_and_light"] * 1e6,
                     lambda run: run["name"].split("/")[0].replace("_", " ") + ": " + run["label"]),
        *picture_section(build)]


# The sections that can be made alone, by how they begin; and those that other scripts measure.
SECTIONS = {"laws": ("Laws", law_section), "pictures": ("Pictures", picture_section)}
KEPT = ("Against Cycles", "Threads")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("build", help="the build folder of `make bench`: build-bench")
    parser.add_argument("section", nargs="?", choices=sorted(SECTIONS), help="only this section; the rest of the page stays")
    arguments = parser.parse_args()
    where = os.path.join(HERE, "..", "docs", "bench.md")
    with open(where, encoding="utf-8") as file:
        before, *old = file.read().split("\n## ")
    if arguments.section:
        begin = SECTIONS[arguments.section][0]
        new = "\n".join(SECTIONS[arguments.section][1](arguments.build))[len("## "):]
        if not any(section.startswith(begin) for section in old):
            parser.error("docs/bench.md has no section " + begin)
        text = "\n## ".join([before, *(new if section.startswith(begin) else section for section in old)])
    else:  # what other scripts measure stays
        text = "\n## ".join(["\n".join(page(arguments.build)), *(section for section in old if section.startswith(KEPT))])
    with open(where, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
