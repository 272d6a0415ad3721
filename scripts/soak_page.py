#!/usr/bin/env python3
"""Prints what runs of the long tests came to; with --write also writes docs/soak.md.

    make soak                                                 # runs them all and prints this at the end
    python3 scripts/soak_page.py --write build/soak.xml

RUN.xml is what `ctest --label-regex soak --output-junit RUN.xml` leaves. Of several runs the last word on each test counts, so a
failure that was mended can be run again by itself. Exit code 1 unless all passed. Python's standard library only.
"""
import argparse
import os
import re
import sys
import xml.etree.ElementTree

sys.dont_write_bytecode = True
PAGE = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "docs", "soak.md")

# Lines in which tests say how much they tried: tests/cases.h, rapidcheck, tests/schema_check.py, scripts/fuzz.sh.
CASES = (re.compile(r"^cases: (.+)$"), re.compile(r"^OK, passed (\d+ tests)$"), re.compile(r"^(\d+ read, \d+ refused for a part.*)$"),
         re.compile(r"^(\w+ +\d+ executions, .*)$"))


def tests_of(path):
    """name -> (seconds, result, what it tried), and the run's facts."""
    suite = xml.etree.ElementTree.parse(path).getroot()
    out = {}
    for case in suite.iter("testcase"):
        text = case.findtext("system-out") or ""
        tried = [match[1] for line in text.splitlines() for match in (form.match(line.strip()) for form in CASES) if match]
        failure = case.find("failure")
# One that ends itself, well or ill, says so in its last lines; one that crashes or is stopped by hand does not.
        stopped = failure is not None and not re.search(r"FAILED|PASSED|rror", text)
        skipped = case.find("skipped") is not None or case.get("status") not in ("run", "fail")
        result = "did not end" if stopped else "FAILED" if failure is not None else "not run" if skipped else "passed"
        out[case.get("name")] = (float(case.get("time") or 0), result, [re.sub(r" +", " ", t) for t in tried])
    return out, suite.get("timestamp", ""), suite.get("hostname", "")


def words_of(name):
    """A typed test by its law: SoakSamplesOf.Test<SoakSamplesOf/draine.  # TypeParam = ...> is draine: Test."""
    typed = re.match(r"(\w+)\.(\w+)<\w+/(\w+)\..*", name)
    return "%s/%s.%s" % (typed[1], typed[3], typed[2]) if typed else name


def duration(seconds):
    return "%.1f s" % seconds if seconds < 100 else "%d min %02d s" % divmod(round(seconds), 60)


def grouped(count):
    """Long numbers with thin gaps: 1000000 files becomes 1 000 000 files."""
    count = re.sub(r"^1 cases", "1 case", count)
    return re.sub(r"\d{5,}", lambda digits: "{:,}".format(int(digits[0])).replace(",", "\u202f"), count)


def page(runs):
    tests, days = {}, []
    for path in runs:
        found, stamp, _ = tests_of(path)
        tests.update({name: row for name, row in found.items() if row[1] not in ("not run", "did not end") or name not in tests})
        days.append(stamp[:10])
    lines = ["| test | tried | time | result |", "|---|---|---|---|"]
    for name, (seconds, result, tried) in sorted(tests.items(), key=lambda item: words_of(item[0])):
        lines.append("| %s | %s | %s | %s |" % (words_of(name), grouped("<br>".join(tried)) or "-", duration(seconds), result))
    results = [result for _, result, _ in tests.values()]
    total = sum(seconds for seconds, _, _ in tests.values())
    unfinished = results.count("not run") + results.count("did not end")
    summary = "%d tests, %s of work: %d passed, %d failed%s." % (
        len(tests), duration(total), results.count("passed"), results.count("FAILED"),
        ", %d did not end" % unfinished if unfinished else "")
    return lines, summary, sorted({day for day in days if day}), unfinished == 0 and "FAILED" not in results and "passed" in results


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", metavar="RUN.xml", nargs="+", help="what ctest left")
    parser.add_argument("--write", action="store_true", help="write docs/soak.md too")
    arguments = parser.parse_args()
    lines, summary, days, good = page(arguments.runs)
    if arguments.write:
        with open(PAGE, "w", encoding="utf-8") as file:
            file.write("\n".join([
                "# The long tests", "",
                "Made by `make soak` and `python3 scripts/soak_page.py --write build/soak.xml`. They are the tests whose suites have `Soak` in their",
                "names, and the fuzz targets: the same promises as `make test` holds, tried many times as often. Random ones have fixed seeds;",
                "libFuzzer's do not.", "",
                summary + (" Run on %s, on a busy machine." % " and ".join(days) if days else ""), "", *lines, ""]))
    else:
        print("\n".join(lines))
    print(summary)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
