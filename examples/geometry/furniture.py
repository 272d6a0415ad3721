"""What stands in the library: table, chairs, globe, chandelier, bookcases, a ladder. Each on y = 0, facing +Z."""

import math

from mesh import Material, Mesh

OAK = Material("dark oak", (0.19, 0.1, 0.052), roughness=0.45)
TABLE_TOP = Material("table top", (0.16, 0.08, 0.04), roughness=0.35)
LEATHER = Material("green leather", (0.02, 0.05, 0.032), roughness=0.5)
PAGES = Material("pages", (0.55, 0.48, 0.36), roughness=0.9)
BRASS = Material("brass", (0.62, 0.42, 0.16), roughness=0.35, metallic=1.0)
WAX = Material("wax", (0.6, 0.55, 0.42), roughness=0.6)
SEA = Material("globe, sea", (0.05, 0.1, 0.12), roughness=0.4)
LAND = Material("globe, land", (0.3, 0.2, 0.09), roughness=0.6)
SPINES = [
    Material("spine, oxblood", (0.28, 0.044, 0.036), roughness=0.6),
    Material("spine, tan", (0.4, 0.22, 0.1), roughness=0.6),
    Material("spine, bottle green", (0.044, 0.12, 0.072), roughness=0.6),
    Material("spine, navy", (0.04, 0.064, 0.16), roughness=0.6),
    Material("spine, umber", (0.15, 0.09, 0.056), roughness=0.6),
    Material("spine, vellum", (0.6, 0.6, 0.4), roughness=0.7),
]


def table(length, width, height):
    """Long side along Z."""
    mesh = Mesh("table")
    x, z = width / 2, length / 2
    mesh.box(TABLE_TOP, (-x, height - 0.05, -z), (x, height, z))
    mesh.box(OAK, (-x + 0.1, height - 0.15, -z + 0.12), (x - 0.1, height - 0.05, z - 0.12), skip="yY")
    for foot_z in (-z + 0.45, 0.0, z - 0.45):
        for foot_x in (-x + 0.2, x - 0.2):
            profile = [(0.075, 0.0), (0.075, 0.1), (0.035, 0.14), (0.07, 0.3), (0.06, 0.42), (0.035, 0.52), (0.06, 0.6)]
            mesh.turned(OAK, profile, 10, (foot_x, foot_z))
        mesh.box(OAK, (-x + 0.2, 0.12, foot_z - 0.03), (x - 0.2, 0.18, foot_z + 0.03), skip="xX")
    return mesh


def chair():
    mesh = Mesh("chair")
    mesh.box(LEATHER, (-0.23, 0.43, -0.22), (0.23, 0.49, 0.22))
    mesh.box(OAK, (-0.24, 0.38, -0.23), (0.24, 0.43, 0.23))
    for x in (-0.21, 0.21):
        mesh.box(OAK, (x - 0.025, 0.0, 0.17), (x + 0.025, 0.38, 0.22), skip="Y")
        mesh.box(OAK, (x - 0.025, 0.0, -0.23), (x + 0.025, 1.12, -0.18))
    mesh.box(OAK, (-0.21, 0.98, -0.225), (0.21, 1.1, -0.19))
    mesh.box(OAK, (-0.21, 0.6, -0.225), (0.21, 0.65, -0.19))
    for k in range(5):
        x = -0.14 + 0.07 * k
        mesh.box(OAK, (x - 0.014, 0.65, -0.22), (x + 0.014, 0.98, -0.195), skip="yY")
    return mesh


def book(mesh, spine, low, high):
    """A lying book whose pages show toward +X."""
    mesh.box(spine, low, high)
    (x, y, z), (X, Y, Z) = low, high
    front, low_y, high_y, low_z, high_z = X + 0.001, y + 0.006, Y - 0.006, z + 0.008, Z - 0.008
    mesh.quad(PAGES, (front, low_y, high_z), (front, low_y, low_z), (front, high_y, low_z), (front, high_y, high_z))


def reading(source):
    """Piles of books, an open folio and a candlestick, to lie on the table."""
    mesh = Mesh("books on the table")
    for x, z, count in ((-0.3, -1.7, 5), (0.22, -1.25, 3), (0.25, 0.5, 4), (-0.28, 1.9, 2), (0.2, 2.1, 6)):
        y = 0.0
        for _ in range(count):
            wide, deep = 0.1 + 0.04 * source.random(), 0.14 + 0.05 * source.random()
            thick = 0.03 + 0.035 * source.random()
            shift = 0.04 * (source.random() - 0.5)
            spine = SPINES[int(len(SPINES) * source.random())]
            book(mesh, spine, (x - wide + shift, y, z - deep), (x + wide + shift, y + thick, z + deep))
            y += thick
    for side in (-1, 1):  # the folio: two leaves rising from the fold
        leaf = [(0.0, 0.015, -0.25), (0.0, 0.015, 0.15), (side * 0.3, 0.05, 0.15), (side * 0.3, 0.05, -0.25)]
        mesh.polygon(PAGES, leaf if side > 0 else leaf[::-1])
    candlestick = [(0.08, 0.0), (0.08, 0.015), (0.02, 0.04), (0.015, 0.2), (0.035, 0.22), (0.02, 0.24), (0.03, 0.27)]
    mesh.turned(BRASS, candlestick, 10, (-0.2, 0.75))
    mesh.turned(WAX, [(0.016, 0.27), (0.016, 0.43), (0.0, 0.44)], 8, (-0.2, 0.75))
    return mesh


def globe():
    """A library globe, 0.75 m across, in a ring on three legs."""
    mesh = Mesh("globe")
    radius, centre = 0.375, 0.86
    columns, lines = 32, 16

    def is_land(lat, lon):
        value = math.sin(2 * lon + 1.3) * math.cos(3 * lat) + 0.6 * math.sin(5 * lon + 4 * lat)
        return value + 0.4 * math.cos(7 * lat - 3 * lon) > 0.25

    def at(j, i):
        lat, lon = math.pi * (j / lines - 0.5), 2 * math.pi * i / columns
        ring = math.cos(lat)
        # The axis leans by 23.5 degrees toward +X.
        x, y, z = radius * ring * math.cos(lon), radius * math.sin(lat), -radius * ring * math.sin(lon)
        lean = math.radians(23.5)
        return (x * math.cos(lean) + y * math.sin(lean), centre - x * math.sin(lean) + y * math.cos(lean), z)

    for j in range(lines):
        for i in range(columns):
            land = is_land(math.pi * ((j + 0.5) / lines - 0.5), 2 * math.pi * (i + 0.5) / columns)
            corners = [at(j, i), at(j, i + 1), at(j + 1, i + 1), at(j + 1, i)]
            if j == 0:
                del corners[1]
            if j == lines - 1:
                del corners[2]
            mesh.polygon(LAND if land else SEA, corners)
    mesh.turned(OAK, [(0.4, centre - 0.02), (0.47, centre - 0.02), (0.47, centre + 0.02), (0.4, centre + 0.02)], 32)
    for k in range(3):
        angle = 2 * math.pi * k / 3 + 0.4
        x, z = 0.43 * math.cos(angle), 0.43 * math.sin(angle)
        mesh.tube(OAK, [(0.8 * x, 0.0, 0.8 * z), (1.0 * x, centre - 0.02, 1.0 * z)], [0.02, 0.03], 8)
        mesh.tube(OAK, [(0.85 * x, 0.25, 0.85 * z), (0.0, 0.2, 0.0)], [0.015, 0.015], 6)
    return mesh


def chandelier(drop):
    """A brass ring of twelve candles; the origin is where the chain meets the ceiling, `drop` metres above the ring."""
    mesh = Mesh("chandelier")
    radius, count = 0.85, 12
    spine = []
    for k in range(37):
        angle = 2 * math.pi * k / 36
        spine.append((radius * math.cos(angle), -drop, radius * math.sin(angle)))
    mesh.tube(BRASS, spine, [0.03] * 37, 6, capped=False)
    mesh.tube(OAK, [(0, 0, 0), (0, -drop + 0.9, 0)], [0.015, 0.015], 5, capped=False)
    for k in range(4):
        angle = math.pi * k / 2 + 0.3
        rod = [(0, -drop + 0.92, 0), (radius * math.cos(angle), -drop, radius * math.sin(angle))]
        mesh.tube(OAK, rod, [0.01, 0.01], 4, capped=False)
    for k in range(count):
        angle = 2 * math.pi * k / count
        x, z = radius * math.cos(angle), radius * math.sin(angle)
        mesh.turned(BRASS, [(0.02, -drop), (0.06, -drop + 0.05), (0.06, -drop + 0.06), (0.0, -drop + 0.06)], 8, (x, z))
        mesh.turned(WAX, [(0.02, -drop + 0.06), (0.02, -drop + 0.28), (0.0, -drop + 0.29)], 6, (x, z))
    return mesh


def bookcase(name, width, height, source):
    """Shelves 0.34 m deep with books; the back is at z = 0. Books show spine, top and
    one side: nothing else is in view."""
    mesh = Mesh(name)
    depth, board = 0.34, 0.04
    for x in (-width / 2, width / 2 - board):
        mesh.box(OAK, (x, 0.0, 0.0), (x + board, height, depth), skip="z")
    mesh.quad(OAK, (-width / 2, 0, 0.02), (width / 2, 0, 0.02), (width / 2, height, 0.02), (-width / 2, height, 0.02))
    mesh.box(OAK, (-width / 2 - 0.04, height, 0.0), (width / 2 + 0.04, height + 0.14, depth + 0.06), skip="z")
    mesh.box(OAK, (-width / 2, 0.0, 0.0), (width / 2, 0.14, depth), skip="yz")
    y = 0.14
    while y < height - 0.3:
        room = 0.36 + 0.1 * source.random() if y > 0.2 else 0.5
        room = min(room, height - y)
        if height - y - room < 0.3:
            room = height - y
        mesh.box(OAK, (-width / 2 + board, y - board, 0.02), (width / 2 - board, y, depth), skip="xXz")
        x = -width / 2 + board + 0.01
        while x < width / 2 - board - 0.1:
            thick = 0.04 + 0.055 * source.random()
            if source.random() < 0.05:  # a gap
                x += 0.15 * source.random()
                continue
            tall, front = (room - board) * (0.68 + 0.27 * source.random()), depth - 0.05 - 0.05 * source.random()
            spine = SPINES[int(len(SPINES) * source.random() ** 1.3)]
            mesh.box(spine, (x, y, 0.05), (x + thick, y + tall, front), skip="yxz")
            x += thick + 0.003
        y += room
    return mesh


def ladder(height, reach):
    """Leans toward -Z: the feet are `reach` metres in front of the top."""
    mesh = Mesh("ladder")
    for x in (-0.22, 0.22):
        mesh.tube(OAK, [(x, 0.0, reach), (x, height, 0.0)], [0.028, 0.024], 6)
    rungs = int(height / 0.3)
    for k in range(1, rungs):
        t = k / rungs
        at = (height * t, reach * (1 - t))
        mesh.tube(OAK, [(-0.22, *at), (0.22, *at)], [0.016, 0.016], 6, capped=False)
    return mesh
