#!/usr/bin/env python3
"""Writes docs/laws/, a page for each law, or says whether they are current.

A page holds what the law's own header says of it: its sentence and comment (formula, source, range), its fields as the
schema states them, and figures that the program computes. Standard library only.

    python3 scripts/law_pages.py build/tyndall
"""
import argparse
import json
import os
import re
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
PAGES = os.path.join(ROOT, "docs", "laws")
# Figures of laws whose parameters have no default worth showing, at ordinary ones.
EXAMPLES = {
    "henyey_greenstein": "g=0.7",
    "rayleigh": "depolarisation=0.0279",
    "schlick": "k=0.7",
    "cornette_shanks": "g=0.7",
    "draine": "g=0.7,alpha=1",
    "droplet": "diameter=10",
    "fournier_forand": "n=1.1,slope=3.5835",
}


def run(program, *arguments):
    return subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout


def comment_of(name):
    """The comment above the law's struct, as a paragraph of Markdown for each of its own."""
    folder = os.path.join(ROOT, "tyndall", "phase")
    with open(os.path.join(folder, name + ".h"), encoding="utf-8") as file:
        text = file.read()
    struct = "".join(word.capitalize() for word in name.split("_"))
    found = re.search(r"((?:^///.*\n)+)template <class T>\nstruct " + struct + r" \{", text, re.MULTILINE)
    lines = [line[3:].strip() for line in found.group(1).splitlines()]
    paragraphs = "\n".join(lines).split("\n\n")
    return "\n\n".join(" ".join(p.split("\n")).replace("*", "\\*") for p in paragraphs)


def cell(value):
    return str(value).replace("|", "\\|").replace("\n", " ")


def range_of(schema):
    parts = []
    for key, word in (("minimum", "at least"), ("exclusiveMinimum", "above"), ("maximum", "at most"),
                      ("exclusiveMaximum", "below")):
        if key in schema:
            parts.append(f"{word} {schema[key]:g}")
    if not parts and "items" in schema:
        inner = schema["items"].get("anyOf", [schema["items"]])[0]
        return "list: " + range_of(inner)
    return ", ".join(parts) or "as described"


def fields_of(schema, name):
    """Rows for the parameters of a law, from the schema that the program prints."""
    for rule in schema["definitions"]["phase"]["allOf"]:
        if rule["if"]["properties"]["law"]["const"] == name:
            return [(key, s) for key, s in rule["then"].get("properties", {}).items() if key != "law"], rule["then"]
    raise SystemExit(f"law pages: no law {name} in the schema")


def page(program, schema, name, sentence):
    lines = [f"# `{name}`", "", sentence, "", comment_of(name), ""]
    fields, rule = fields_of(schema, name)
    if fields:
        lines += ["| parameter | range | default | what |", "|---|---|---|---|"]
        for key, field in fields:
            default = "to be stated" if key in rule.get("required", []) else json.dumps(field.get("default"))
            default = "none" if default == "null" else default
            lines.append(f"| `{key}` | {range_of(field)} | {cell(default)} | {cell(field.get('description', ''))} |")
        lines.append("")
    if name in EXAMPLES or not fields:
        law = name + (":" + EXAMPLES[name] if name in EXAMPLES else "")
        command = ["phase", law, "--at", "1,0.5,0,-0.5,-1", "--moments", "4", "--json"]
        out = json.loads(run(program, *command))
        lines += [f"`build/tyndall {' '.join(command)}`:", "", "| cosine of the deflection | density [1/sr] |", "|---|---|"]
        lines += [f"| {mu:g} | {p:.5g} |" for mu, p in zip(out["mu"], out["density"])]
        moments = ", ".join(f"{x:.4f}" for x in out["legendre"][1:])
        lines += ["", f"Mean cosine {out['mean_cosine']:.4f}; Legendre moments 1 to 4: {moments}.", ""]
        lines += [f"Draw it: `build/tyndall plot {law} -o law.svg`.", ""]
    lines.append("Errors of every number type: [accuracy.md](../accuracy.md); speed: [bench.md](../bench.md).")
    return "\n".join(lines) + "\n"


def pages(program):
    schema = json.loads(run(program, "schema", "medium"))
    law = schema["definitions"]["phase"]["properties"]["law"]
    sentences = dict(line.split(": ", 1) for line in law["description"].split("\n"))
    out = {name + ".md": page(program, schema, name, sentences[name]) for name in law["enum"]}
    index = ["# Laws", "", "Made by `python3 scripts/law_pages.py build/tyndall` from the laws' own headers.", "",
             "| law | what |", "|---|---|"]
    index += [f"| [`{name}`]({name}.md) | {sentences[name]} |" for name in law["enum"]]
    out["README.md"] = "\n".join(index) + "\n"
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="build/tyndall")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 where a page is not current")
    arguments = parser.parse_args()
    program = os.path.abspath(arguments.program)
    made = pages(program)
    if not arguments.check:
        os.makedirs(PAGES, exist_ok=True)
        for name, text in made.items():
            with open(os.path.join(PAGES, name), "w", encoding="utf-8") as file:
                file.write(text)
        return
    stale = sorted(set(made) ^ set(os.listdir(PAGES)))
    for name, text in made.items():
        path = os.path.join(PAGES, name)
        if os.path.exists(path) and open(path, encoding="utf-8").read() != text:
            stale.append(name)
    if stale:
        sys.exit(f"law pages: {', '.join(stale)} not current; to write them anew: python3 scripts/law_pages.py build/tyndall")


if __name__ == "__main__":
    main()
