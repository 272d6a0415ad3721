#!/usr/bin/env python3
"""Writes docs/accuracy.md by running the program on every case of the reference data.

    python3 scripts/accuracy.py build/tyndall ../shared/acceptance/public.json

The reference data (independently computed or published values) is not part of the project; only this page and the tests that
check the same cases read it. The laws' own errors are measured by scripts/law_accuracy.cc, compiled here with g++ for each
instruction set of this machine; executed GLSL by the test program beside the program (`make test` builds it). Python's standard
library only.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
HERE = os.path.dirname(os.path.abspath(__file__))
PATHS = 1000000

LAWS = {
    "isotropic": {"law": "isotropic"},
    "rayleigh": {"law": "rayleigh"},
    "hazy": {"law": "mie_hazy"},
    "murky": {"law": "mie_murky"},
}


def law(name):
    return LAWS.get(name) or {"law": "henyey_greenstein", "g": float(name[2:])}


def chi_square_cdf(x, n):
    """P(n/2, x/2), the regularised incomplete gamma function, by its series (Abramowitz and Stegun 6.5.29)."""
    a, half = 0.5 * n, 0.5 * x
    term = math.exp(a * math.log(half) - half - math.lgamma(a + 1)) if half > 0 else 0.0
    total, k = 0.0, a
    while term > 1e-17 * total or k < half:
        total += term
        k += 1
        term *= half / k
    return min(total, 1.0)


def chi_square_quantile(p, n):
    """By bisection."""
    low, high = 0.0, 10.0 * n + 100.0
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if chi_square_cdf(middle, n) < p else (low, middle)
    return low


class Bench:
    def __init__(self, program, folder):
        self.program, self.folder, self.seed = program, folder, 1000

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            json.dump(content, file)
        return path

    def run(self, *arguments):
        out = subprocess.run([self.program, *map(str, arguments)], check=True, capture_output=True, text=True)
        return json.loads(out.stdout)

    def medium(self, species):
        return self.write("m.medium.json", {"format": "tyndall-medium/1", "species": species})

    def slab(self, species, *options, thickness=1):
        self.seed += 1
        return self.run("slab", self.medium(species), "--thickness", thickness, "--spp", PATHS, "--seed", self.seed, "--json", *options)


def species(phase, scattering, absorption):
    return {"scattering": scattering, "absorption": absorption, "phase": phase}


class Scores:
    """z values of one category, with what they belong to."""

    def __init__(self):
        self.rows, self.errors = [], []

    def add(self, name, mean, error, truth):
        if abs(truth) < 1e-8:  # rarer than the truth's own nine decimals
            return
        self.rows.append(((mean - truth) / math.hypot(error, 1e-9), name))
        self.errors.append(error)

    def table_row(self, title, independent=True):
        n = len(self.rows)
        chi = sum(z * z for z, _ in self.rows)
        worst = max(self.rows, key=lambda row: abs(row[0]))
        low, high = chi_square_quantile(0.001, n), chi_square_quantile(0.999, n)
        judged = "%.1f | %.1f to %.1f" % (chi, low, high) if independent else "- | -"
        return "| %s | %d | %.2f (%s) | %s | %.1e |" % (title, n, worst[0], worst[1], judged, max(self.errors))


def slabs(bench, truth):
    rows = []
    flux = Scores()
    for item in truth["slab_flux"]["items"]:
        s = [species(law(item["phase"]), item["albedo"] * item["tau"], (1 - item["albedo"]) * item["tau"])]
        for mu0 in ("1", "0.5"):
            out, expected = bench.slab(s, "--mu0", mu0), item["mu0=" + mu0]
            name = "%s, albedo %g, tau %g" % (item["phase"], item["albedo"], item["tau"])
            for key, kind in (("R", "reflectance"), ("T_diffuse", "transmittance_diffuse")):
                flux.add(name + " " + key, out[kind][0], out["standard_error"][kind][0], expected[key])
    rows.append(flux.table_row("slab_flux"))

    angular, angles = Scores(), Scores()
    for item in truth["slab_angular"]["items"]:
        s = [species(law(item["phase"]), item["albedo"] * item["tau"], (1 - item["albedo"]) * item["tau"])]
        out = bench.slab(s, "--mu0", item["mu0"], "--mu", ",".join(item["R(mu,mu0)"]))
        for key, kind in (("R(mu,mu0)", "reflection"), ("T(mu,mu0)", "transmission")):
            for (mu, value), mean, error in zip(item[key].items(), out[kind], out["standard_error"][kind]):
                name = "%s, albedo %g, tau %g, %s(%s)" % (item["phase"], item["albedo"], item["tau"], key[0], mu)
                angles.add(name, mean[0], error[0], value)
                if mu == "0.5":
                    angular.add(name, mean[0], error[0], value)
    rows.append(angular.table_row("slab_angular at mu = 0.5"))
    rows.append(angles.table_row("slab_angular at all angles, which share their paths", independent=False))

    half = Scores()
    for item in truth["semi_infinite_flux"]["items"]:
        s = [species(law(item["phase"]), item["albedo"], 1 - item["albedo"])]
        for mu0 in ("1", "0.5"):
            out = bench.slab(s, "--mu0", mu0, thickness="inf")
            half.add("%s, albedo %g" % (item["phase"], item["albedo"]), out["reflectance"][0],
                     out["standard_error"]["reflectance"][0], item["mu0=" + mu0])
    rows.append(half.table_row("semi_infinite_flux"))

    chandrasekhar = Scores()
    for item in truth["chandrasekhar_H"]["items"]:
        s = [species(law("isotropic"), item["albedo"], 1 - item["albedo"])]
        for mu0, value in item["mu"].items():
            out = bench.slab(s, "--mu0", mu0, thickness="inf")
            chandrasekhar.add("albedo %g, mu0 %s" % (item["albedo"], mu0), out["reflectance"][0],
                              out["standard_error"]["reflectance"][0], float(value["plane_albedo"]))
        out = bench.slab(s, "--illumination", "diffuse", thickness="inf")
        chandrasekhar.add("albedo %g, whole sky" % item["albedo"], out["reflectance"][0], out["standard_error"]["reflectance"][0],
                          float(item["spherical_albedo"]))
    rows.append(chandrasekhar.table_row("chandrasekhar_H"))

    mixtures = Scores()
    items = truth["mixtures_layers"]["items"]
    two_lobes = {"law": "mixture", "parts": [{"weight": 0.2, "phase": law("hg-0.3")}, {"weight": 0.8, "phase": law("hg0.7")}]}
    cases = {
        0: [species(law("rayleigh"), 0.2, 0), species(law("hazy"), 1.0, 0), species(law("isotropic"), 0, 0.1)],
        1: [species(two_lobes, 4.0, 0.04)],
        3: [species(law("hazy"), 0.95 * 1.5, 0.05 * 1.5)],
    }
    for index, s in cases.items():
        for mu0 in ("1", "0.5"):
            expected = items[index]["mu0=" + mu0]
            out = bench.slab(s, "--mu0", mu0, *(["--ground", 0.5] if index == 3 else []))
            errors = out["standard_error"]
            mixtures.add(items[index]["label"], out["reflectance"][0], errors["reflectance"][0], expected["R"])
            down = out["transmittance_diffuse"][0]
            if index == 3:
                down, wanted = down + out["transmittance_direct"][0], expected["ground_irradiance_fraction"]
            else:
                wanted = expected["T_diffuse"]
            mixtures.add(items[index]["label"], down, errors["transmittance_diffuse"][0], wanted)
    for upside_down in (False, True):
        bottom = 0 if upside_down else 1
        s = [{**species(law("hg0.85"), 0.999 * 4, 0.001 * 4), "profile": {"law": "layer", "bottom": bottom, "top": bottom + 1}},
             {**species(law("hazy"), 0.9, 0.1), "profile": {"law": "layer", "bottom": 1 - bottom, "top": 2 - bottom}}]
        for mu0 in ("1", "0.5"):
            out = bench.slab(s, "--mu0", mu0, thickness=2)
            key, kind = ("T_diffuse", "transmittance_diffuse") if upside_down else ("R", "reflectance")
            mixtures.add(items[2]["label"], out[kind][0], out["standard_error"][kind][0], items[2]["mu0=" + mu0][key])
    out = bench.slab([species(law("murky"), 0.999 * 8, 0.001 * 8)], "--illumination", "diffuse")
    mixtures.add(items[4]["label"], out["reflectance"][0], out["standard_error"]["reflectance"][0], items[4]["R_dd"])
    mixtures.add(items[4]["label"], out["transmittance_diffuse"][0] + out["transmittance_direct"][0],
                 out["standard_error"]["transmittance_diffuse"][0], items[4]["T_dd"])
    rows.append(mixtures.table_row("mixtures_layers"))

    hulst = truth["published_slab"]["items"][0]
    published = Scores()
    out = bench.slab([species(law("hg0.75"), 1.8, 0.2)])
    published.add("van de Hulst R", out["reflectance"][0], out["standard_error"]["reflectance"][0], hulst["Rd_computed"])
    published.add("van de Hulst T", out["transmittance_diffuse"][0], out["standard_error"]["transmittance_diffuse"][0],
                  hulst["T_diffuse_computed"])
    out = bench.slab([species(law("isotropic"), 32, 0)], "--mu0", "0.1")
    published.add("DISORT 1e R", out["reflectance"][0], out["standard_error"]["reflectance"][0],
                  truth["published_slab"]["items"][2]["flux_up_over_pi"])
    out, disort = bench.slab([species(law("rayleigh"), 0.2, 0)], "--mu0", "0.080442"), truth["published_slab"]["items"][3]
    for key, kind in (("computed_up", "reflectance"), ("computed_down", "transmittance_diffuse")):
        published.add("DISORT 2b " + kind, out[kind][0], out["standard_error"][kind][0], disort[key] / (math.pi * 0.080442))
    rows.append(published.table_row("published_slab (index 1)"))

    by_law, chromatic = {}, Scores()
    for item in truth["slab_flux"]["items"]:
        by_law.setdefault(item["phase"], []).append(item)
    for name, group in by_law.items():
        for first in range(0, len(group) - 2, 3):
            three = group[first:first + 3]
            s = [species(law(name), [i["albedo"] * i["tau"] for i in three], [(1 - i["albedo"]) * i["tau"] for i in three])]
            out = bench.slab(s)
            for c, item in enumerate(three):
                for key, kind in (("R", "reflectance"), ("T_diffuse", "transmittance_diffuse")):
                    chromatic.add("%s channel %d" % (name, c), out[kind][c], out["standard_error"][kind][c], item["mu0=1"][key])
    rows.append(chromatic.table_row("three slab_flux cases as one chromatic slab"))
    return rows


def airlight(bench, truth):
    rows = []
    for category in ("airlight_point", "airlight_spot"):
        worst, count, zs = 0.0, 0, Scores()
        for item in truth[category]["items"]:
            for name in ("isotropic", "rayleigh", "hg0.7", "hazy", "murky"):
                if name not in item:
                    continue
                if "spot_pos" in item:
                    light = {"type": "spot", "position": item["spot_pos"], "direction": item["spot_dir_unnormalised"], "intensity": 1,
                             "inner_angle": item["half_angle_deg"], "outer_angle": item["half_angle_deg"]}
                else:
                    light = {"type": "point", "position": [item["a"], item["h"], 0], "intensity": 1}
                scene = bench.write("a.scene.json", {
                    "format": "tyndall-scene/1", "lights": [light], "integrator": {"name": "path", "max_depth": 1},
                    "medium": {"format": "tyndall-medium/1", "species": [species(law(name), item["sigma_t"], 0)]}})
                ray = ["probe", scene, "--origin", "0,0,0", "--direction", "1,0,0", "--distance", item["d"], "--json"]
                value = float(item[name])
                worst = max(worst, abs(bench.run(*ray, "--integrator", "single")["radiance"][0] / value - 1))
                out = bench.run(*ray, "--integrator", "path", "--spp", 20000)
                zs.add("%s %s" % (item["id"], name), out["radiance"][0], out["standard_error"][0], value)
                count += 1
        rows.append("| %s | %d | %.1e | %.2f |" % (category, count, worst, max((z for z, _ in zs.rows), key=abs)))
    return rows


def view_rays(camera, aspect):
    """24 directions of a regular grid over the picture."""
    def unit(v):
        n = math.hypot(*v)
        return [x / n for x in v]

    def cross(a, b):
        return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    forward = unit([b - a for a, b in zip(camera["position"], camera["look_at"])])
    right = unit(cross(forward, camera["up"]))
    up, half = cross(right, forward), math.tan(math.radians(0.5 * camera["vertical_fov"]))
    for j in range(4):
        for i in range(6):
            x, y = ((2 * i + 1) / 6 - 1) * half * aspect, ((2 * j + 1) / 4 - 1) * half
            yield [f + x * r + y * u for f, r, u in zip(forward, right, up)]


def whole_scenes(bench):
    """`single` against `path` limited to one scattering, along rays from the example scenes' cameras."""
    examples = os.path.join(os.path.dirname(HERE), "examples")
    for name in ("street", "room", "landscape"):
        with open(os.path.join(examples, name + ".scene.json"), encoding="utf-8") as file:
            scene = json.load(file)
        scene["integrator"] = {"name": "path", "max_depth": 1}
        scene["geometry"] = [os.path.join(examples, g) for g in scene["geometry"]]
        for holder in [scene, *scene.get("volumes", [])]:
            if isinstance(holder.get("medium"), str):
                holder["medium"] = os.path.join(examples, holder["medium"])
        path = bench.write("whole.scene.json", scene)
        film, found = scene["film"], []
        for direction in view_rays(scene["camera"], film["width"] / film["height"]):
            ray = ["probe", path, "--allow-path", "--json", "--origin", ",".join(map(repr, scene["camera"]["position"])),
                   "--direction", ",".join(map(repr, direction)), "--integrator"]
            exact, out = bench.run(*ray, "single")["radiance"][1], bench.run(*ray, "path", "--spp", 20000)
            truth = out["radiance"][1]
            if truth > 0 and exact is not None:
                found.append((abs(exact / truth - 1), out["standard_error"][1] / truth))
        found.sort()
        middle, worst = found[len(found) // 2], found[-1]
        yield "| %s | %d | %.2f ± %.2f %% | %.2f ± %.2f %% |" % (name, len(found), *(100 * x for x in (*middle, *worst)))


def fluence(bench, truth):
    scores = Scores()
    for item in truth["point_source_fluence"]["items"]:
        albedo = float(item["albedo"])
        scene = bench.write("f.scene.json", {
            "format": "tyndall-scene/1", "lights": [{"type": "point", "position": [0, 0, 0], "intensity": 1 / (4 * math.pi)}],
            "medium": {"format": "tyndall-medium/1", "species": [species(law("isotropic"), albedo, 1 - albedo)]}})
        out = bench.run("probe", scene, "--origin", item["r"] + ",0,0", "--direction", "1,0,0", "--fluence", "--integrator", "path",
                        "--spp", 100000, "--json")
        scores.add("albedo %s, r %s" % (item["albedo"], item["r"]), out["radiance"][0], out["standard_error"][0], float(item["fluence"]))
    return scores.table_row("point_source_fluence")


def law_text(name):
    """What a case of phase_functions is called on the command line."""
    for form, said in ((r"hg_(.*)", "henyey_greenstein:g=%s"), (r"cornette_shanks_(.*)", "cornette_shanks:g=%s"),
                       (r"schlick_k=(.*)", "schlick:k=%s"), (r"hgdraine_d(.*)", "droplet:diameter=%s"),
                       (r"draine_(.*)_(.*)", "draine:g=%s,alpha=%s"), (r"(isotropic|rayleigh|mie_hazy|mie_murky)", "%s"),
                       (r"(hazy|murky)", "mie_%s")):
        found = re.fullmatch(form, name)
        if found:
            return said % tuple("0" + x if x.startswith(".") else x for x in found.groups())
    raise ValueError("phase_functions has a law of a new name: " + name)


def phases(bench, truth):
    rows = []
    for item in truth["phase_functions"]["items"]:
        name, angles = law_text(item["name"]), item["p(theta_deg)"]
        at = ",".join(repr(math.cos(math.radians(float(a)))) for a in angles)
        out = bench.run("phase", name, "--at", at, "--moments", 8, "--sample", item["backscatter_fraction"], "--json")
        p = max(abs(a / float(b) - 1) for a, b in zip(out["density"], angles.values()))
        m = max(abs(a - float(b)) for a, b in zip(out["legendre"], item["chi_0..8"]))
        rows.append("| %s | %.1e | %.1e | %.1e |" % (name, p, m, abs(out["sampled_mu"][0])))
    return rows


def legendre_nodes(n):
    """Nodes and weights of Gauss and Legendre's rule (Abramowitz and Stegun 25.4.29)."""
    for k in range(1, n + 1):
        x = math.cos(math.pi * (k - 0.25) / (n + 0.5))
        for _ in range(6):
            before, p = 1.0, x
            for j in range(1, n):
                before, p = p, ((2 * j + 1) * x * p - j * before) / (j + 1)
            slope = n * (x * p - before) / (x * x - 1)
            x -= p / slope
        yield x, 2 / ((1 - x * x) * slope * slope)


def two_lobe_fits(bench, truth):
    """How far the misfits of two lobes, from densities that the program prints, are from the stated ones."""
    nodes, weights = zip(*legendre_nodes(400))
    at = "--at=" + ",".join(map(repr, nodes))

    def densities(phase):
        return [p[0] for p in bench.run("phase", bench.medium([species(phase, 1, 0)]), at, "--json")["density"]]

    def mean(values):
        return 2 * math.pi * sum(map(lambda w, x: w * x, weights, values))

    published = {"rayleigh": (0.50, -0.46, 0.46), "hazy": (0.12, -0.50, 0.70), "murky": (0.19, -0.65, 0.91)}
    targets = {name: densities(law(name)) for name in published}
    worst, count = {}, 0
    for item in truth["two_hg_fits"]["items"]:
        target, _, measure = item["target"].partition("_")
        lobe, parameter, even = "henyey_greenstein", "g", 0.0
        if "par" in item:
            even, r, g1, g2 = [0.0] * (4 - len(item["par"])) + item["par"]
        elif "r" in item:
            r, g1, g2 = item["r"], item["g1"], item["g2"]
        else:
            r, g1, g2 = published[target]
            if "r on g1" in item["fit"]:
                r = 1 - r
            if "Schlick" in item["fit"]:
                lobe, parameter = "schlick", "k"
        parts = [(even, {"law": "isotropic"}), ((1 - even) * (1 - r), {"law": lobe, parameter: g1}),
                 ((1 - even) * r, {"law": lobe, parameter: g2})]
        parts = [{"weight": w, "phase": phase} for w, phase in parts if w > 0]
        p, q = targets[target], densities({"law": "mixture", "parts": parts})
        found = {
            "norm": mean(q),
            "relL2": math.sqrt(mean([(a - b) ** 2 for a, b in zip(p, q)]) / mean([a * a for a in p])),
            "KL": mean([a * math.log(a / b) for a, b in zip(p, q)]),
            "rms_log": math.sqrt(mean([math.log(b / a) ** 2 for a, b in zip(p, q)]) / (4 * math.pi)),
            "max_rel": max(abs(b / a - 1) for a, b in zip(p, q)),
            "fwd_ratio": q[0] / p[0], "back_ratio": q[-1] / p[-1]}
        for key, value in found.items():
            stated = item["obj"] if key == measure else item.get(key)
            if stated is not None:
                worst[key] = max(worst.get(key, 0.0), abs(value / stated - 1))
        count += 1
    return "| two_hg_fits: %s | %d | %s |" % (", ".join(worst), count, ", ".join("%.0e" % x for x in worst.values()))


def air_and_models(bench, truth):
    """Rows of what media say: air, visibility, the note's w, fog of a water content."""

    def show(medium):
        return bench.run("show", bench.write("m.medium.json", {"format": "tyndall-medium/1", **medium}), "--json")

    def worst(pairs):
        return "%.1e" % max(abs(got / expected - 1) for got, expected in pairs)

    air = []
    for item in truth["rayleigh_air"]["items"]:
        if "lambda_um" in item:
            nm = 1e3 * item["lambda_um"]
            shown = show({"channels": {"wavelengths_nm": [nm, nm, nm]}, "background": {"air": "standard"}})
            air.append((shown["scattering"][1], item["beta_m-1"]))
    visibility = []
    for item in truth["visibility"]["items"]:
        if "V_m" in item:
            shown = show({"species": [{"density": {"visibility": item["V_m"], "contrast": item["eps"]}}]})
            visibility.append((shown["extinction"][1], item["sigma"]))
    blend = []
    for item in truth["seed_w_blend"]["items"]:
        shown = show({"conditions": {"model": "simple", "w": item["w"], "thickness": 1}})
        blend += [(1 + shown["extinction"][1], 1 + item["sum"])]
        blend += [] if item["g_eff"] is None else [(shown["mean_cosine"][1], item["g_eff"])]
    thick, cosine, share = [], [], []
    for item in truth["polydispersions"]["items"]:
        if "LWC_g_per_m3" not in item:
            continue
        nm = 1e3 * item["lambda_um"]
        shown = show({"channels": {"wavelengths_nm": [nm, nm, nm]},
                      "conditions": {"model": "measured", "air": "fog", "droplet_diameter": 2 * item["r_eff_um"],
                                     "liquid_water_content": item["LWC_g_per_m3"]}})
        thick.append((shown["extinction"][1], item["beta_ext_per_m"]))
        cosine.append((shown["mean_cosine"][1], item["g"]))
        share.append((shown["absorption"][1] / shown["extinction"][1], 1 - item["albedo"]))
    return ["| rayleigh_air: standard air, scattering | %d | %s |" % (len(air), worst(air)),
            "| visibility: extinction | %d | %s |" % (len(visibility), worst(visibility)),
            "| seed_w_blend: 1 + extinction, mean cosine | %d | %s |" % (len(blend), worst(blend)),
            "| polydispersions: fog of a water content, extinction | %d | %s |" % (len(thick), worst(thick)),
            "| the same, mean cosine | %d | %s |" % (len(cosine), worst(cosine)),
            "| the same, share that is absorbed | %d | %s |" % (len(share), worst(share))]


def air_section(bench, truth):
    return ["## Air, visibility and models: `tyndall show`", "",
            "| category | values | worst relative error |", "|---|---|---|", *air_and_models(bench, truth), "",
            "The last three hold a model against Mie's theory integrated over the sizes of Shettle and Fenn's fogs: one effective diameter",
            "for a distribution, a fitted mean cosine, rays for absorption (and Hale and Querry's index where the truth rounds it)."]


def instruction_sets():
    """(name in tables, -march) of what this machine can run."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        flags = set(next(line for line in file if line.startswith("flags")).split())
    yield "SSE2", "x86-64"
    if {"avx2", "fma", "bmi2"} <= flags:
        yield "AVX2", "x86-64-v3"
    if {"avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl"} <= flags:
        yield "AVX-512", "x86-64-v4"


def law_errors(folder):
    """{law: {number: {what: error}}} of scripts/law_accuracy.cc; Lanes carry their instruction set in their name."""
    root, errors, program = os.path.dirname(HERE), {}, os.path.join(folder, "law_accuracy")
    for name, march in instruction_sets():
        subprocess.run(["g++", "-std=c++20", "-O2", "-ffp-contract=off", "-march=" + march, "-I" + root,
                        os.path.join(HERE, "law_accuracy.cc"), "-o", program], check=True)
        for line in subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines():
            row = json.loads(line)
            number = "Lanes, " + name if row["number"] == "Lanes" else row["number"]
            errors.setdefault(row["law"], {}).setdefault(number, row)
    return errors


def glsl_errors(program, folder):
    """{law: {what: error}} of the printed and executed laws, from the properties that the test records; none without it."""
    test, report = os.path.join(os.path.dirname(program), "bin", "law_functions_test"), os.path.join(folder, "glsl.json")
    if not os.path.exists(test):
        return {}
    subprocess.run([test, "--gtest_filter=GlslOf/*", "--gtest_output=json:" + report], check=True, stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as file:
        suites = json.load(file)["testsuites"]
    errors = {}
    for suite in suites:
        found = {key[9:]: float(x) for test in suite["testsuite"] for key, x in test.items() if key.startswith("error_of_")}
        if found:
            errors[suite["name"].split("/")[1]] = {
                "density": found["density"], "cdf": found["cdf"], "sample": max(x for key, x in found.items() if key.startswith("sampled"))}
    return errors


def samples(program, folder):
    """How samples stand against the density: what the test of them recorded; nothing without it."""
    test, report = os.path.join(os.path.dirname(program), "bin", "phase_sampling_test"), os.path.join(folder, "samples.json")
    if not os.path.exists(test):
        return []
    subprocess.run([test, "--gtest_filter=SamplesOf/*.FollowTheDensity", "--gtest_output=json:" + report], check=True,
                   stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as file:
        suites = json.load(file)["testsuites"]
    lines = ["## Samples: `phase_sampling_test`, a million of every case", "",
             "Drawn in Lanes and float, against the integral of the density: the least of all cases' probabilities of a chi-square (some 250",
             "bins) and of a Kolmogorov distance as large. Of n cases the least is about 1/n; the tests fail at 1e-6.", "",
             "| law | cases | chi-square | Kolmogorov |", "|---|---|---|---|"]
    for suite in suites:
        for one in suite["testsuite"]:
            lines.append("| %s | %s | %s | %s |" % (suite["name"].split("/")[1], one["cases"], one["least_chi_square"], one["least_kolmogorov"]))
    return [*lines, ""]


def laws(program, folder):
    """The two tables of the laws' own errors."""
    errors, glsl = law_errors(folder), glsl_errors(program, folder)

    def text(x):
        return "inf" if x is None else "%.1e" % x

    lines = ["| law | cases | integral - 1 | mean cosine | chi_2 to chi_40 | inverse: F(mu(xi)) against xi |", "|---|---|---|---|---|---|"]
    for name, numbers in errors.items():
        r = numbers["reference"]
        lines.append("| %s | %d | %s |" % (name, r["cases"], " | ".join(text(r[k]) for k in ("integral", "mean_cosine", "moments", "inverse"))))
    for numbers in errors.values():
        numbers.pop("reference")
    for name, row in glsl.items():
        errors[name]["GLSL, executed"] = row
    order = {"float": 0, "Lanes": 1, "Dual": 2, "Symbol": 3, "GLSL": 4}
    columns = sorted(dict.fromkeys(c for numbers in errors.values() for c in numbers), key=lambda c: order[c.split(",")[0]])
    lines += ["", "Worst relative error of density / cumulative distribution / sample against double:", "",
              "| law | %s |" % " | ".join(columns), "|---|%s" % ("---|" * len(columns))]
    for name, numbers in errors.items():
        cells = [" / ".join(text(numbers[c][k]) for k in ("density", "cdf", "sample")) if c in numbers else "-" for c in columns]
        lines.append("| %s | %s |" % (name, " | ".join(cells)))
    return lines


# Measured by another script, by hand: it takes Blender and twenty minutes.
CYCLES = """## Another renderer: Blender's Cycles

`python3 scripts/race_cycles.py build/tyndall --folder race --sheet docs/pictures/cycles.png` (2026-11-23, Blender 3.4.1, 60 s a picture and two of each).
Tyndall, Cycles, and their difference over blocks of 8 x 8 pixels: blue where Cycles is darker, red where it is brighter, full at 20 %.

![Four scenes by Tyndall and by Cycles, and how they differ](pictures/cycles.png)

| scene | Cycles over Tyndall, means | why they differ |
|---|---|---|
| bank of fog, Henyey-Greenstein 0.85 | fog 1.002; ground 1.05 | sparks in Cycles' ground |
| cloud of 128 voxels | 1.0003, in every channel to 2e-4 | Cycles steps through grids: up to a tenth along edges |
| narrow spot in a closed room | 1.15 to 1.24 | a few sparks carry Cycles' mean (its relMSE is 85); blocks of the beam agree to 3 % |
| street with 200 lamps | floor about half, walls 1.2, both without air too | `scripts/cycles_scene.py` gives it diffuse surfaces, and that floor is seen at a grazing angle where glTF's mirrors |
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", default=os.path.join(HERE, "..", "build", "tyndall"), help="default: build/tyndall")
    parser.add_argument("truth", nargs="?", default=os.path.join(HERE, "..", "..", "shared", "acceptance", "public.json"),
                        help="the reference data, a .json; default: beside the source tree")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    with open(arguments.truth, encoding="utf-8") as file:
        truth = json.load(file)
    head = ["| category | values | worst z | chi-square | its 0.001 to 0.999 quantiles | largest standard error |", "|---|---|---|---|---|---|"]
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(program, folder)
        lines = [
            "# Accuracy", "",
            "Made by `python3 scripts/accuracy.py build/tyndall` against independently computed and published values (the reference data",
            "beside the source tree; not part of the project). The same cases and more are tests: `make test`. Categories of that data that",
            "have no row, mie_efficiencies and mie_angular, wait for Lorenz and Mie's theory of particles.", "",
            "## Laws in every number: `scripts/law_accuracy.cc`, `law_functions_test`", "",
            "The double form against quadrature over the sphere, at the tests' hard parameters (|g| to 0.9999) and xi from 1e-100 to 1 - 1e-15;",
            "the inverse relative to xi and to 1 - xi. Absolute errors but for the inverse.", "",
            *laws(program, folder), "",
            "Samples count relative to the nearer end, 1 - mu or 1 + mu, and to the condition of the inverse (a gap between lobes magnifies the",
            "rounding of xi). Dual: of the density its value, of the distribution and the sample their derivatives. Symbol: the recorded",
            "expression evaluated in double. 2e-6 is what the tests allow GLSL, 1e-6 float and Lanes (Fournier and Forand's law and mixtures",
            "with it 1e-5: powers of numbers over 18 decades).", "",
            *samples(program, folder),
            "## Phase functions (phase_functions) and fits (two_hg_fits): `tyndall phase`", "",
            "| law | worst relative error of p at 11 angles | worst absolute error of chi_0 to chi_8 | mu below which the backscattered part lies |",
            "|---|---|---|---|", *phases(bench, truth), "",
            "Angles reach the program as cosines, so the error of a forward peak is that of a rounded cosine.", "",
            "| category: misfits of two lobes to the laws they stand in for | fits | worst relative difference from what is stated |",
            "|---|---|---|", two_lobe_fits(bench, truth), "",
            *air_section(bench, truth), "",
            "## Multiple scattering: `tyndall slab`, %d paths" % PATHS, "",
            "z is (estimate - truth) / standard error, each figure's own (fluxes' and radiances' both stand in the program's JSON). Of",
            "mixtures_layers' two layers the stated T is that of light from below, as the same layers upside down have it.", "", *head, *slabs(bench, truth), "",
            "## Single scattering: `tyndall probe`", "",
            "| category | cases | single: worst relative error | path limited to one scattering, 20000 samples: worst z |", "|---|---|---|---|",
            *airlight(bench, truth), "",
            "`single` on the example scenes, surfaces included, against `path` limited to one scattering or bounce (20000 samples), green: what",
            "is not exact is its quadrature of sky, sun's disc and emissive meshes. `path` has its own noise, stated as one standard error.", "",
            "| scene | rays | median difference ± its standard error | worst |", "|---|---|---|---|", *whole_scenes(bench), "",
            *CYCLES.split("\n"),
            "## Point source in an infinite medium: `tyndall probe --fluence`, 100000 paths", "", *head, fluence(bench, truth), ""]
    os.makedirs(os.path.join(HERE, "..", "docs"), exist_ok=True)
    with open(os.path.join(HERE, "..", "docs", "accuracy.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main()
