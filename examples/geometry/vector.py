"""Points and directions as (x, y, z) tuples, and rotations as the quaternions of glTF, (x, y, z, w)."""

import math


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def subtract(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def normalized(a):
    return scale(a, 1.0 / length(a))


def rotation_about_y(degrees):
    """Quaternion of a turn about +Y; positive takes -Z toward -X, as seen from above to the left."""
    half = math.radians(degrees) / 2
    return (0.0, math.sin(half), 0.0, math.cos(half))


def rotation_to_look(direction):
    """Quaternion that points a node's -Z along `direction` and keeps its +X level: what cameras and spots need."""
    x, y, z = normalized(direction)
    yaw, pitch = math.atan2(-x, -z) / 2, math.asin(y) / 2
    sy, cy, sp, cp = math.sin(yaw), math.cos(yaw), math.sin(pitch), math.cos(pitch)
    return (cy * sp, sy * cp, -sy * sp, cy * cp)
