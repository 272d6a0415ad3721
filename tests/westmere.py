#!/usr/bin/env python3
"""westmere.py QEMU PROGRAM: the program on an emulated 2010 processor without AVX gives the answers it gives here.

What it must not do is die of an instruction that machine lacks (cmake/kernels.cmake). Laws must agree to float
rounding; estimates only statistically, because the last bits of another instruction set lead to other random walks.
"""
import json
import math
import subprocess
import sys

QEMU, PROGRAM = sys.argv[1:]


def answer(prefix, arguments):
    command = [*prefix, PROGRAM, *arguments]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"exit code {done.returncode}: {' '.join(command)}\n{done.stderr}")
    return json.loads(done.stdout)


def both(arguments):
    return answer([], arguments), answer([QEMU, "-cpu", "Westmere"], arguments)


def agree(here, there, tolerance, what):
    """Numbers, or lists or objects of them, equal within a relative tolerance."""
    if isinstance(here, dict):
        assert here.keys() == there.keys(), what
        for key in here:
            agree(here[key], there[key], tolerance, f"{what}.{key}")
    elif isinstance(here, list):
        assert len(here) == len(there), what
        for i, (a, b) in enumerate(zip(here, there)):
            agree(a, b, tolerance, f"{what}[{i}]")
    elif isinstance(here, float):
        assert math.isclose(here, there, rel_tol=tolerance, abs_tol=tolerance), f"{what}: {here} here, {there} there"
    else:
        assert here == there, f"{what}: {here} here, {there} there"


def laws():
    for law in ("isotropic", "rayleigh", "henyey_greenstein:g=0.7", "mie_hazy", "mie_murky"):
        arguments = ["phase", law, "--at", "-1,-0.3,0.5,1", "--moments", "8", "--sample", "0,0.25,0.9,1", "--json"]
        here, there = both(arguments)
        agree(here, there, 2e-6, law)
    assert math.isclose(answer([QEMU, "-cpu", "Westmere"], ["phase", "isotropic", "--at", "0.5", "--json"])["density"][0],
                        1 / (4 * math.pi), rel_tol=1e-6)


def slab(medium):
    # Both estimates are of the same number: their difference is within 6 of its standard errors (false alarm 2e-9 each).
    here, there = both(["slab", medium, "--thickness", "100", "--mu0", "0.6", "--spp", "2000", "--seed", "7", "--json"])
    agree(here["transmittance_direct"], there["transmittance_direct"], 1e-6, "transmittance_direct")
    for name in ("reflectance", "transmittance_diffuse"):
        for a, b, ea, eb in zip(here[name], there[name], here["standard_error"][name], there["standard_error"][name]):
            assert a > 0 and abs(a - b) <= 6 * math.hypot(ea, eb) + 1e-9, f"slab {name}: {a} here, {b} there"


MEDIUM = {
    "format": "tyndall-medium/1",
    "name": "fog",
    "meters_per_unit": 1.0,
    "species": [{"name": "fog", "scattering": 0.02, "absorption": 0.001,
                 "phase": {"law": "henyey_greenstein", "g": 0.7}}],
}

if __name__ == "__main__":
    import pathlib
    import tempfile

    laws()
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "fog.medium.json"
        path.write_text(json.dumps(MEDIUM))
        slab(str(path))
    print("the program agrees with itself on a machine without AVX")
