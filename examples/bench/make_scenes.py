#!/usr/bin/env python3
"""Writes the scenes that the renderer is raced on, which scripts/convergence.py measures.

    python3 examples/bench/make_scenes.py -o FOLDER

    spot   a narrow spot in thin fog inside a closed room: bright order 1, and later orders that all pass near one lamp
    bank   a bank of dense forward-scattering fog under sun and sky: many orders
    lamps  a street with 200 lamps in mist: which lamp to look at

The same bytes on every run; geometry comes from the helpers of examples/geometry.
"""

import argparse
import json
import os
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "geometry"))

from glb import Document  # noqa: E402  (beside the example scenes' geometry)
from mesh import Material, Mesh  # noqa: E402

WALL = Material("wall", (0.6, 0.57, 0.52), roughness=1.0)
WOOD = Material("wood", (0.35, 0.22, 0.12), roughness=0.7)
ASPHALT = Material("asphalt", (0.06, 0.06, 0.065), roughness=0.8)
HOUSE = Material("house", (0.3, 0.27, 0.23), roughness=1.0)
GRASS = Material("grass", (0.1, 0.14, 0.06), roughness=1.0)


def fog(scattering, g, absorption=0.0):
    phase = {"law": "henyey_greenstein", "g": g}
    species = {"name": "fog", "scattering": scattering, "absorption": absorption, "phase": phase}
    return {"format": "tyndall-medium/1", "background": {"air": "none"}, "species": [species]}


def scene(name, camera, lights, medium=None, volumes=None):
    out = {"format": "tyndall-scene/1", "name": name, "meters_per_unit": 1, "geometry": [name + ".glb"], "lights": lights,
           "camera": camera, "film": {"width": 512, "height": 512}, "integrator": {"name": "path", "spp": 64, "max_depth": 0}}
    if medium:
        out["medium"] = medium
    if volumes:
        out["volumes"] = volumes
    return out


def spot():
    """A room of 10 x 6 x 10 m, closed; the beam crosses the view and ends on the wall behind a table."""
    mesh = Mesh("room")
    # From inside: the box's faces turned inward by going round the other way.
    low, high = (-5.0, 0.0, -5.0), (5.0, 6.0, 5.0)
    (x, y, z), (X, Y, Z) = low, high
    for face in ([(x, y, Z), (X, y, Z), (X, y, z), (x, y, z)], [(x, Y, z), (X, Y, z), (X, Y, Z), (x, Y, Z)],
                 [(x, y, z), (X, y, z), (X, Y, z), (x, Y, z)], [(X, y, Z), (x, y, Z), (x, Y, Z), (X, Y, Z)],
                 [(x, y, Z), (x, y, z), (x, Y, z), (x, Y, Z)], [(X, y, z), (X, y, Z), (X, Y, Z), (X, Y, z)]):
        mesh.polygon(WALL, face)
    mesh.box(WOOD, (0.5, 0.0, -2.5), (2.5, 0.9, -1.0))
    mesh.box(WOOD, (-3.0, 0.0, -3.5), (-2.2, 2.6, -2.7))
    document = Document("spot")
    document.node("room", mesh)
    lamp = {"type": "spot", "position": [-4.0, 5.0, -1.5], "direction": [5.5, -4.1, -0.2], "intensity": 400,
            "inner_angle": 7, "outer_angle": 7}
    camera = {"position": [0.4, 2.2, 4.7], "look_at": [0, 2.3, -5], "up": [0, 1, 0], "vertical_fov": 52}
    return document, scene("spot", camera, [lamp], medium=fog(0.05, 0.7))


def bank():
    """Fog of 10 m in a meadow, albedo 0.999; sun from behind it and sky."""
    mesh = Mesh("meadow")
    mesh.polygon(GRASS, [(-400, 0, 400), (400, 0, 400), (400, 0, -400), (-400, 0, -400)])
    for k, x in enumerate((-9.0, -2.5, 6.0)):
        mesh.box(HOUSE, (x, 0.0, -9.0 - 4 * k), (x + 2.0, 6.0 + k, -7.0 - 4 * k))
    document = Document("bank")
    document.node("meadow", mesh)
    lights = [{"type": "sun", "direction": [0.5, -0.45, 0.75], "irradiance": [20, 18, 14], "angular_diameter": 0.53},
              {"type": "environment", "radiance": [0.6, 0.9, 1.5]}]
    camera = {"position": [0, 3, 16], "look_at": [0, 4, 0], "up": [0, 1, 0], "vertical_fov": 50}
    volume = {"medium": fog(0.999, 0.85, 0.001), "profile": {"law": "box", "min": [-14, -0.5, -10], "max": [14, 7, 0]}}
    return document, scene("bank", camera, lights, volumes=[volume])


def lamps():
    """Two rows of 100 lamps, 6 m high and 8 m apart, between houses, in mist of 150 m visibility that lies low."""
    mesh = Mesh("street")
    mesh.polygon(ASPHALT, [(-60, 0, 20), (60, 0, 20), (60, 0, -900), (-60, 0, -900)])
    for k in range(60):
        height = 7.0 + (k * 7 % 5)
        for low, high in ((-17.0, -9.0), (9.0, 17.0)):
            mesh.box(HOUSE, (low, 0.0, -15.0 * k - 13.0), (high, height, -15.0 * k), skip="y")
    document = Document("lamps")
    lights = []
    for k in range(100):
        for side in (-1, 1):
            x, z = 5.0 * side, 4.0 - 8.0 * k + 2.0 * side
            mesh.box(WOOD, (x + 0.95 * side, 0.0, z - 0.06), (x + 1.05 * side, 6.2, z + 0.06), skip="y")
            color = ((90, 50, 17), (60, 66, 72), (84, 60, 34))[(k + side) % 3]
            lights.append({"type": "point", "position": [x, 6.0, z], "intensity": color})
    lights.append({"type": "environment", "radiance": [0.01, 0.015, 0.03]})
    document.node("street", mesh)
    medium = fog(0.02, 0.75, 0.0005)
    medium["species"][0]["profile"] = {"law": "exponential", "scale_height": 15}
    camera = {"position": [-1, 1.7, 14], "look_at": [0, 3.0, -60], "up": [0, 1, 0], "vertical_fov": 45}
    return document, scene("lamps", camera, lights, medium=medium)


SCENES = {"spot": spot, "bank": bank, "lamps": lamps}


def write(folder, names=SCENES):
    """Writes NAME.glb and NAME.scene.json into the folder; the paths of the scenes by name."""
    os.makedirs(folder, exist_ok=True)
    paths = {}
    for name in names:
        document, description = SCENES[name]()
        with open(os.path.join(folder, name + ".glb"), "wb") as file:
            file.write(document.to_bytes())
        paths[name] = os.path.join(folder, name + ".scene.json")
        with open(paths[name], "w", encoding="utf-8") as file:
            json.dump(description, file, indent=1)
            file.write("\n")
    return paths


def main():
    parser = argparse.ArgumentParser(description="Write the scenes of the renderer's races.")
    parser.add_argument("-o", "--output", required=True, help="folder for the files")
    for path in write(parser.parse_args().output).values():
        print(path)


if __name__ == "__main__":
    main()
