#!/usr/bin/env python3
"""Fails when the tree under tyndall/ is not built the way ARCHITECTURE.md says: floor upon floor.

    floor_check.py [ROOT]         check ROOT (default: this repository)
    floor_check.py --self-test    plant each kind of violation in a temporary tree and see that it is found

A folder includes from floors below its own and from itself. From a sibling too, as long as the siblings do not end up
including each other in a ring; the outlets (floor 6) never do. Headers of floors 0 to 4 need the standard library only (those that end in
_test.h are tests and are not installed).
"""
import argparse
import pathlib
import re
import sys
import tempfile

FLOORS = {
    0: ["number"],
    1: ["geometry", "color", "sampling"],
    2: ["phase"],
    3: ["medium", "light"],
    4: ["artist", "particle"],
    5: ["document", "scene", "image"],
    6: ["render", "export", "plot"],
    7: ["cli", "designer", "python"],
}
FLOOR_OF = {folder: floor for floor, folders in FLOORS.items() for folder in folders}

LAST_OF_HEADERS = 4
OUTLETS = 6

# Names that say nothing about what is inside; nothing under the repository may be called so.
FORBIDDEN = {"utils", "util", "common", "core", "misc", "helpers", "helper"}

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]tyndall/([^/">]+)/', re.MULTILINE)
LIBRARY = re.compile(r"^\s*#\s*include\s*<((?!tyndall/)[^>]*[./][^>]*)>", re.MULTILINE)  # <vector> has no dot, no slash
LIBRARIES_OF = {"tyndall/number/lanes.h": {"xsimd/xsimd.hpp"}}  # where Lanes is asked for
SOURCES = {".h", ".cc", ".cpp", ".hpp", ".inl"}


def faults(root):
    """One line of text for each violation under root."""
    found = []
    tree = root / "tyndall"
    for path in sorted(p for p in root.rglob("*") if p.is_dir()):
        parts = path.relative_to(root).parts
        if parts[0].startswith(("build", ".")):
            continue
        if path.name.lower() in FORBIDDEN:
            found.append(f"{path.relative_to(root)}: a folder called '{path.name}' says nothing; name what it holds")
    leans = {}  # folder -> {sibling: where it includes it}
    for folder in sorted(p for p in tree.iterdir() if p.is_dir()):
        if folder.name not in FLOOR_OF:
            found.append(f"tyndall/{folder.name}: unknown folder; give it a floor in scripts/floor_check.py")
            continue
        for source in sorted(p for p in folder.rglob("*") if p.suffix in SOURCES):
            text = source.read_text(encoding="utf-8", errors="replace")
            name = str(source.relative_to(root))

            def place(match):
                return f"{name}:{text.count(chr(10), 0, match.start(1)) + 1}"

            if FLOOR_OF[folder.name] <= LAST_OF_HEADERS and source.suffix == ".h" and not name.endswith("_test.h"):
                found += [
                    f"{place(match)}: <{match.group(1)}>: floors 0 to {LAST_OF_HEADERS} need the standard library only"
                    for match in LIBRARY.finditer(text) if match.group(1) not in LIBRARIES_OF.get(name, ())
                ]
            for match in INCLUDE.finditer(text):
                target = match.group(1)
                fault = include_fault(folder.name, target)
                if fault:
                    found.append(f"{place(match)}: {fault}")
                elif target != folder.name and FLOOR_OF[target] == FLOOR_OF[folder.name]:
                    leans.setdefault(folder.name, {}).setdefault(target, place(match))
    return found + rings(leans)


def include_fault(folder, target):
    """What is wrong with `folder` including from `target`, or None."""
    if target not in FLOOR_OF:
        return f"includes tyndall/{target}/, which is no floor"
    own, other = FLOOR_OF[folder], FLOOR_OF[target]
    if other > own:
        return f"{folder} (floor {own}) includes {target} (floor {other}) above it"
    if other == own == OUTLETS and target != folder:
        return f"{folder} includes {target}: outlets do not know each other"
    return None


def rings(leans):
    """Siblings that include each other, directly or through others: one line for each include that closes a ring."""

    def reaches(start, goal, seen):
        return start == goal or any(
            reaches(n, goal, seen | {n}) for n in leans.get(start, ()) if n not in seen)

    return [
        f"{place}: {folder} includes {target}, which in turn stands on {folder}"
        for folder, targets in sorted(leans.items())
        for target, place in sorted(targets.items())
        if reaches(target, folder, {target})
    ]


def plant(root, files):
    for path, text in files.items():
        (root / path).parent.mkdir(parents=True, exist_ok=True)
        (root / path).write_text(text)


def self_test():
    """Each kind of violation alone must be found, and the tree it was planted in must be clean."""
    ring = {
        "tyndall/scene/a.h": '#include "tyndall/image/b.h"\n',
        "tyndall/image/b.h": '#include "tyndall/scene/a.h"\n',
    }
    plants = {
        "a higher floor": ({"tyndall/phase/a.h": '#include "tyndall/medium/b.h"\n'}, "above it"),
        "another outlet": ({"tyndall/render/a.cc": "# include <tyndall/export/b.h>\n"}, "outlets"),
        "an unknown folder": ({"tyndall/cloud/a.h": ""}, "unknown folder"),
        "an include from nowhere": ({"tyndall/phase/a.h": '#include "tyndall/cloud/b.h"\n'}, "no floor"),
        "a name that says nothing": ({"tyndall/render/utils/a.h": ""}, "says nothing"),
        "a library low down": ({"tyndall/light/a.h": "#include <nlohmann/json.hpp>\n"}, "standard library"),
        "siblings in a ring": (ring, "in turn"),
    }
    for what, (files, answer) in plants.items():
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            plant(root, {
                "tyndall/medium/good.h":
                    '#include <vector>\n#include "tyndall/medium/c.h"\n#include "tyndall/phase/d.h"\n',
                "tyndall/medium/good_test.h": "#include <gtest/gtest.h>\n",
                "tyndall/scene/good.h": '#include "tyndall/document/e.h"\n',
            })
            assert faults(root) == [], faults(root)
            plant(root, files)
            answers = faults(root)
            assert len(answers) == len(files) and all(answer in a for a in answers), f"{what}: {answers}"
    print(f"floor check: {len(plants)} planted violations found")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent.parent,
                        help="the tree to check (default: this repository)")
    parser.add_argument("--self-test", action="store_true",
                        help="plant each kind of violation in a temporary tree and see that it is found")
    arguments = parser.parse_args()
    if arguments.self_test:
        self_test()
        return 0
    found = faults(arguments.root)
    for fault in found:
        print(fault)
    if found:
        print(f"floor check: {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
