#!/usr/bin/env python3
"""headers.py PREFIX COMPILER..: every header installed under PREFIX compiles by itself, first in its file and twice: none leans on what
another happened to include. Lanes, which want xsimd, are left out where there is none."""
import concurrent.futures
import os
import subprocess
import sys

FLAGS = "-std=c++20 -fno-exceptions -fno-rtti -Wall -Wextra -Wconversion -Werror -fsyntax-only -x c++ -".split()


def main():
    include = os.path.abspath(os.path.join(sys.argv[1], "include"))
    headers = sorted(os.path.relpath(os.path.join(folder, name), include)
                     for folder, _, names in os.walk(include) for name in names if name.endswith(".h"))
    assert len(headers) > 60, headers

    def complaint(job):
        compiler, header = job
        done = subprocess.run([compiler, *FLAGS, "-I", include], input=f'#include "{header}"\n#include "{header}"\n',
                              capture_output=True, text=True, check=False, cwd="/")  # quotes look there first
        return f"{compiler}: {header}\n{done.stderr}" if done.returncode else ""

    compilers = sys.argv[2:]
    assert compilers
    xsimd = subprocess.run([compilers[0], *FLAGS], input="#include <xsimd/xsimd.hpp>\n", capture_output=True, text=True, check=False)
    if xsimd.returncode:
        headers = [name for name in headers if not name.startswith("tyndall/number/lane")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        complaints = [text for text in pool.map(complaint, [(c, h) for c in compilers for h in headers]) if text]
    print("\n".join(complaints) or f"{len(headers)} headers, each alone, by {' and '.join(compilers)}")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
