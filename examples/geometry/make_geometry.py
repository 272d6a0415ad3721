#!/usr/bin/env python3
"""Writes the geometry of the three example scenes beside itself: street.glb, room.glb, landscape.glb.

    python3 examples/geometry/make_geometry.py [-o FOLDER] [NAME ...]

The same bytes on every run; the files in the repository are what this script writes.
"""

import argparse
import importlib
import os
import sys

sys.dont_write_bytecode = True

SCENES = ("street", "room", "landscape")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(description="Write the geometry of the example scenes.")
    parser.add_argument("-o", "--output", default=here, help="folder for the .glb files (default: beside this script)")
    parser.add_argument("names", nargs="*", help="which of: " + ", ".join(SCENES) + " (default: all)")
    arguments = parser.parse_args()
    for name in arguments.names:
        if name not in SCENES:
            parser.error("%r is no scene; there are %s" % (name, ", ".join(SCENES)))
    for name in arguments.names or SCENES:
        document = importlib.import_module(name).build()
        data = document.to_bytes()
        path = os.path.join(arguments.output, name + ".glb")
        with open(path, "wb") as file:
            file.write(data)
        print("%s: %d bytes, %d triangles" % (path, len(data), document.triangle_count))


if __name__ == "__main__":
    main()
