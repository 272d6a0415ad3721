#!/usr/bin/env python3
"""pages_test.py PROGRAM: what README.md and docs/files.md tell a reader to type works, and scripts/exr.py reads what comes out.

The README's commands are run as they stand, but for the program's place, what they write to /tmp, and a picture of few samples.
"""
import json
import math
import os
import re
import shlex
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import accuracy  # noqa: E402
import exr  # noqa: E402


def blocks(page, language):
    with open(os.path.join(ROOT, page), encoding="utf-8") as file:
        return re.findall(r"^```%s\n(.*?)^```" % language, file.read(), re.MULTILINE | re.DOTALL)


def run(*command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, "%s: exit %d\n%s" % (shlex.join(command), done.returncode, done.stderr)
    return done.stdout


def scripts_explain_themselves(_program, _folder):
    for name in sorted(os.listdir(os.path.join(ROOT, "scripts"))):
        if name.endswith(".py"):
            said = run(sys.executable, os.path.join("scripts", name), "--help")
            assert len(said) > 60, name + " --help says " + said


def promised_sizes_are_kept(_program, _folder):
    for name, lines in (("CONTRIBUTING.md", 20), ("examples/minimal.cc", 30)):
        with open(os.path.join(ROOT, name), encoding="utf-8") as file:
            text = file.read().splitlines()
        assert len(text) <= lines and max(map(len, text)) <= 120, "%s: %d lines" % (name, len(text))


def readme_commands_work(program, folder):
    count = 0
    for block in blocks("README.md", "sh"):
        for line in block.splitlines():
            if not line.startswith("build/tyndall"):
                assert not line or line.startswith("make "), "not tried: " + line
                continue
            line = line.replace("/tmp/", folder + "/").replace("--spp 32", "--spp 1").replace("--size 480x270", "--size 48x27")
            run(program, *shlex.split(line, comments=True)[1:])
            count += 1
    assert count >= 6, count


def examples_of_files_page_are_read(program, folder):
    media = scenes = 0
    for block in blocks("docs/files.md", "json"):
        content = json.loads(block)
        if content["format"] == "tyndall-medium/1":
            path = os.path.join(folder, "page.medium.json")
            with open(path, "w", encoding="utf-8") as file:
                file.write(block)
            shown = json.loads(run(program, "show", path, "--json"))
            # Visibility of the model alone, which background, veil and soot shorten; the patchy fog holds it.
            least, most = (119.9, 120.1) if "Patchy" in shown["name"] else (500, 600)
            assert least < shown["visibility_5"][1] < most, shown
            media += 1
        else:
            path = os.path.join(folder, "page.scene.json")
            with open(path, "w", encoding="utf-8") as file:
                file.write(re.sub(r'"((media|geometry)/[^"]*)"', lambda m: json.dumps(os.path.join(ROOT, "examples", m[1])), block))
            run(program, "probe", path, "--origin", "0,2,0", "--direction", "0,0,-1", "--distance", "3", "--allow-path", "--json")
            scenes += 1
    assert (media, scenes) == (4, 3), (media, scenes)


def exr_layers_add_up_to_the_picture(program, folder):
    """19 lines: more than one block of 16, and not a whole number of them."""
    path = os.path.join(folder, "layers.exr")
    run(program, "render", "examples/street.scene.json", "--quiet", "--size", "33x19", "--spp", "2", "-o", path)
    width, height, planes = exr.read(path)
    assert (width, height) == (33, 19)
    total = 0.0
    for c in "RGB":
        for i, value in enumerate(planes[c]):
            for layers in (("surface.", "single.", "multiple."), ("surface.", "order1.", "order2.", "order3.")):
                parts = sum(planes[layer + c][i] for layer in layers)
                assert math.isclose(value, parts, rel_tol=1e-5, abs_tol=1e-12), (c, i, value, layers, parts)
            total += value
    assert total > 0.0
    assert any(math.isinf(z) for z in planes["depth.Z"]) and any(0.0 < z < 1000.0 for z in planes["depth.Z"])


def chi_square_quantiles_are_those_of_tables(_program, _folder):
    for n, low, high in ((1, 1.57e-6, 10.828), (5, 0.2102, 20.515), (40, 17.916, 73.402)):
        assert math.isclose(accuracy.chi_square_quantile(0.001, n), low, abs_tol=1e-3)
        assert math.isclose(accuracy.chi_square_quantile(0.999, n), high, abs_tol=1e-3)


def main():
    program = os.path.abspath(sys.argv[1])
    for test in (readme_commands_work, examples_of_files_page_are_read, exr_layers_add_up_to_the_picture,
                 chi_square_quantiles_are_those_of_tables, scripts_explain_themselves, promised_sizes_are_kept):
        with tempfile.TemporaryDirectory() as folder:
            test(program, folder)
        print("ok", test.__name__)


if __name__ == "__main__":
    main()
