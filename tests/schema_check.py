#!/usr/bin/env python3
"""schema_check.py [VERDICTS]: holds the committed schemas against files, with the validator python3-jsonschema.

Without argument: the schemas are sound draft-07, their own defaults and examples fit them, every example file fits, and
every bad file of the tests does not, but for those whose fault no schema can see. With one: a file of lines that
tests/schema_test.cc wrote, each a JSON text with what the reader says of it: both must agree.
"""
import collections
import glob
import json
import os
import sys

from jsonschema import Draft7Validator

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

# Bad files of tests/bad/ whose fault lies between values or in what they come to: docs/files.md, "What a schema cannot say".
BEYOND_A_SCHEMA = {
    "base_absent.medium.json",  # what a name leads to
    "base_is_bad.medium.json",  # a dial of a model that only the base names
    "base_long_name.medium.json",
    "base_of_itself.medium.json",
    "base_outside.medium.json",
    "base_unknown.medium.json",
    "base_out_of_range.medium.json",  # denser than numbers can hold, once multiplied out
    "altitude_in_space.medium.json",  # in metres
    "box_inside_out.medium.json",  # one corner against the other
    "profile_list_bad_member.medium.json",  # bottom against top
    "profile_list_nowhere.medium.json",  # what comes to the origin
    "measured_beyond_air.medium.json",
    "measured_haze_of_drops.medium.json",  # one dial against another
    "ozone_in_the_ultraviolet.medium.json",
    "camera_looks_nowhere.scene.json",  # look_at against position
    "camera_up_along_view.scene.json",
    "held_visibility_out_of_reach.medium.json",
    "keyframe_visibility_out_of_reach.medium.json",
    "keyframes_backwards.medium.json",  # one time against another
    "keyframes_same_time.medium.json",
    "keyframes_unlike_models.medium.json",  # one key against another
    "keyframes_unlike_profiles.medium.json",
    "film_too_large.scene.json",  # a product
    "geometry_absent.scene.json",  # what a name leads to
    "geometry_is_a_folder.scene.json",
    "inner_above_outer.scene.json",  # one angle against the other
    "medium_absent.scene.json",
    "medium_name_empty.scene.json",
    "medium_outside.scene.json",
    "second_environment.scene.json",
    "table_absolute_file.medium.json",
    "table_falling.medium.json",  # one angle against another
    "table_file_is_folder.medium.json",
    "table_of_nothing.medium.json",  # two empty lists
    "table_of_one.medium.json",
    "table_of_zeros.medium.json",
    "table_too_few_values.medium.json",  # one list against the other
    "unit_too_small.medium.json",
    "volume_box_inside_out.scene.json",
    "volume_grid_absent.scene.json",
    "volume_grid_is_no_vdb.scene.json",
}
# What objection_to() says where demands_of() tells schemas the same.
ALSO_IN_SCHEMAS = ("without coefficients", "density beside", "albedo without", "no parts", "both file and radiance",
                   "neither file nor radiance", "the integrator ", "keyframes beside",
                   "no keyframes")


class NotJson(Exception):
    pass


def strict(text):
    """Parses as RFC 8259 and Tyndall demand; Python alone takes NaN and repeated keys."""
    try:
        text = text.decode("utf-8-sig") if isinstance(text, bytes) else text
    except UnicodeDecodeError as error:
        raise NotJson from error

    def once(pairs):
        if len(dict(pairs)) != len(pairs):
            raise NotJson
        return dict(pairs)

    def no_constant(_):
        raise NotJson

    try:
        value = json.loads(text, object_pairs_hook=once, parse_constant=no_constant)
    except (ValueError, RecursionError) as error:
        raise NotJson from error

    def check(x, depth):
        if depth > 64 or isinstance(x, (int, float)) and abs(x) > sys.float_info.max:
            raise NotJson
        if isinstance(x, str):
            try:
                x.encode("utf-8")
            except UnicodeEncodeError as error:
                raise NotJson from error
        for y in x.values() if isinstance(x, dict) else x if isinstance(x, list) else ():
            check(y, depth + 1)

    check(value, 1)
    return value


def load_schemas():
    schemas = {}
    for kind in ("medium", "scene"):
        with open(os.path.join(ROOT, "schema", "tyndall-%s-1.schema.json" % kind), encoding="utf-8") as file:
            schema = json.load(file)
        Draft7Validator.check_schema(schema)
        schemas[kind] = Draft7Validator(schema)
    return schemas


def faults(validator, value):
    return ["%s at /%s" % (e.message[:200], "/".join(map(str, e.absolute_path))) for e in validator.iter_errors(value)]


def defaults_and_examples_fit(schemas):
    count = 0

    def walk(schema, validator):
        nonlocal count
        if isinstance(schema, list):
            for part in schema:
                walk(part, validator)
        elif isinstance(schema, dict):
            for example in schema.get("examples", []) + ([schema["default"]] if "default" in schema else []):
                found = faults(validator.evolve(schema=schema), example)
                assert not found, (example, found)
                count += 1
            for key, part in schema.items():
                if key not in ("examples", "default", "const", "enum"):
                    walk(part, validator)

    for validator in schemas.values():
        root = validator.schema
        # A part refers to the definitions of the whole: the resolver keeps that.
        walk(root, Draft7Validator(root))
    assert count > 40, count
    return "%d defaults and examples" % count


def kind_of(path):
    return path.split(".")[-2]


def example_files_fit(schemas):
    count = 0
    for path in glob.glob(os.path.join(ROOT, "**", "*.json"), recursive=True):
        inside = os.path.relpath(path, ROOT)
        if not path.endswith((".medium.json", ".scene.json")) or inside.startswith(("build", os.path.join("tests", "bad"))):
            continue
        with open(path, "rb") as file:
            found = faults(schemas[kind_of(path)], strict(file.read()))
        assert not found, (inside, found)
        count += 1
    assert count >= 10, count
    return "%d good files" % count


def bad_files_do_not_fit(schemas):
    refused, not_json, beyond = 0, 0, 0
    for path in sorted(glob.glob(os.path.join(ROOT, "tests", "bad", "*", "*.json"))):
        name = os.path.basename(path)
        with open(path, "rb") as file:
            try:
                value = strict(file.read())
            except NotJson:
                not_json += 1
                continue
        found = faults(schemas[kind_of(path)], value)
        if name in BEYOND_A_SCHEMA:
            assert not found, "%s: the schema sees it after all: %s" % (name, found)
            beyond += 1
        else:
            assert found, "%s: the schema takes it" % name
            refused += 1
    assert refused > 60, refused
    return "%d bad files refused, %d more are no JSON, %d are beyond a schema" % (refused, not_json, beyond)


def reader_agrees(schemas, path):
    count = collections.Counter()
    with open(path, encoding="utf-8") as file:
        for line in file:
            case = json.loads(line)
            verdict, said = case["verdict"], case["said"]
            fits = schemas[case["kind"]].is_valid(json.loads(case["text"]))
            if verdict == "read":
                agree = fits
            elif verdict == "parts":
                agree = not fits
            elif "base" in json.loads(case["text"]):
                agree = True  # the base may be what they do not go with
            else:  # parts that do not go together
                agree = not (fits and any(phrase in said for phrase in ALSO_IN_SCHEMAS))
            assert agree, "the schema %s, the reader says: %s\n%s\n%s" % (
                "takes it" if fits else "does not", said or "fine", case["text"],
                "\n".join(faults(schemas[case["kind"]], json.loads(case["text"]))))
            count[verdict] += 1
            count["whole, refused"] += verdict == "whole" and not fits
    total = count["read"] + count["parts"] + count["whole"]
    # All three happen often, or the agreement would say little.
    for verdict in ("read", "parts", "whole"):
        assert count[verdict] * 100 >= total, count
    return "%d read, %d refused for a part, %d as a whole (%d of these by the schema too)" % (
        count["read"], count["parts"], count["whole"], count["whole, refused"])


def main():
    schemas = load_schemas()
    if len(sys.argv) > 1:
        print(reader_agrees(schemas, sys.argv[1]))
    else:
        for test in (defaults_and_examples_fit, example_files_fit, bad_files_do_not_fit):
            print("ok", test(schemas))


if __name__ == "__main__":
    try:
        main()
    except AssertionError as failed:
        sys.exit("schema_check: %s" % (failed.args[0] if len(failed.args) == 1 else failed.args,))
