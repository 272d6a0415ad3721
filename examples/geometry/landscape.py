"""Mountain ridges one behind another from 0.4 to 30 km, a lake between them, and firs in front.

The camera looks along -Z from a knoll at the left; the sun of the scene file is low, just outside the right edge.
"""

import math
import random

import tree
from glb import Document, perspective_camera
from mesh import Material, Mesh
from vector import rotation_about_y, rotation_to_look

CAMERA = (0.0, 152.0, 0.0)
LOOK_AT = (0.0, 146.0, -100.0)
VERTICAL_FOV = 30.0

NEEDLES = Material("fir needles", (0.014, 0.022, 0.013))
BARK = Material("bark", (0.03, 0.022, 0.017))
GRASS = Material("grass", (0.05, 0.055, 0.022))
VALLEY = Material("valley", (0.045, 0.055, 0.028))
WATER = Material("lake", (0.008, 0.012, 0.014), roughness=0.35)
SLOPES = [
    Material("wooded slope", (0.028, 0.036, 0.02)),
    Material("meadow slope", (0.055, 0.058, 0.032)),
    Material("rocky slope", (0.12, 0.11, 0.095)),
    Material("bare rock", (0.17, 0.16, 0.15)),
]

# distance to the crest [m], crest height above the lake [m], roughness of the crest (share of its height), material,
# side spur: how the crest leans over the picture (-1 falls to the right, +1 to the left, 0 even).
RIDGES = [
    (430.0, 120.0, 0.12, 0, -0.9),
    (1000.0, 122.0, 0.2, 0, -0.85),
    (2100.0, 230.0, 0.3, 1, -0.95),
    (4300.0, 300.0, 0.36, 1, 0.6),
    (7200.0, 480.0, 0.42, 2, -0.45),
    (12000.0, 950.0, 0.45, 2, 0.35),
    (19500.0, 1900.0, 0.48, 3, -0.3),
    (30000.0, 3600.0, 0.5, 3, 0.15),
]


def lattice(seed, i, j):
    """A number in [0, 1) of a lattice point; integer mixing, the same everywhere."""
    h = (i * 0x27D4EB2D ^ j * 0x165667B1 ^ seed * 0x9E3779B1) & 0xFFFFFFFF
    h = ((h ^ (h >> 15)) * 0x2C1B3C6D) & 0xFFFFFFFF
    h = ((h ^ (h >> 12)) * 0x297A2D39) & 0xFFFFFFFF
    return (h ^ (h >> 15)) / 4294967296.0


def noise(seed, x, y):
    """Value noise in [0, 1] with smooth interpolation."""
    i, j = math.floor(x), math.floor(y)
    fx, fy = x - i, y - j
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    low = lattice(seed, i, j) * (1 - fx) + lattice(seed, i + 1, j) * fx
    high = lattice(seed, i, j + 1) * (1 - fx) + lattice(seed, i + 1, j + 1) * fx
    return low * (1 - fy) + high * fy


def ridged(seed, x, y, octaves):
    """Sharp-crested fractal in about [0, 1]: each octave is folded, and small ones act where large ones are high
    (Musgrave 1993, ridged multifractal)."""
    total, weight, size, share = 0.0, 1.0, 0.0, 1.0
    for octave in range(octaves):
        fold = 1.0 - abs(2.0 * noise(seed + octave, x, y) - 1.0)
        fold *= fold
        total += share * weight * fold
        size += share
        weight = min(1.0, 1.6 * fold)
        share *= 0.5
        x, y = 2.03 * x + 17.1, 2.03 * y + 5.7
    return total / size


class Ridge:
    """A mountain range across the view: foot, crest and back, as a height over the ground plan."""

    def __init__(self, number):
        self.number = number
        self.distance, self.height, self.rough, self.material, self.lean = RIDGES[number]
        self.half_width = 0.66 * self.distance

    def crest(self, x):
        """Height of the crest line without the detail, [m]."""
        u = x / self.half_width
        lean = 1.0 - abs(self.lean) * (0.5 + 0.5 * math.tanh(2.6 * (u if self.lean < 0 else -u)))
        broad = 0.72 + 0.55 * noise(50 + self.number, 3.1 * u + 3.0 * self.number, 0.5)
        return self.height * lean * broad

    def at(self, x, v):
        """v runs from 0 at the foot over 0.6 at the crest to 1 behind it."""
        depth = 0.42 * self.distance if self.number < 3 else 0.3 * self.distance
        z = -(self.distance + (v - 0.6) * depth)
        slope = math.sin(0.5 * math.pi * min(1.0, v / 0.6)) if v < 0.6 else math.cos(0.5 * math.pi * (v - 0.6) / 0.4)
        grain = 5.5 / self.distance
        relief = ridged(100 + 10 * self.number, x * grain + 31.0 * self.number, z * grain, 6)
        y = self.crest(x) * slope * (1.0 - self.rough + 1.9 * self.rough * relief) - 12.0 * (1 - slope)
        return (x, y, z)

    def mesh(self, columns, lines):
        mesh = Mesh("ridge %d" % self.number)
        rows = []
        for j in range(lines + 1):
            v = j / lines
            rows.append([self.at(self.half_width * (2 * i / columns - 1), v) for i in range(columns + 1)])
        mesh.grid(SLOPES[self.material], rows)
        return mesh


def knoll_height(x, z):
    """The hill that the camera stands on; falls away to the right and ahead."""
    away = math.hypot(x + 26.0, 0.85 * (z + 14.0))
    return 152.5 - 0.0095 * away * away / (1.0 + 0.006 * away) + 2.2 * (ridged(900, x / 38.0, z / 38.0, 4) - 0.5)


def knoll():
    mesh = Mesh("knoll")
    rows = []
    for j in range(57):
        z = 30.0 - 4.0 * j
        rows.append([(-180.0 + 5.0 * i, knoll_height(-180.0 + 5.0 * i, z), z) for i in range(65)])
    mesh.grid(GRASS, rows)
    return mesh


def grass_patch(source):
    """Ninety blades on a disc of 3 m, one triangle each; the origin is on the ground."""
    mesh = Mesh("grass")
    for _ in range(90):
        turn, out = 2 * math.pi * source.random(), 3.0 * math.sqrt(source.random())
        x, z = out * math.cos(turn), out * math.sin(turn)
        turn = 2 * math.pi * source.random()
        wide, tall, bow = 0.01 + 0.012 * source.random(), 0.12 + 0.36 * source.random() ** 2, 0.25 * source.random()
        across = (wide * math.cos(turn), wide * math.sin(turn))
        tip = (x + bow * math.sin(turn), tall, z - bow * math.cos(turn))
        mesh.polygon(GRASS, [(x - across[0], -0.3, z - across[1]), (x + across[0], -0.3, z + across[1]), tip])
    return mesh


def water():
    """The lake's outline, seen at a grazing angle: long in depth."""
    mesh = Mesh("lake")
    count = 64
    centre = (620.0, 1.0, -2700.0)
    rim = []
    for k in range(count):
        angle = 2 * math.pi * k / count
        swell = 1 + 0.16 * math.sin(2 * angle + 0.6) + 0.12 * math.sin(3 * angle + 2.0) + 0.05 * math.sin(7 * angle)
        rim.append((centre[0] + 1000.0 * swell * math.cos(angle), 1.0, centre[2] - 1250.0 * swell * math.sin(angle)))
    for here, there in zip(rim, rim[1:] + rim[:1]):
        mesh.polygon(WATER, [centre, here, there], (0.0, 1.0, 0.0))
    return mesh


def build():
    document = Document("ridges")
    source = random.Random(30000)
    plain = Mesh("valley floor")
    plain.quad(VALLEY, (-60000, 0, 2000), (60000, 0, 2000), (60000, 0, -60000), (-60000, 0, -60000))
    document.node("valley floor", plain)
    document.node("lake", water())
    ridges = [Ridge(number) for number in range(len(RIDGES))]
    for ridge in ridges:
        document.node("ridge %d" % ridge.number, ridge.mesh(260, 12))
    document.node("knoll", knoll())
    near = [tree.conifer("fir " + name, NEEDLES, BARK, seed, tiers=13, sides=11) for name, seed in (("a", 3), ("b", 4))]
    far = [tree.conifer("far fir " + name, NEEDLES, BARK, seed, 1.0, 4, 4) for name, seed in (("a", 5), ("b", 6))]
    # A stand that frames the left edge, and a few stragglers down the slope.
    stand = [(-17.0, -38.0, 17.0), (-21.5, -46.0, 21.0), (-14.5, -52.0, 14.0), (-26.0, -58.0, 19.0)]
    stand += [(-19.0, -63.0, 23.0), (-10.5, -60.0, 8.5), (-31.0, -72.0, 24.0), (-23.0, -80.0, 17.0)]
    stand += [(-12.0, -76.0, 12.0), (-4.5, -88.0, 7.0)]
    stand += [(-36.0, -92.0, 20.0), (-16.5, -98.0, 15.0), (21.0, -58.0, 6.0), (27.0, -64.0, 9.0), (33.0, -70.0, 5.5)]
    for number, (x, z, height) in enumerate(stand):
        at = (x, knoll_height(x, z) - 0.3, z)
        document.node("fir %02d" % number, near[number % 2], at, rotation_about_y(360 * source.random()), height)
    tufts = [grass_patch(source) for _ in range(2)]
    for number in range(150):
        x, z = -45.0 + 85.0 * source.random(), -20.0 - 60.0 * source.random() ** 1.4
        at, turn = (x, knoll_height(x, z), z), rotation_about_y(360 * source.random())
        document.node("grass %03d" % number, tufts[number % 2], at, turn, round(0.7 + 0.6 * source.random(), 2))
    # Tree lines: on a crest against the light, firs are what one sees of the wood.
    for ridge, count in ((ridges[0], 150), (ridges[1], 170)):
        for number in range(count):
            x = ridge.half_width * (1.7 * source.random() - 0.95)
            place = ridge.at(x, 0.42 + 0.24 * source.random())
            if place[1] < 8.0:
                continue
            height = 13.0 + 11.0 * source.random()
            at = (place[0], place[1] - 0.6, place[2])
            name = "ridge %d fir %03d" % (ridge.number, number)
            document.node(name, far[number % 2], at, rotation_about_y(360 * source.random()), round(height, 2))
    direction = tuple(b - a for a, b in zip(CAMERA, LOOK_AT))
    lens = perspective_camera("camera", VERTICAL_FOV, 16 / 9, near=1.0)
    document.node("camera", None, CAMERA, rotation_to_look(direction), camera=lens)
    return document
