"""A night street: facades, lamps, a car pulling out, and marker posts at 25, 50, 100 and 200 m from the camera.

The road runs along -Z. Lamps and headlights are KHR_lights_punctual nodes of this file; the sky is in the scene file.
"""

import math
import random

import car
import facade
import marker
import texture
import tree
from glb import Document, perspective_camera, point_light, spot_light
from mesh import Material, Mesh
from vector import rotation_about_y, rotation_to_look

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
# Where it goes on to: seconds, place, yaw.
CAR_KEYS = [(0.0, CAR_AT, CAR_YAW), (1.0, (-2.15, 0.0, -21.2), 140.0), (2.0, (-3.3, 0.0, -20.2), 127.0)]

MARKER_DISTANCES = (25, 50, 100, 200)

ASPHALT = Material("wet asphalt", (0.8, 0.8, 0.82), roughness=0.34, texture=texture.asphalt(), tile=4.0)
PUDDLE = Material("puddle", (0.016, 0.017, 0.019), roughness=0.2)
SLABS = Material("pavement", (0.13, 0.125, 0.12), roughness=0.5)
JOINT = Material("pavement joint", (0.05, 0.05, 0.05), roughness=0.7)
STONE = Material("kerb stone", (0.26, 0.25, 0.23), roughness=0.45)
PAINT = Material("road paint", (0.62, 0.62, 0.58), roughness=0.4)
# What sits within a hand of a lamp's point light returns nothing, or it would be a second, blinding lamp.
BLACK = Material("lamp housing", (0.0, 0.0, 0.0), roughness=1.0, metallic=1.0)
BULB = Material("lamp bulb", (0.0, 0.0, 0.0), roughness=1.0, metallic=1.0, radiance=(24.0, 15.0, 6.5))
HANDS = Material("clock hands", (0.012, 0.012, 0.014), roughness=0.8)
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


def facades(source):
    mesh = Mesh("facades")
    for side in (-1, 1):
        near, count = NEAR_END, 0
        while near > FAR_END + 12:
            width = 8.5 + 5.5 * source.random()
            floors = 2 + int(2.6 * source.random())
            wall = facade.WALLS[(count * 3 + (2 if side > 0 else 0) + int(2 * source.random())) % len(facade.WALLS)]
            facade.house(mesh, side, FACADE, near, width, floors, wall, source)
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
        mesh.polygon(facade.ROOF, [here, there, (x, 58.0, z - 4.2)])
    mesh.box(CHURCH, (x - 13, 0, z - 40), (x + 13, 14, z - 4), skip="y")
    for gable_z in (z - 4, z - 40):
        gable = [(x - 13, 14, gable_z), (x + 13, 14, gable_z), (x, 22, gable_z)]
        mesh.polygon(CHURCH, gable if gable_z == z - 4 else gable[::-1])
    for side in (-1, 1):
        slope = [(x + side * 13, 14, z - 4), (x + side * 13, 14, z - 40), (x, 22, z - 40), (x, 22, z - 4)]
        mesh.polygon(facade.ROOF, slope if side > 0 else slope[::-1])
    face = [(x + 1.7 * math.cos(k * math.pi / 8), 25 + 1.7 * math.sin(k * math.pi / 8), z + 0.05) for k in range(16)]
    mesh.polygon(CLOCK, face)
    front = z + 0.09
    for low, high in (((-0.12, 0.0), (0.12, 1.4)), ((0.0, -0.12), (0.95, 0.12))):  # three o'clock
        (left, bottom), (right, top) = (x + low[0], 25 + low[1]), (x + high[0], 25 + high[1])
        mesh.quad(HANDS, (left, bottom, front), (right, bottom, front), (right, top, front), (left, top, front))
    return mesh


def lamp():
    """A post with an arm toward +X and a shaded head; the light belongs at LAMP_LIGHT."""
    mesh = Mesh("street lamp")
    mesh.tube(facade.IRON, [(0, 0, 0), (0, 0.9, 0)], [0.13, 0.11], 8)
    arm = [(0.0, 0.9, 0.0), (0.0, 6.2, 0.0)]
    for k in range(1, 6):  # quarter of an ellipse from the post to the head
        angle = 0.5 * math.pi * k / 5
        arm.append((LAMP_REACH * (1 - math.cos(angle)) * 0.86, 6.2 + 1.0 * math.sin(angle), 0.0))
    mesh.tube(facade.IRON, arm, [0.085] + [0.06] * (len(arm) - 2) + [0.045], 8)
    mesh.box(BLACK, (LAMP_REACH - 0.38, 7.1, -0.17), (LAMP_REACH + 0.32, 7.24, 0.17), skip="Y")
    back, tip = LAMP_REACH - 0.38, LAMP_REACH + 0.32
    hood = [(back, -0.17), (back, 0.17), (tip, 0.17), (tip, -0.17)]
    top = (LAMP_REACH - 0.05, 7.36, 0.0)
    for (x, z), (x2, z2) in zip(hood, hood[1:] + hood[:1]):
        mesh.polygon(facade.IRON, [(x, 7.24, z), (x2, 7.24, z2), top])
    ring = [(LAMP_REACH + 0.15 * math.cos(k * math.pi / 3), 7.1, -0.13 * math.sin(k * math.pi / 3)) for k in range(6)]
    for here, there in zip(ring, ring[1:] + ring[:1]):
        mesh.polygon(BULB, [there, here, (LAMP_REACH, 6.96, 0.0)])
    return mesh


LAMP_LIGHT = (LAMP_REACH, LAMP_HEIGHT - 0.04, 0.0)

def marker_plate(distance):
    """Where the middle of the plate is: exactly `distance` from the camera, over the right-hand pavement."""
    size = math.sqrt(distance / 25.0)
    x, y = ROAD + 0.75 + 0.1 * size, 0.5 + 1.05 * size
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
    times, places, yaws = zip(*CAR_KEYS)
    document.move(body, "translation", times, places)
    document.move(body, "rotation", times, [rotation_about_y(yaw) for yaw in yaws])
    for name, (x, y, z) in zip(("left", "right"), car.HEADLIGHTS):
        light = spot_light("headlight " + name, COOL_WHITE, HEADLIGHT_INTENSITY, 7.0, 17.0)
        aim = rotation_to_look((0.03 if x > 0 else -0.03, -0.035, -1.0))
        document.node("headlight " + name, None, (x, y, z - 0.03), aim, light=light, parent=body)
    for bands, distance in enumerate(MARKER_DISTANCES, start=1):
        plate = marker_plate(distance)
        document.node("marker %d m" % distance, marker.build(distance, bands, KERB - plate[1]), plate)
    trees = [tree.bare("tree a", BARK, 5), tree.bare("tree b", BARK, 8)]
    places = [(-6.1, -35.0, 20, 1.0), (6.3, -43.5, 200, 1.1), (-6.2, -75.0, 110, 1.15), (6.2, -90.0, 300, 1.0)]
    for number, (x, z, turn, size) in enumerate(places):
        document.node("tree %d" % number, trees[number % 2], (x, KERB, z), rotation_about_y(turn), size)
    direction = tuple(b - a for a, b in zip(CAMERA, LOOK_AT))
    lens = perspective_camera("camera", VERTICAL_FOV, 16 / 9)
    document.node("camera", None, CAMERA, rotation_to_look(direction), camera=lens)
    return document
