#!/usr/bin/env python3
"""What docs/library.md shows is what is compiled, and prints what the page says.

    check.py --fix                                       writes the code of this folder into the page
    check.py --cmake CMAKE --prefix P [--built NAME=PROGRAM].. COMPILER..

On the page `<!-- walk.cc: ray -->` above a block of code names the part of tests/snippets/walk.cc between `// [ray]` and
`// [end]`, and `<!-- walk.cc prints -->` stands above what the program prints. Each program is built as strangers do, from
the package installed under P: with find_package by the first compiler, with a plain -I by the last. Those --built come
from this build, because they need one of its compiled libraries.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, "..", "..", "docs", "library.md")
FLAGS = "-std=c++20 -O1 -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Werror".split()
BLOCK = re.compile(r"<!-- (\w+)\.cc(?:: (\w+)| (prints)) -->\n```(\w+)\n(.*?)```\n", re.DOTALL)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def parts():
    """{(name, part): code} of all snippets."""
    found = {}
    for file in sorted(os.listdir(HERE)):
        if file.endswith(".cc"):
            for part, code in re.findall(r"^ *// \[(\w+)\]\n(.*?)^ *// \[end\]$", read(os.path.join(HERE, file)),
                                         re.MULTILINE | re.DOTALL):
                found[file[:-3], part] = textwrap.dedent(code)
    return found


def fix():
    known = parts()

    def block(match):
        name, part, prints, language, _ = match.groups()
        return match[0] if prints else f"<!-- {name}.cc: {part} -->\n```{language}\n{known[name, part]}```\n"

    text = BLOCK.sub(block, read(PAGE))
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


def page_is_the_code():
    """Returns {name: what the page says it prints}."""
    known, shown, prints = parts(), set(), {}
    text = read(PAGE)
    assert len(re.findall(r"^```(?:cpp|text)$", text, re.MULTILINE)) == len(BLOCK.findall(text)), "a block without its comment"
    for name, part, is_output, _, body in BLOCK.findall(text):
        if is_output:
            prints[name] = body
            continue
        assert (name, part) in known, f"docs/library.md: no part [{part}] in {name}.cc"
        assert known[name, part] == body, f"docs/library.md: {name}.cc [{part}] reads differently; check.py --fix"
        shown.add((name, part))
    assert shown == set(known), f"not on the page: {set(known) - shown}"
    assert set(prints) == {name for name, _ in known}, "a snippet whose output is not on the page"
    return prints


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{' '.join(command)}: exit {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--fix", action="store_true")
    parser.add_argument("--cmake")
    parser.add_argument("--prefix")
    parser.add_argument("--built", action="append", default=[])
    parser.add_argument("compilers", nargs="*")
    arguments = parser.parse_args()
    if arguments.fix:
        return fix()
    arguments.prefix = os.path.abspath(arguments.prefix)
    prints = page_is_the_code()
    built = dict(pair.split("=", 1) for pair in arguments.built)
    installed = sorted(set(prints) - set(built))
    assert installed and arguments.compilers
    with tempfile.TemporaryDirectory() as scratch:
        source, build = os.path.join(scratch, "source"), os.path.join(scratch, "build")
        shutil.copytree(HERE, source)

        def with_plain_path(name):
            program = os.path.join(scratch, "plain_" + name)
            run(arguments.compilers[-1], *FLAGS, "-I", os.path.join(arguments.prefix, "include"), os.path.join(source, name + ".cc"), "-o", program)
            return program

        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            programs = list(zip(installed, pool.map(with_plain_path, installed)))
        run(arguments.cmake, "-S", source, "-B", build, "-G", "Ninja", "-DSNIPPETS=" + ";".join(installed),
            "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_COMPILER=" + arguments.compilers[0],
            "-DCMAKE_PREFIX_PATH=" + arguments.prefix, "-DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF")
        run(arguments.cmake, "--build", build, "-j", "2")
        programs += [(name, os.path.join(build, name)) for name in installed] + list(built.items())
        for name, program in programs:
            printed = run(program)
            assert printed == prints[name], f"{program} printed\n{printed}and the page says\n{prints[name]}"
    print(f"{len(prints)} snippets, {len(programs)} programs: as on the page")
    return None


if __name__ == "__main__":
    sys.exit(main())
