"""House fronts of a street along -Z: storeys of recessed windows, some lit, shops below, a gable roof above."""

import random

import texture
from mesh import Material

BRICK_TEXTURE = texture.brick()
WALLS = [
    Material("brick", (1.0, 1.0, 1.0), texture=BRICK_TEXTURE, tile=2.0),
    Material("dark brick", (0.62, 0.6, 0.62), texture=BRICK_TEXTURE, tile=2.0),
    Material("ochre plaster", (0.34, 0.26, 0.16)),
    Material("grey plaster", (0.24, 0.24, 0.25)),
    Material("cream plaster", (0.42, 0.37, 0.29)),
]
TRIM = Material("stone trim", (0.36, 0.34, 0.3))
ROOF = Material("roof", (0.035, 0.035, 0.04))
PANE = Material("dark pane", (0.012, 0.014, 0.018), roughness=0.25)
DOOR = Material("door", (0.05, 0.028, 0.02), roughness=0.5)
LIT = [
    Material("lit window, tungsten", (0.1, 0.1, 0.1), radiance=(0.95, 0.52, 0.2)),
    Material("lit window, dim", (0.1, 0.1, 0.1), radiance=(0.42, 0.2, 0.07)),
    Material("lit window, cool", (0.1, 0.1, 0.1), radiance=(0.28, 0.44, 0.55)),
]
SHOP = Material("shop window", (0.1, 0.1, 0.1), radiance=(0.62, 0.38, 0.15))
IRON = Material("painted iron", (0.02, 0.024, 0.024), roughness=0.45)
DETAIL_ENDS = -110.0  # z; beyond it windows are flat: a recess would be thinner than a pixel


class Front:
    """One facade in its own flat coordinates: s along the street away from the camera, h up, recess into the house.

    side is -1 or 1 as seen from the camera, line the distance of the facades from the middle of the street.
    """

    def __init__(self, mesh, side, line, near):
        self.mesh, self.side, self.line, self.near = mesh, side, line, near

    def place(self, s, h, recess):
        return (self.side * (self.line + recess), h, self.near - s)

    def quad(self, material, corners):
        """Corners (s, h, recess) counter-clockwise with s to the right; the left side of the street mirrors them."""
        points = [self.place(*corner) for corner in corners]
        self.mesh.polygon(material, points if self.side < 0 else points[::-1])

    def rectangle(self, material, s0, s1, h0, h1, recess=0.0):
        self.quad(material, [(s1, h1, recess), (s0, h1, recess), (s0, h0, recess), (s1, h0, recess)])

    def ledge(self, material, s0, s1, h0, h1, out):
        """A box standing out of the wall."""
        low, high = self.place(s1, h0, -out), self.place(s0, h1, 0.02)
        x0, x1 = sorted((low[0], high[0]))
        self.mesh.box(material, (x0, h0, low[2]), (x1, h1, high[2]), skip="X" if self.side > 0 else "x")

    def opening(self, frame, glass, s0, s1, h0, h1, depth):
        """The four cheeks of a hole and the pane at its back."""
        for a, b in (((s0, h0), (s0, h1)), ((s1, h1), (s1, h0)), ((s0, h1), (s1, h1)), ((s1, h0), (s0, h0))):
            self.quad(frame, [(*a, 0.0), (*b, 0.0), (*b, depth), (*a, depth)])
        self.rectangle(glass, s0, s1, h0, h1, depth)


def house(mesh, side, line, near, width, floors, wall, source):
    """A house of so many floors above the ground floor, its near corner at z = near."""
    front = Front(mesh, side, line, near)
    ground, storey = 3.9, 3.2
    height = ground + floors * storey + 0.5
    detailed = near - width > DETAIL_ENDS
    bays = max(2, int(width / 2.9))
    pitch = width / bays
    shop = source.random() < 0.45
    lit_share = 0.2 if near > -60 else 0.26
    # Ground floor: shop windows or door and windows, in a stone plinth.
    base = TRIM if shop else wall
    holes = []
    for bay in range(bays):
        centre = (bay + 0.5) * pitch
        if bay == bays // 2:
            holes.append((centre - 0.6, centre + 0.6, 0.15, 2.7, DOOR))
        elif shop:
            lit = SHOP if source.random() < 0.5 else PANE
            holes.append((centre - 0.4 * pitch, centre + 0.4 * pitch, 0.7, 3.0, lit))
        else:
            holes.append((centre - 0.55, centre + 0.55, 1.1, 2.9, LIT[1] if source.random() < 0.25 else PANE))
    band(front, base, TRIM, holes, 0.0, ground, width, detailed)
    for floor in range(floors):
        bottom = ground + floor * storey
        holes = []
        for bay in range(bays):
            centre = (bay + 0.5) * pitch
            dice = source.random()
            glass = PANE
            if dice < lit_share:
                glass = LIT[0] if dice < 0.5 * lit_share else LIT[1] if dice < 0.86 * lit_share else LIT[2]
            holes.append((centre - 0.52, centre + 0.52, bottom + 0.75, bottom + 2.55, glass))
        band(front, wall, TRIM, holes, bottom, bottom + storey, width, detailed)
        if detailed:
            for s0, s1, h0, _, _ in holes:
                front.ledge(TRIM, s0 - 0.12, s1 + 0.12, h0 - 0.12, h0, 0.14)
    front.rectangle(wall, 0.0, width, height - 0.5, height)
    front.ledge(TRIM, 0.0, width, ground - 0.22, ground, 0.12)
    front.ledge(TRIM, 0.0, width, height - 0.3, height, 0.3)
    roof(mesh, side, line, near, width, height, wall, source)


def band(front, wall, cheek, holes, h0, h1, width, detailed):
    """One storey of wall around its openings."""
    edge = 0.0
    for s0, s1, low, high, glass in holes:
        front.rectangle(wall, edge, s0, h0, h1)
        front.rectangle(wall, s0, s1, h0, low)
        front.rectangle(wall, s0, s1, high, h1)
        if detailed:
            front.opening(cheek, glass, s0, s1, low, high, 0.2)
            if glass is SHOP:
                shop_window(front, s0, s1, low, high)
            elif high - low < 2.0:  # a cross of glazing bars
                middle = 0.5 * (s0 + s1)
                front.rectangle(cheek, middle - 0.03, middle + 0.03, low, high, 0.17)
                front.rectangle(cheek, s0, s1, low + 1.2, low + 1.26, 0.165)
        else:
            front.rectangle(glass, s0, s1, low, high, 0.0)
        edge = s1
    front.rectangle(wall, edge, width, h0, h1)


def shop_window(front, s0, s1, low, high):
    """Glazing bars, and goods on shelves against the light."""
    for k in range(1, 3):
        s = s0 + (s1 - s0) * k / 3
        front.rectangle(IRON, s - 0.03, s + 0.03, low, high, 0.17)
    front.rectangle(IRON, s0, s1, high - 0.5, high - 0.44, 0.165)
    goods = random.Random(round(1000 * s0))
    for shelf in (low, low + 0.75):
        front.rectangle(IRON, s0, s1, shelf, shelf + 0.05, 0.185)
        s = s0 + 0.05
        while s < s1 - 0.35:
            wide, tall = 0.12 + 0.2 * goods.random(), 0.15 + 0.35 * goods.random()
            front.rectangle(DOOR, s, s + wide, shelf + 0.05, shelf + 0.05 + tall, 0.19)
            s += wide + 0.05 + 0.3 * goods.random()


def roof(mesh, side, line, near, width, height, wall, source):
    """Gable roof with its ridge along the street, gable ends, back wall and a chimney or two."""
    deep, rise = 9.0, 1.6 + 1.6 * source.random()
    x0, x1, x2 = (side * (line + d) for d in (0.0, deep / 2, deep))
    z0, z1 = near, near - width
    eaves = [(x0, height, z0), (x0, height, z1), (x1, height + rise, z1), (x1, height + rise, z0)]
    back = [(x1, height + rise, z0), (x1, height + rise, z1), (x2, height, z1), (x2, height, z0)]
    rear = [(x2, 0, z0), (x2, height, z0), (x2, height, z1), (x2, 0, z1)]
    for material, points in ((ROOF, eaves), (ROOF, back), (wall, rear)):
        mesh.polygon(material, points if side > 0 else points[::-1])
    for z, toward in ((z0, 1), (z1, -1)):
        gable = [(x0, 0, z), (x2, 0, z), (x2, height, z), (x1, height + rise, z), (x0, height, z)]
        mesh.polygon(wall, gable if side * toward > 0 else gable[::-1])
    for _ in range(1 + int(2 * source.random())):
        z = z0 - width * (0.15 + 0.7 * source.random())
        x, _ = sorted((x1, x1 + side * 0.7))
        mesh.box(WALLS[1], (x, height + rise - 0.8, z - 0.9), (x + 0.7, height + rise + 1.3, z), skip="y")
