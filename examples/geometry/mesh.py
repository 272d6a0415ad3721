"""Surfaces and triangles. Metres, +Y up, faces counter-clockwise seen from outside, colours linear."""

import math

from vector import add, cross, normalized, scale, subtract


class Material:
    """Metallic-roughness surface. `tile` is the edge in metres of one repeat of the texture; `radiance` is emitted."""

    def __init__(self, name, base_color, roughness=0.9, metallic=0.0, radiance=None, texture=None, tile=1.0):
        self.name, self.base_color, self.roughness, self.metallic = name, base_color, roughness, metallic
        self.radiance, self.texture, self.tile = radiance, texture, tile


class Surface:
    """The triangles of one mesh that share a material."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.indices = [], [], [], []


class Mesh:
    """Triangles by material. A face is flat; `grid` is smooth."""

    def __init__(self, name):
        self.name, self.surfaces = name, {}

    def surface(self, material):
        return self.surfaces.setdefault(material, Surface())

    def polygon(self, material, points, normal=None):
        """A convex flat polygon; textured materials are laid on along the two axes that the face sees best."""
        if normal is None:
            # Newell's sum: good for any planar polygon, also when its first three points lie on a line.
            normal = (0.0, 0.0, 0.0)
            for here, there in zip(points, points[1:] + points[:1]):
                normal = add(normal, cross(here, there))
            normal = normalized(normal)
        surface = self.surface(material)
        first = len(surface.positions)
        surface.positions += points
        surface.normals += [normal] * len(points)
        if material.texture:
            surface.uvs += [planar_uv(point, normal, material.tile) for point in points]
        for corner in range(1, len(points) - 1):
            surface.indices += [first, first + corner, first + corner + 1]

    def quad(self, material, a, b, c, d):
        self.polygon(material, [a, b, c, d])

    def box(self, material, low, high, skip=""):
        """Axis-aligned box; `skip` names faces to leave out: "x", "X", "y", "Y", "z", "Z" (capital: the high side)."""
        (x, y, z), (X, Y, Z) = low, high
        faces = {
            "x": [(x, y, z), (x, y, Z), (x, Y, Z), (x, Y, z)],
            "X": [(X, y, Z), (X, y, z), (X, Y, z), (X, Y, Z)],
            "y": [(x, y, z), (X, y, z), (X, y, Z), (x, y, Z)],
            "Y": [(x, Y, Z), (X, Y, Z), (X, Y, z), (x, Y, z)],
            "z": [(X, y, z), (x, y, z), (x, Y, z), (X, Y, z)],
            "Z": [(x, y, Z), (X, y, Z), (X, Y, Z), (x, Y, Z)],
        }
        for face, points in faces.items():
            if face not in skip:
                self.polygon(material, points)

    def grid(self, material, rows):
        """A smooth sheet over rows of equally many points; its front is where columns x rows turn counter-clockwise."""
        surface = self.surface(material)
        first, width = len(surface.positions), len(rows[0])
        for j, row in enumerate(rows):
            for i, point in enumerate(row):
                along = subtract(row[min(i + 1, width - 1)], row[max(i - 1, 0)])
                across = subtract(rows[min(j + 1, len(rows) - 1)][i], rows[max(j - 1, 0)][i])
                normal = normalized(cross(along, across))
                surface.positions.append(point)
                surface.normals.append(normal)
                if material.texture:
                    surface.uvs.append(planar_uv(point, normal, material.tile))
        for j in range(len(rows) - 1):
            for i in range(width - 1):
                a = first + j * width + i
                surface.indices += [a, a + 1, a + 1 + width, a, a + 1 + width, a + width]

    def tube(self, material, spine, radii, sides, capped=True):
        """A smooth tube along a polyline, one radius a point; the spine may bend but not turn back on itself."""
        rings, normals = [], []
        reference = None
        for k, point in enumerate(spine):
            axis = normalized(subtract(spine[min(k + 1, len(spine) - 1)], spine[max(k - 1, 0)]))
            if reference is None:
                reference = (1.0, 0.0, 0.0) if abs(axis[0]) < 0.8 else (0.0, 0.0, 1.0)
            # Carrying the reference along the spine keeps the rings from twisting.
            across = normalized(cross(axis, reference))
            reference = cross(across, axis)
            ring_normals = []
            for side in range(sides):
                angle = 2 * math.pi * side / sides
                ring_normals.append(add(scale(reference, math.cos(angle)), scale(across, -math.sin(angle))))
            normals.append(ring_normals)
            rings.append([add(point, scale(normal, radii[k])) for normal in ring_normals])
        surface = self.surface(material)
        first = len(surface.positions)
        for ring, ring_normals in zip(rings, normals):
            surface.positions += ring
            surface.normals += ring_normals
            if material.texture:
                surface.uvs += [planar_uv(point, normal, material.tile) for point, normal in zip(ring, ring_normals)]
        for k in range(len(spine) - 1):
            for side in range(sides):
                a, b = first + k * sides + side, first + k * sides + (side + 1) % sides
                surface.indices += [a, a + sides, b + sides, a, b + sides, b]
        if capped:
            self.polygon(material, rings[0])
            self.polygon(material, rings[-1][::-1])

    def turned(self, material, profile, sides, centre=(0.0, 0.0)):
        """A smooth solid of revolution about the vertical through `centre` (x, z), for materials without texture.

        profile: (radius, height) from the floor up; radius 0 is a tip.
        """
        surface = self.surface(material)
        first = len(surface.positions)
        for k, (radius, height) in enumerate(profile):
            below, above = profile[max(k - 1, 0)], profile[min(k + 1, len(profile) - 1)]
            out, up = above[1] - below[1], below[0] - above[0]
            size = math.hypot(out, up)
            for side in range(sides):
                angle = 2 * math.pi * side / sides
                cosine, sine = math.cos(angle), -math.sin(angle)
                surface.positions.append((centre[0] + radius * cosine, height, centre[1] + radius * sine))
                surface.normals.append((out * cosine / size, up / size, out * sine / size))
        for k in range(len(profile) - 1):
            for side in range(sides):
                a, b = first + k * sides + side, first + k * sides + (side + 1) % sides
                if profile[k][0] > 0.0:
                    surface.indices += [a, b, b + sides]
                if profile[k + 1][0] > 0.0:
                    surface.indices += [a, b + sides, a + sides]


def planar_uv(point, normal, tile):
    """Texture coordinates in repeats; v grows downward, as in glTF."""
    ax, ay, az = abs(normal[0]), abs(normal[1]), abs(normal[2])
    if ay >= ax and ay >= az:
        return (point[0] / tile, point[2] / tile)
    if ax >= az:
        return (point[2] / tile, -point[1] / tile)
    return (point[0] / tile, -point[1] / tile)
