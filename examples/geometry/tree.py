"""Trees: a bare broad-leaved one grown by forking, and a conifer of stacked ragged cones."""

import math
import random

from mesh import Mesh
from vector import add, cross, normalized, scale


def bare(name, bark, seed, height=9.0, depth=6):
    """A leafless tree on y = 0, about `height` metres tall; every fork keeps the cross-section (Leonardo's rule)."""
    mesh, source = Mesh(name), random.Random(seed)

    def around(axis, tilt, turn):
        side = normalized(cross(axis, (0.31, 0.17, 0.93)))
        other = cross(axis, side)
        ring = add(scale(side, math.cos(turn)), scale(other, math.sin(turn)))
        return normalized(add(scale(axis, math.cos(tilt)), scale(ring, math.sin(tilt))))

    def grow(point, axis, reach, radius, level):
        # Two bows a branch: straight sticks look like wire.
        middle_axis = around(axis, 0.12 + 0.1 * source.random(), 6.283 * source.random())
        middle = add(point, scale(middle_axis, 0.5 * reach))
        axis = normalized(add(axis, (0.0, 0.12, 0.0)))
        end = add(middle, scale(axis, 0.5 * reach))
        tip = radius * 0.75
        sides = 7 if level == 0 else 4 if level < 3 else 3
        mesh.tube(bark, [point, middle, end], [radius, 0.88 * radius, tip], sides, capped=False)
        if level == depth:
            return
        forks = 3 if level in (1, 2) else 2
        turn = 6.283 * source.random()
        for fork in range(forks):
            tilt = 0.3 + 0.38 * source.random()
            share = (1.0 / forks) ** 0.5
            child = around(axis, tilt, turn + 6.283 * fork / forks + 0.7 * source.random())
            grow(end, child, reach * (0.68 + 0.2 * source.random()), tip * share * 1.12, level + 1)

    grow((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), height * 0.27, height * 0.021, 0)
    return mesh


def conifer(name, needles, bark, seed, height=1.0, tiers=7, sides=9):
    """A spruce on y = 0: drooping tiers with ragged hems, slimmer toward the tip."""
    mesh, source = Mesh(name), random.Random(seed)
    mesh.tube(bark, [(0, 0, 0), (0, 0.3 * height, 0)], [0.022 * height, 0.016 * height], 5, capped=False)
    for tier in range(tiers):
        low = height * (0.08 + 0.86 * tier / tiers)
        top = min(height, low + height * (0.30 - 0.018 * tier))
        reach = height * 0.2 * (1 - 0.9 * tier / tiers)
        apex = (0.0, top, 0.0)
        hem = []
        for side in range(sides * 2):
            angle = math.pi * (side + 0.6 * source.random()) / sides
            out = reach * ((0.9 + 0.3 * source.random()) if side % 2 == 0 else (0.5 + 0.15 * source.random()))
            droop = 0.05 * height * source.random() if side % 2 == 0 else -0.035 * height
            hem.append((out * math.cos(angle), low - droop, -out * math.sin(angle)))
        for here, there in zip(hem, hem[1:] + hem[:1]):
            mesh.polygon(needles, [apex, here, there])
    return mesh
