"""An old library: tall arched windows in the left wall, and sun that comes through them toward the camera.

The room is closed, so that only the windows let light in. The sun, the sky and the haze inside are in the scene file.
"""

import math
import random

import furniture
import texture
from glb import Document, perspective_camera
from mesh import Material, Mesh
from vector import rotation_about_y, rotation_to_look

CAMERA = (4.3, 1.55, 1.2)
LOOK_AT = (-3.4, 2.2, -8.0)
VERTICAL_FOV = 42.0

# Inside measures: windows in the wall at x = LEFT.
LEFT, RIGHT, BACK, FRONT, HEIGHT = -6.0, 6.0, -14.0, 3.0, 6.4
WALL = 0.55  # thickness

PITCH = 3.1
WINDOWS = [1.1 - PITCH * k for k in range(5)]  # z of their middles
HALF_WIDTH, SILL, SPRING = 0.84, 0.95, 4.2  # the arch starts at SPRING and rises by HALF_WIDTH
ARC = 12

PLANKS = Material("floor boards", (0.9, 0.84, 0.78), roughness=0.55, texture=texture.planks(), tile=2.0)
PLASTER = Material("plaster", (0.46, 0.41, 0.33), roughness=0.95)
REVEAL = Material("window reveal", (0.5, 0.46, 0.38), roughness=0.9)
PANEL = Material("wainscot", (0.13, 0.072, 0.04), roughness=0.5)
STONE = Material("column stone", (0.42, 0.385, 0.33), roughness=0.8)
BAR = Material("window bar", (0.03, 0.026, 0.022), roughness=0.6)
BEAM = Material("ceiling beam", (0.1, 0.062, 0.036), roughness=0.8)
RUG = Material("rug, field", (0.3, 0.03, 0.026), roughness=1.0)
RUG_BORDER = Material("rug, border", (0.025, 0.03, 0.07), roughness=1.0)
RUG_LINE = Material("rug, line", (0.3, 0.21, 0.09), roughness=1.0)
OUTSIDE = Material("outside wall", (0.3, 0.27, 0.23), roughness=1.0)
CANVAS = Material("painting", (0.1, 0.08, 0.06), roughness=0.4)


def outline():
    """A window's edge as (z off its middle, height): from the foot at low z over the arch to the other foot."""
    points = [(-HALF_WIDTH, SILL), (-HALF_WIDTH, SPRING)]
    for k in range(1, ARC):
        angle = math.pi * (1 - k / ARC)
        points.append((HALF_WIDTH * math.cos(angle), SPRING + HALF_WIDTH * math.sin(angle)))
    return points + [(HALF_WIDTH, SPRING), (HALF_WIDTH, SILL)]


def window_wall():
    """Both faces of the left wall with its holes, and the reveals between them."""
    mesh = Mesh("window wall")
    inner, outer = LEFT, LEFT - WALL

    def face(z0, z1, y0, y1, lower):
        for x, material in ((inner, lower), (outer, OUTSIDE)):
            points = [(x, y0, z1), (x, y0, z0), (x, y1, z0), (x, y1, z1)]
            mesh.polygon(material, points if x == inner else points[::-1])

    edge = FRONT
    for middle in WINDOWS:
        z0, z1 = middle - HALF_WIDTH, middle + HALF_WIDTH
        face(z1, edge, SILL, HEIGHT, PLASTER)
        face(z1, edge, 0.0, SILL, PANEL)
        face(z0, z1, 0.0, SILL, PANEL)
        points = outline()
        for (za, ya), (zb, yb) in zip(points[1:], points[2:-1]):
            for x, material in ((inner, PLASTER), (outer, OUTSIDE)):
                quad = [(x, ya, middle + za), (x, HEIGHT, middle + za), (x, HEIGHT, middle + zb), (x, yb, middle + zb)]
                mesh.polygon(material, quad if x == inner else quad[::-1])
        for (za, ya), (zb, yb) in zip(points, points[1:]):
            za, zb = middle + za, middle + zb
            mesh.quad(REVEAL, (outer, ya, za), (outer, yb, zb), (inner, yb, zb), (inner, ya, za))
        mesh.quad(REVEAL, (outer, SILL, z0), (inner, SILL, z0), (inner, SILL, z1), (outer, SILL, z1))
        mesh.box(PANEL, (inner, SILL - 0.05, z0 - 0.1), (inner + 0.12, SILL, z1 + 0.1), skip="x")
        edge = z0
    face(BACK, edge, SILL, HEIGHT, PLASTER)
    face(BACK, edge, 0.0, SILL, PANEL)
    mesh.box(PANEL, (inner, SILL - 0.13, BACK), (inner + 0.04, SILL - 0.05, FRONT), skip="xzZ")
    mesh.box(PANEL, (inner, 0.0, BACK), (inner + 0.03, 0.18, FRONT), skip="xzZy")
    return mesh


def window_bars():
    """Frame, two uprights, cross bars and a fan in the arch, in the middle of the wall."""
    mesh = Mesh("window bars")
    x0, x1 = LEFT - 0.36, LEFT - 0.28
    for middle in WINDOWS:
        for share, half in ((-1.0, 0.06), (-1 / 3, 0.028), (1 / 3, 0.028), (1.0, 0.06)):
            offset = share * HALF_WIDTH
            mesh.box(BAR, (x0, SILL, middle + offset - half), (x1, SPRING, middle + offset + half), skip="yY")
        for k in range(6):
            y = SILL + (SPRING - SILL) * k / 5
            half = 0.06 if k in (0, 5) else 0.028
            mesh.box(BAR, (x0, y - half, middle - HALF_WIDTH), (x1, y + half, middle + HALF_WIDTH), skip="zZ")
        hub = (0.5 * (x0 + x1), SPRING, middle)
        for k in range(1, 4):
            angle = math.pi * k / 4
            rim = (hub[0], SPRING + HALF_WIDTH * math.sin(angle), middle + HALF_WIDTH * math.cos(angle))
            mesh.tube(BAR, [hub, rim], [0.03, 0.03], 4, capped=False)
        for radius, thickness in ((HALF_WIDTH, 0.055), (0.5 * HALF_WIDTH, 0.026)):
            arch = []
            for k in range(ARC + 1):
                angle = math.pi * k / ARC
                arch.append((hub[0], SPRING + radius * math.sin(angle), middle + radius * math.cos(angle)))
            mesh.tube(BAR, arch, [thickness] * len(arch), 4, capped=False)
    return mesh


def shell():
    """Floor, ceiling and the three walls without windows, each a slab with an outside."""
    mesh = Mesh("room")
    x0, x1, z0, z1 = LEFT - WALL, RIGHT + WALL, BACK - WALL, FRONT + WALL
    mesh.quad(PLANKS, (LEFT, 0, FRONT), (RIGHT, 0, FRONT), (RIGHT, 0, BACK), (LEFT, 0, BACK))
    mesh.quad(PLASTER, (LEFT, HEIGHT, BACK), (RIGHT, HEIGHT, BACK), (RIGHT, HEIGHT, FRONT), (LEFT, HEIGHT, FRONT))
    mesh.quad(PLASTER, (LEFT, 0, BACK), (RIGHT, 0, BACK), (RIGHT, HEIGHT, BACK), (LEFT, HEIGHT, BACK))
    mesh.quad(PLASTER, (RIGHT, 0, FRONT), (LEFT, 0, FRONT), (LEFT, HEIGHT, FRONT), (RIGHT, HEIGHT, FRONT))
    mesh.quad(PLASTER, (RIGHT, 0, BACK), (RIGHT, 0, FRONT), (RIGHT, HEIGHT, FRONT), (RIGHT, HEIGHT, BACK))
    # The outside: a box without the left face, whose place the window wall takes, but with its margins.
    mesh.box(OUTSIDE, (x0, -WALL, z0), (x1, HEIGHT + WALL, z1), skip="x")
    low, high = -WALL, HEIGHT + WALL
    for y0, y1, za, zb in ((low, 0, z0, z1), (HEIGHT, high, z0, z1), (0, HEIGHT, z0, BACK), (0, HEIGHT, FRONT, z1)):
        mesh.quad(OUTSIDE, (x0, y0, za), (x0, y0, zb), (x0, y1, zb), (x0, y1, za))
    return mesh


def beams():
    mesh = Mesh("ceiling beams")
    for k in range(6):
        z = WINDOWS[0] + PITCH * (0.5 - k)
        if BACK < z < FRONT:
            mesh.box(BEAM, (LEFT, HEIGHT - 0.42, z - 0.17), (RIGHT, HEIGHT, z + 0.17), skip="xXY")
    for x in (-3.3, 0.0, 3.3):
        mesh.box(BEAM, (x - 0.13, HEIGHT - 0.28, BACK), (x + 0.13, HEIGHT, FRONT), skip="zZY")
    return mesh


def column():
    """Origin on the floor; reaches up to the beams."""
    mesh = Mesh("column")
    mesh.box(STONE, (-0.33, 0.0, -0.33), (0.33, 0.28, 0.33), skip="y")
    top = HEIGHT - 0.42
    foot = [(0.31, 0.28), (0.31, 0.34), (0.25, 0.42), (0.27, 0.47), (0.21, 0.54)]
    shaft = [(0.205, 1.6), (0.195, 3.2), (0.175, top - 0.5)]
    head = [(0.2, top - 0.47), (0.2, top - 0.42), (0.18, top - 0.4), (0.22, top - 0.26), (0.31, top - 0.14)]
    mesh.turned(STONE, foot + shaft + head, 20)
    mesh.box(STONE, (-0.35, top - 0.14, -0.35), (0.35, top, 0.35), skip="Y")
    return mesh


def rug(x0, x1, z0, z1):
    mesh = Mesh("rug")
    layers = [(0.0, RUG_BORDER), (0.22, RUG_LINE), (0.27, RUG), (0.7, RUG_LINE), (0.73, RUG)]
    for level, (inset, material) in enumerate(layers):
        y = 0.008 + 0.002 * level
        a, b, c, d = x0 + inset, x1 - inset, z0 + inset, z1 - inset
        mesh.quad(material, (a, y, d), (b, y, d), (b, y, c), (a, y, c))
    return mesh


def painting(width, height):
    """Hangs on a wall behind it (z = 0); the origin is its middle."""
    mesh = Mesh("painting")
    x, y = width / 2, height / 2
    mesh.quad(CANVAS, (-x, -y, 0.03), (x, -y, 0.03), (x, y, 0.03), (-x, y, 0.03))
    X, Y = x + 0.1, y + 0.1
    for low, high in (((-X, -Y), (X, -y)), ((-X, y), (X, Y)), ((-X, -y), (-x, y)), ((x, -y), (X, y))):
        mesh.box(furniture.BRASS, (*low, 0.0), (*high, 0.07), skip="z")
    return mesh


def build():
    document = Document("library")
    source = random.Random(1869)
    document.node("room", shell())
    document.node("window wall", window_wall())
    document.node("window bars", window_bars())
    document.node("ceiling beams", beams())
    post = column()
    for k in range(1, 5):
        document.node("column %d" % k, post, (-3.3, 0.0, WINDOWS[0] + PITCH * (0.5 - k)))
    document.node("rug", rug(-2.6, 1.6, -10.6, -2.2))
    height = 0.78
    board = document.node("table", furniture.table(5.2, 1.3, height), (-0.5, 0.0, -6.4))
    document.node("books on the table", furniture.reading(source), (0.0, height, 0.0), parent=board)
    seat = furniture.chair()
    places = [(0.55, -4.6, -84), (0.62, -6.0, -97), (0.5, -7.6, -90), (-1.62, -4.9, 88)]
    places += [(-1.5, -6.7, 95), (-1.85, -8.1, 70), (-0.45, -9.6, 4), (1.1, -3.3, -25)]
    for k, (x, z, turn) in enumerate(places):
        document.node("chair %d" % k, seat, (x, 0.0, z), rotation_about_y(turn))
    document.node("globe", furniture.globe(), (-1.5, 0.0, -2.7), rotation_about_y(30))
    document.node("chandelier", furniture.chandelier(2.35), (-0.5, HEIGHT - 0.28, -6.4))
    cases = [furniture.bookcase("bookcase " + letter, 1.9, 3.5, source) for letter in "ab"]
    for k in range(5):
        document.node("bookcase %d" % k, cases[k % 2], (-4.6 + 2.0 * k, 0.0, BACK))
    document.node("ladder", furniture.ladder(3.9, 1.0), (-1.6, 0.0, BACK + 0.38))
    for k, x in enumerate((-3.6, -0.6, 2.4)):
        document.node("painting %d" % k, painting(1.7, 1.25), (x, 4.75, BACK))
    direction = tuple(b - a for a, b in zip(CAMERA, LOOK_AT))
    lens = perspective_camera("camera", VERTICAL_FOV, 16 / 9)
    document.node("camera", None, CAMERA, rotation_to_look(direction), camera=lens)
    return document
