"""Marker posts: a dark plate with a distance in light digits, over a post with one to four bands."""

import math

from mesh import Material, Mesh

REFLECTOR = Material("marker, reflecting", (0.85, 0.85, 0.82), roughness=0.6, radiance=(0.5, 0.5, 0.48))
MARKER = Material("marker, dark", (0.012, 0.012, 0.014), roughness=0.8)

SEGMENTS = {"0": "abcdef", "1": "bc", "2": "abged", "5": "afgcd"}


def digit(mesh, material, character, x, y, width, height, z):
    """Seven segments of quads in the plane z, lower left corner at x, y."""
    bar = 0.2 * height
    half = 0.5 * (height - bar)
    columns, rows = (x, x + width - bar), (y, y + half, y + 2 * half)
    boxes = {
        "a": (x, rows[2], width, bar),
        "g": (x, rows[1], width, bar),
        "d": (x, rows[0], width, bar),
        "f": (columns[0], rows[1], bar, half + bar),
        "b": (columns[1], rows[1], bar, half + bar),
        "e": (columns[0], rows[0], bar, half + bar),
        "c": (columns[1], rows[0], bar, half + bar),
    }
    for segment in SEGMENTS[character]:
        left, bottom, across, up = boxes[segment]
        right, top = left + across, bottom + up
        mesh.quad(material, (left, bottom, z), (right, bottom, z), (right, top, z), (left, top, z))


def build(distance, bands, foot):
    """A plate with the distance in metres over a post with so many bands; the origin is the middle of the plate's
    face, and the post ends at y = foot.

    Plates grow with the square root of the distance: a true size would be unreadable at 200 m, a constant one would
    look near. They glow faintly toward the viewer, as retroreflecting sheet does in the viewer's own lights.
    """
    mesh = Mesh("marker %d m" % distance)
    size = math.sqrt(distance / 25.0)
    text = str(distance)
    high, wide = 0.36 * size, (0.3 * len(text) + 0.14) * size
    # The plate is dark with light digits and rim.
    mesh.box(MARKER, (-wide / 2, -high * 0.72, -0.05), (wide / 2, high * 0.72, -0.004))
    rim = 0.035 * size
    for low, top in ((-high * 0.72, -high * 0.72 + rim), (high * 0.72 - rim, high * 0.72)):
        mesh.quad(REFLECTOR, (-wide / 2, low, 0), (wide / 2, low, 0), (wide / 2, top, 0), (-wide / 2, top, 0))
    for k, character in enumerate(text):
        x = (0.3 * (k - len(text) / 2) + 0.04) * size
        digit(mesh, REFLECTOR, character, x, -high / 2, 0.22 * size, high, 0.0)
    half = 0.055 * size
    mesh.box(MARKER, (-half, foot, -0.1), (half, -high * 0.72, -0.05))
    for k in range(bands):
        bottom = -high * 0.72 - (0.17 + 0.17 * k) * size
        mesh.box(REFLECTOR, (-half - 0.01, bottom, -0.11), (half + 0.01, bottom + 0.1 * size, -0.04))
    return mesh
