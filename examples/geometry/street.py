"""A night street: facades, lamps, a car pulling out, and marker posts at 25, 50, 100 and 200 m from the camera.

The road runs along -Z. Lamps and headlights are KHR_lights_punctual nodes of this file; the sky is in the scene file.
"""

import math
import random

import car
import texture
import tree
from glb import Document, Material, Mesh, normalized, perspective_camera, point_light, rotation_about_y
from glb import rotation_to_look, spot_light

CAMERA = (-0.9, 1.62, 0.0)
LOOK_AT = (-0.4, 3.3, -30.0)
VERTICAL_FOV = 33.0

ROAD = 4.0  # half width
PAVEMENT = 3.2
KERB = 0.13
NEAR_END, FAR_END = 24.0, -330.0
FACADE = ROAD + PAVEMENT

LAMP_HEIGHT = 6.9
LAMP_REACH = 1.7
SODIUM = (1.0, 0.64, 0.31)
LAMP_INTENSITY = 62.0  # W/sr, of the channel that is strongest
# (side, z), staggered; the first stands behind the camera's right shoulder and lights the foreground.
LAMPS = [(1, -4.0)] + [(side, z) for k in range(5) for side, z in ((-1, -20.0 - 32.0 * k), (1, -36.0 - 32.0 * k))]

COOL_WHITE = (0.84, 0.93, 1.0)
HEADLIGHT_INTENSITY = 270.0
CAR_AT = (-1.3, 0.0, -22.5)
CAR_YAW = 180.0 - 31.0  # turning into a yard on the left: the beams cross the picture, not the lens

MARKER_DISTANCES = (25, 50, 100, 200)

ASPHALT = Material("wet asphalt", (0.8, 0.8, 0.82), roughness=0.26, texture=texture.asphalt(), tile=4.0)
PUDDLE = Material("puddle", (0.016, 0.017, 0.019), roughness=0.13)
SLABS = Material("pavement", (0.13, 0.125, 0.12), roughness=0.5)
JOINT = Material("pavement joint", (0.05, 0.05, 0.05), roughness=0.7)
STONE = Material("kerb stone", (0.26, 0.25, 0.23), roughness=0.45)
PAINT = Material("road paint", (0.62, 0.62, 0.58), roughness=0.4)
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
PANE = Material("dark pane", (0.012, 0.014, 0.018), roughness=0.1)
DOOR = Material("door", (0.05, 0.028, 0.02), roughness=0.5)
LIT = [
    Material("lit window, tungsten", (0.1, 0.1, 0.1), radiance=(0.95, 0.52, 0.2)),
    Material("lit window, dim", (0.1, 0.1, 0.1), radiance=(0.42, 0.2, 0.07)),
    Material("lit window, cool", (0.1, 0.1, 0.1), radiance=(0.28, 0.44, 0.55)),
]
SHOP = Material("shop window", (0.1, 0.1, 0.1), radiance=(0.62, 0.38, 0.15))
IRON = Material("painted iron", (0.02, 0.024, 0.024), roughness=0.45)
# What sits within a hand of a lamp's point light returns nothing, or it would be a second, blinding lamp.
BLACK = Material("lamp housing", (0.0, 0.0, 0.0), roughness=1.0, metallic=1.0)
BULB = Material("lamp bulb", (0.0, 0.0, 0.0), roughness=1.0, metallic=1.0, radiance=(24.0, 15.0, 6.5))
REFLECTOR = Material("marker, reflecting", (0.85, 0.85, 0.82), roughness=0.6, radiance=(0.5, 0.5, 0.48))
MARKER = Material("marker, dark", (0.012, 0.012, 0.014), roughness=0.8)
BARK = Material("bark", (0.03, 0.026, 0.022))
CHURCH = Material("church stone", (0.2, 0.19, 0.18))
CLOCK = Material("church clock", (0.1, 0.1, 0.1), radiance=(1.3, 1.05, 0.6))


def road():
    mesh = Mesh("road")
    mesh.quad(ASPHALT, (-ROAD, 0, NEAR_END), (ROAD, 0, NEAR_END), (ROAD, 0, FAR_END), (-ROAD, 0, FAR_END))
    mesh.quad(SLABS, (-90, -0.05, 40), (90, -0.05, 40), (90, -0.05, FAR_END - 90), (-90, -0.05, FAR_END - 90))
    for side in (-1, 1):
        inner, outer = side * ROAD, side * (FACADE + 0.3)
        stone = side * (ROAD + 0.28)
        mesh.box(STONE, (min(inner, stone), 0, FAR_END), (max(inner, stone), KERB, NEAR_END), skip="yzZ")
        low, high = sorted((stone, outer))
        mesh.quad(SLABS, (low, KERB, NEAR_END), (high, KERB, NEAR_END), (high, KERB, FAR_END), (low, KERB, FAR_END))
        z = 2.0
        while z > -90.0:  # joints across the pavement; farther off they are thinner than a pixel
            flat(mesh, JOINT, low, high, z - 0.012, z + 0.012, KERB + 0.002)
            z -= 1.25
    return mesh


def flat(mesh, material, x0, x1, z0, z1, y):
    """A horizontal rectangle facing up, z0 < z1."""
    mesh.quad(material, (x0, y, z1), (x1, y, z1), (x1, y, z0), (x0, y, z0))


def markings():
    mesh = Mesh("lane markings")
    y = 0.004
    for side in (-1, 1):
        edge = side * (ROAD - 0.32)
        flat(mesh, PAINT, edge - 0.06, edge + 0.06, FAR_END, -14.2, y)
    z = -17.0
    while z > -300.0:
        flat(mesh, PAINT, -0.07, 0.07, z - 3.0, z, y)
        z -= 7.5
    for stripe in range(8):  # zebra crossing
        x = -3.6 + 0.96 * stripe
        flat(mesh, PAINT, x, x + 0.5, -13.2, -9.8, y)
    return mesh


def puddles(source):
    mesh = Mesh("puddles")
    # Along the gutters, and where the far lamps are mirrored toward the camera.
    spots = [(3.6, -10.5, 0.6, 2.2), (-3.5, -17.2, 0.75, 2.4), (1.3, -16.0, 1.0, 1.2)]
    spots += [(3.5, -21.0, 0.8, 3.4), (0.6, -30.0, 0.9, 3.0), (-0.9, -41.0, 1.3, 4.0), (2.6, -52.0, 1.1, 5.0)]
    spots += [(-2.4, -66.0, 1.3, 6.0), (5.4, -15.0, 0.8, 1.6)]
    for x, z, across, along in spots:
        rim = []
        for k in range(28):
            angle = 2 * math.pi * k / 28
            swell = 1 + 0.2 * math.sin(2 * angle + x) + 0.14 * math.sin(3 * angle + z) + 0.06 * source.random()
            rim.append((x + across * swell * math.cos(angle), -along * swell * math.sin(angle) + z))
        y = 0.006 if abs(x) < ROAD else KERB + 0.006
        low, high = (-ROAD, ROAD) if abs(x) < ROAD else (ROAD + 0.3, FACADE)
        centre = (x, y, z)
        ring = [(max(low, min(high, px)), y, pz) for px, pz in rim]
        for here, there in zip(ring, ring[1:] + ring[:1]):
            mesh.polygon(PUDDLE, [centre, here, there], (0.0, 1.0, 0.0))
    return mesh


class Front:
    """One facade in its own flat coordinates: s along the street away from the camera, h up, recess into the house."""

    def __init__(self, mesh, side, near):
        self.mesh, self.side, self.near = mesh, side, near

    def place(self, s, h, recess):
        return (self.side * (FACADE + recess), h, self.near - s)

    def quad(self, material, corners):
        """Corners (s, h, recess) counter-clockwise with s to the right; the left side of the street mirrors them."""
        points = [self.place(*corner) for corner in corners]
        self.mesh.polygon(material, points if self.side < 0 else points[::-1])

    def rectangle(self, material, s0, s1, h0, h1, recess=0.0):
        self.quad(material, [(s1, h0, recess), (s0, h0, recess), (s0, h1, recess), (s1, h1, recess)][::-1])

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


def house(mesh, side, near, width, floors, wall, source):
    """A house front with recessed windows, seen in detail up to 110 m from the camera, flat beyond."""
    front = Front(mesh, side, near)
    ground, storey = 3.9, 3.2
    height = ground + floors * storey + 0.5
    detailed = near - width > -110.0
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
    roof(mesh, side, near, width, height, wall, source)


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


def roof(mesh, side, near, width, height, wall, source):
    """Gable roof with its ridge along the street, gable ends, back wall and a chimney or two."""
    deep, rise = 9.0, 1.6 + 1.6 * source.random()
    x0, x1, x2 = (side * (FACADE + d) for d in (0.0, deep / 2, deep))
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


def facades(source):
    mesh = Mesh("facades")
    for side in (-1, 1):
        near, count = NEAR_END, 0
        while near > FAR_END + 12:
            width = 8.5 + 5.5 * source.random()
            floors = 2 + int(2.6 * source.random())
            wall = WALLS[(count * 3 + (2 if side > 0 else 0) + int(2 * source.random())) % len(WALLS)]
            house(mesh, side, near, width, floors, wall, source)
            near -= width
            count += 1
            # A side street now and then lets the sky in between the roofs.
            if count % 4 == 2:
                near -= 5.5
    return mesh


def church():
    """Closes the view: a tower with a spire and a lit clock, at the end of the road."""
    mesh = Mesh("church")
    x, z = 3.0, FAR_END - 12.0
    mesh.box(CHURCH, (x - 4.5, 0, z - 9), (x + 4.5, 31, z), skip="y")
    mesh.box(CHURCH, (x - 5.0, 31, z - 9.5), (x + 5.0, 32, z + 0.5))
    base = [(x - 4.2, 32.0, z), (x + 4.2, 32.0, z), (x + 4.2, 32.0, z - 8.4), (x - 4.2, 32.0, z - 8.4)]
    for here, there in zip(base, base[1:] + base[:1]):
        mesh.polygon(ROOF, [here, there, (x, 58.0, z - 4.2)])
    mesh.box(CHURCH, (x - 13, 0, z - 40), (x + 13, 14, z - 4), skip="y")
    for gable_z in (z - 4, z - 40):
        gable = [(x - 13, 14, gable_z), (x + 13, 14, gable_z), (x, 22, gable_z)]
        mesh.polygon(CHURCH, gable if gable_z == z - 4 else gable[::-1])
    for side in (-1, 1):
        slope = [(x + side * 13, 14, z - 4), (x + side * 13, 14, z - 40), (x, 22, z - 40), (x, 22, z - 4)]
        mesh.polygon(ROOF, slope if side > 0 else slope[::-1])
    face = [(x + 1.7 * math.cos(k * math.pi / 8), 25 + 1.7 * math.sin(k * math.pi / 8), z + 0.05) for k in range(16)]
    mesh.polygon(CLOCK, face)
    mesh.quad(FACE_HANDS, (x - 0.12, 25, z + 0.09), (x + 0.12, 25, z + 0.09), (x + 0.12, 26.4, z + 0.09), (x - 0.12, 26.4, z + 0.09))
    mesh.quad(FACE_HANDS, (x, 24.88, z + 0.09), (x + 0.95, 24.88, z + 0.09), (x + 0.95, 25.12, z + 0.09), (x, 25.12, z + 0.09))
    return mesh


FACE_HANDS = MARKER


def lamp():
    """A post with an arm toward +X and a shaded head; the light belongs at LAMP_LIGHT."""
    mesh = Mesh("street lamp")
    mesh.tube(IRON, [(0, 0, 0), (0, 0.9, 0)], [0.13, 0.11], 8)
    arm = [(0.0, 0.9, 0.0), (0.0, 6.2, 0.0)]
    for k in range(1, 6):  # quarter of an ellipse from the post to the head
        angle = 0.5 * math.pi * k / 5
        arm.append((LAMP_REACH * (1 - math.cos(angle)) * 0.86, 6.2 + 1.0 * math.sin(angle), 0.0))
    mesh.tube(IRON, arm, [0.085] + [0.06] * (len(arm) - 2) + [0.045], 8)
    mesh.box(BLACK, (LAMP_REACH - 0.38, 7.1, -0.17), (LAMP_REACH + 0.32, 7.24, 0.17), skip="Y")
    hood = [(LAMP_REACH - 0.38, -0.17), (LAMP_REACH - 0.38, 0.17), (LAMP_REACH + 0.32, 0.17), (LAMP_REACH + 0.32, -0.17)]
    top = (LAMP_REACH - 0.05, 7.36, 0.0)
    for (x, z), (x2, z2) in zip(hood, hood[1:] + hood[:1]):
        mesh.polygon(IRON, [(x, 7.24, z), (x2, 7.24, z2), top])
    ring = [(LAMP_REACH + 0.15 * math.cos(k * math.pi / 3), 7.1, -0.13 * math.sin(k * math.pi / 3)) for k in range(6)]
    for here, there in zip(ring, ring[1:] + ring[:1]):
        mesh.polygon(BULB, [there, here, (LAMP_REACH, 6.96, 0.0)])
    return mesh


LAMP_LIGHT = (LAMP_REACH, LAMP_HEIGHT - 0.04, 0.0)

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


def marker(distance, bands):
    """A plate with the distance in metres over a post with 1 to 4 bands; the origin is the middle of the plate's face.

    Plates grow with the square root of the distance: a true size would be unreadable at 200 m, a constant one would look
    near. They glow faintly toward the viewer, as retroreflecting sheet does in the viewer's own lights.
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
    foot = KERB - marker_plate(distance)[1]
    half = 0.055 * size
    mesh.box(MARKER, (-half, foot, -0.1), (half, -high * 0.72, -0.05))
    for k in range(bands):
        bottom = -high * 0.72 - (0.17 + 0.17 * k) * size
        mesh.box(REFLECTOR, (-half - 0.01, bottom, -0.11), (half + 0.01, bottom + 0.1 * size, -0.04))
    return mesh


def marker_plate(distance):
    """Where the middle of the plate is: exactly `distance` from the camera, on the right-hand pavement."""
    x, y = ROAD + 0.75 + 0.1 * math.sqrt(distance / 25.0), 0.5 + 1.05 * math.sqrt(distance / 25.0)
    ahead = math.sqrt(distance**2 - (x - CAMERA[0]) ** 2 - (y - CAMERA[1]) ** 2)
    return (x, y, CAMERA[2] - ahead)


def build():
    document = Document("night street")
    source = random.Random(20261122)
    document.node("road", road())
    document.node("lane markings", markings())
    document.node("puddles", puddles(source))
    document.node("facades", facades(source))
    document.node("church", church())
    lamp_mesh = lamp()
    for number, (side, z) in enumerate(LAMPS):
        at = (side * (ROAD + 0.55), KERB, z)
        turn = rotation_about_y(180.0 if side > 0 else 0.0)
        post = document.node("lamp %02d" % number, lamp_mesh, at, turn)
        light = point_light("sodium %02d" % number, SODIUM, LAMP_INTENSITY)
        document.node("lamp %02d light" % number, None, LAMP_LIGHT, light=light, parent=post)
    body = document.node("car", car.build(), CAR_AT, rotation_about_y(CAR_YAW))
    for name, (x, y, z) in zip(("left", "right"), car.HEADLIGHTS):
        light = spot_light("headlight " + name, COOL_WHITE, HEADLIGHT_INTENSITY, 7.0, 17.0)
        aim = rotation_to_look(normalized((0.03 if x > 0 else -0.03, -0.035, -1.0)))
        document.node("headlight " + name, None, (x, y, z - 0.03), aim, light=light, parent=body)
    for bands, distance in enumerate(MARKER_DISTANCES, start=1):
        document.node("marker %d m" % distance, marker(distance, bands), marker_plate(distance))
    trees = [tree.bare("tree a", BARK, 5), tree.bare("tree b", BARK, 8)]
    for number, (x, z, turn, size) in enumerate([(-6.1, -35.0, 20, 1.0), (6.3, -43.5, 200, 1.1), (-6.2, -75.0, 110, 1.15), (6.2, -90.0, 300, 1.0)]):
        document.node("tree %d" % number, trees[number % 2], (x, KERB, z), rotation_about_y(turn), size)
    direction = tuple(b - a for a, b in zip(CAMERA, LOOK_AT))
    lens = perspective_camera("camera", VERTICAL_FOV, 16 / 9)
    document.node("camera", None, CAMERA, rotation_to_look(direction), camera=lens)
    return document
