"""A small hatchback of flat panels, 4.2 m long, looking along -Z with its wheels on y = 0."""

import math

from mesh import Material, Mesh
from vector import add, scale

PAINT = Material("car paint", (0.23, 0.02, 0.018), roughness=0.3)
GLASS = Material("car glass", (0.012, 0.014, 0.017), roughness=0.25)
RUBBER = Material("rubber", (0.015, 0.015, 0.015), roughness=0.9)
RIM = Material("rim", (0.45, 0.45, 0.46), roughness=0.35)
TRIM = Material("trim", (0.02, 0.02, 0.022), roughness=0.6)
PLATE = Material("number plate", (0.75, 0.75, 0.68), roughness=0.6)
LENS = Material("headlight lens", (0.0, 0.0, 0.0), roughness=1.0, metallic=1.0, radiance=(8.4, 9.3, 10.0))
TAIL = Material("tail light", (0.1, 0.0, 0.0), roughness=0.5, radiance=(1.6, 0.04, 0.02))

# From nose to tail: z; heights of the sill, of the widest line and of the shoulder; half widths at those three.
STATIONS = [
    (-2.08, 0.30, 0.50, 0.66, 0.66, 0.70, 0.64),
    (-1.95, 0.21, 0.52, 0.74, 0.78, 0.82, 0.74),
    (-1.30, 0.19, 0.58, 0.86, 0.83, 0.87, 0.78),
    (-0.72, 0.19, 0.60, 0.93, 0.84, 0.88, 0.79),
    (0.60, 0.19, 0.62, 0.96, 0.84, 0.88, 0.79),
    (1.55, 0.20, 0.64, 0.98, 0.83, 0.87, 0.77),
    (1.98, 0.26, 0.64, 0.96, 0.79, 0.82, 0.72),
    (2.10, 0.34, 0.60, 0.88, 0.72, 0.76, 0.66),
]
# Corners of the glasshouse on the right side: foot and top of the windscreen, the middle pillar and the rear window.
CABIN = {
    "front": ((0.77, 0.93, -0.78), (0.57, 1.43, 0.02)),
    "middle": ((0.78, 0.96, 0.52), (0.58, 1.47, 0.58)),
    "rear": ((0.74, 0.97, 1.86), (0.56, 1.40, 1.42)),
}
WHEEL_RADIUS = 0.32
AXLES = (-1.32, 1.28)
HEADLIGHTS = [(-0.56, 0.61, -2.12), (0.56, 0.61, -2.12)]


def mirrored(point):
    return (-point[0], point[1], point[2])


def between(a, b, t):
    return add(scale(a, 1 - t), scale(b, t))


def both_sides(mesh, material, points):
    """A panel given counter-clockwise for the right side, and its mirror image."""
    mesh.polygon(material, points)
    mesh.polygon(material, [mirrored(point) for point in reversed(points)])


def body(mesh):
    def right_profile(station):
        z, sill, wide, shoulder, half_sill, half_wide, half_shoulder = station
        return [(half_sill, sill, z), (half_wide, wide, z), (half_shoulder, shoulder, z)]

    for station, following in zip(STATIONS, STATIONS[1:]):
        ahead, behind = right_profile(station), right_profile(following)
        for low in range(2):
            both_sides(mesh, PAINT, [ahead[low], ahead[low + 1], behind[low + 1], behind[low]])
        mesh.quad(PAINT, mirrored(ahead[2]), mirrored(behind[2]), behind[2], ahead[2])
        mesh.quad(TRIM, ahead[0], behind[0], mirrored(behind[0]), mirrored(ahead[0]))
    nose, tail = right_profile(STATIONS[0]), right_profile(STATIONS[-1])
    for low in range(2):
        mesh.quad(PAINT, nose[low], mirrored(nose[low]), mirrored(nose[low + 1]), nose[low + 1])
        mesh.quad(PAINT, mirrored(tail[low]), tail[low], tail[low + 1], mirrored(tail[low + 1]))


def glasshouse(mesh):
    pillars = [CABIN["front"], CABIN["middle"], CABIN["rear"]]
    for (foot, top), (next_foot, next_top) in zip(pillars, pillars[1:]):
        # The frame is the whole side; the pane lies 8 mm in front of it, inset so that the frame shows as pillars.
        frame = [foot, top, next_top, next_foot]
        both_sides(mesh, PAINT, frame)
        middle = scale(add(add(foot, top), add(next_foot, next_top)), 0.25)
        pane = [add(between(middle, corner, 0.87), (0.008, 0.003, 0.0)) for corner in frame]
        both_sides(mesh, GLASS, pane)
        mesh.quad(PAINT, top, mirrored(top), mirrored(next_top), next_top)
    for (foot, top), outward in ((pillars[0], -0.01), (pillars[2], 0.01)):
        sheet = [mirrored(foot), foot, top, mirrored(top)]
        if outward < 0:
            sheet.reverse()
        mesh.polygon(PAINT, sheet)
        middle = scale(add(add(sheet[0], sheet[1]), add(sheet[2], sheet[3])), 0.25)
        mesh.polygon(GLASS, [add(between(middle, corner, 0.9), (0.0, 0.008, outward)) for corner in sheet])


def disc(mesh, material, centre, radius, sides, direction):
    """A regular polygon in the plane x = const, facing +x or -x."""
    x, y, z = centre
    ring = [
        (x, y + radius * math.cos(2 * math.pi * k / sides), z + direction * radius * math.sin(2 * math.pi * k / sides))
        for k in range(sides)
    ]
    mesh.polygon(material, ring, (float(direction), 0.0, 0.0))


def wheels(mesh):
    for z in AXLES:
        for side in (-1, 1):
            # A dark disc just off the flank reads as the wheel arch.
            disc(mesh, TRIM, (side * 0.885, WHEEL_RADIUS + 0.02, z), WHEEL_RADIUS + 0.06, 18, side)
            spine = [(side * 0.66, WHEEL_RADIUS, z), (side * 0.90, WHEEL_RADIUS, z)]
            mesh.tube(RUBBER, spine, [WHEEL_RADIUS, WHEEL_RADIUS], 16)
            disc(mesh, RIM, (side * 0.905, WHEEL_RADIUS, z), 0.2, 10, side)
            disc(mesh, TRIM, (side * 0.91, WHEEL_RADIUS, z), 0.07, 8, side)


def panel(mesh, material, low, high, z, facing):
    """A rectangle in the plane z = const."""
    (x, y), (X, Y) = low, high
    points = [(x, y, z), (X, y, z), (X, Y, z), (x, Y, z)]
    mesh.polygon(material, points if facing > 0 else points[::-1])


def details(mesh):
    for x, y, z in HEADLIGHTS:
        panel(mesh, TRIM, (x - 0.16, y - 0.085), (x + 0.16, y + 0.085), z + 0.02, -1)
        panel(mesh, LENS, (x - 0.125, y - 0.055), (x + 0.125, y + 0.055), z + 0.01, -1)
        panel(mesh, TAIL, (x - 0.1, 0.68), (x + 0.1, 0.82), 2.115, 1)
    panel(mesh, TRIM, (-0.34, 0.53), (0.34, 0.66), -2.095, -1)
    panel(mesh, TRIM, (-0.6, 0.31), (0.6, 0.43), -2.095, -1)
    panel(mesh, PLATE, (-0.26, 0.42), (0.26, 0.53), -2.1, -1)
    panel(mesh, PLATE, (-0.26, 0.5), (0.26, 0.61), 2.115, 1)
    for side in (-1, 1):
        low, high = sorted((side * 0.8, side * 1.0))
        mesh.box(PAINT, (low, 0.93, -0.62), (high, 1.06, -0.52))


def build():
    mesh = Mesh("car")
    body(mesh)
    glasshouse(mesh)
    wheels(mesh)
    details(mesh)
    return mesh
