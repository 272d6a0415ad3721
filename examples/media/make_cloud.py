#!/usr/bin/env python3
"""Makes a cumulus of voxels as an OpenVDB file; examples/media/cumulus.vdb is what it writes by itself.

    make_cloud.py [--voxels N] [-o FILE]     N along the longest edge (default 128); Debian: python3-openvdb, python3-numpy

The grid "density" goes from 0 to 1, stands on the origin (bottom at y = 0) and is 2 units wide. Spheres of random size, fewer and
smaller with height, are joined smoothly; lattice noise of five sizes eats into them. Seeded: the same voxels every time.
"""
import argparse
import pathlib

import numpy
import pyopenvdb


def lattice_noise(points, scale, random):
    """Smooth noise from -1 to 1 at points, its features scale across."""
    period = 64
    values = random.uniform(-1.0, 1.0, (period, period, period))
    at = points / scale + 100.0
    cell = numpy.floor(at).astype(int)
    share = at - cell
    share = share * share * (3.0 - 2.0 * share)
    total = 0.0
    for corner in range(8):
        step = numpy.array([corner & 1, corner >> 1 & 1, corner >> 2])
        weight = numpy.prod(numpy.where(step, share, 1.0 - share), axis=-1)
        i, j, k = numpy.moveaxis((cell + step) % period, -1, 0)
        total = total + weight * values[i, j, k]
    return total


def cumulus(voxels):
    """Density from 0 to 1 in an array [x, y, z], and the edge of a voxel."""
    random = numpy.random.default_rng(7)
    edge = 2.0 / voxels
    shape = (voxels, int(0.62 * voxels), int(0.8 * voxels))
    points = numpy.stack(numpy.meshgrid(*[numpy.arange(n) for n in shape], indexing="ij"), axis=-1) * edge
    points = points - numpy.array([1.0, 0.0, 0.8])
    inside = numpy.zeros(shape)  # soft union: sum of exponentials of depth
    for _ in range(34):
        height = 0.72 * random.uniform() ** 1.6
        spread = 0.62 * (1.0 - 0.85 * height)
        angle, out = random.uniform(0.0, 2.0 * numpy.pi), spread * numpy.sqrt(random.uniform())
        centre = numpy.array([out * numpy.cos(angle), 0.16 + height, 0.72 * out * numpy.sin(angle)])
        radius = random.uniform(0.13, 0.27) * (1.0 - 0.35 * height)
        inside += numpy.exp(14.0 * (radius - numpy.linalg.norm(points - centre, axis=-1)))
    depth = numpy.log(numpy.maximum(inside, 1e-30)) / 14.0
    for octave in range(5):
        scale = 0.32 / 2.0**octave
        depth += 0.34 * scale * lattice_noise(points, scale, random)
    depth -= 0.03
    depth = numpy.minimum(depth, (points[..., 1] - 0.06 - 0.03 * lattice_noise(points, 0.2, random)) * 1.2)  # flat base
    density = numpy.clip(depth / 0.07, 0.0, 1.0)
    return numpy.round(density * 64.0) / 64.0, edge  # few different numbers: the file is small


def main():
    here = pathlib.Path(__file__).resolve().parent
    parser = argparse.ArgumentParser()
    parser.add_argument("--voxels", type=int, default=128)
    parser.add_argument("-o", "--output", default=str(here / "cumulus.vdb"))
    arguments = parser.parse_args()
    density, edge = cumulus(arguments.voxels)
    grid = pyopenvdb.FloatGrid()
    grid.copyFromArray(density.astype(numpy.float32))
    grid.prune()
    grid.name = "density"
    grid.gridClass = pyopenvdb.GridClass.FOG_VOLUME
    grid.saveFloatAsHalf = True
    grid.transform = pyopenvdb.createLinearTransform(edge)
    grid.transform.translate((-1.0, 0.0, -0.8))
    pyopenvdb.write(arguments.output, grids=[grid])


if __name__ == "__main__":
    main()
