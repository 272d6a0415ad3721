"""Meshes and a writer of binary glTF 2.0, with nothing but the standard library.

Lengths are metres, +Y is up, faces are counter-clockwise seen from outside, colours are linear. The bytes depend on the
calls alone: coordinates are rounded before they are stored, so that a last digit of another libm does not reach the file.
"""

import json
import math
import struct

POSITION_DIGITS = 4  # 0.1 mm
UNIT_DIGITS = 6

EMISSIVE_STRENGTH = "KHR_materials_emissive_strength"
LIGHTS_PUNCTUAL = "KHR_lights_punctual"


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
    """Quaternion (x, y, z, w) of a turn about +Y; positive takes -Z toward -X, as seen from above to the left."""
    half = math.radians(degrees) / 2
    return (0.0, math.sin(half), 0.0, math.cos(half))


def rotation_to_look(direction):
    """Quaternion that points a node's -Z along `direction` and keeps its +X level: what cameras and spots need."""
    x, y, z = normalized(direction)
    yaw, pitch = math.atan2(-x, -z) / 2, math.asin(y) / 2
    sy, cy, sp, cp = math.sin(yaw), math.cos(yaw), math.sin(pitch), math.cos(pitch)
    return (cy * sp, sy * cp, -sy * sp, cy * cp)


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
        """Axis-aligned box; `skip` names faces to leave out, out of "x", "X", "y", "Y", "z", "Z" (capital: high side)."""
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


class Document:
    """A glTF scene being assembled: nodes in the order given, everything they name stored once."""

    def __init__(self, name):
        self.name = name
        self.nodes, self.roots, self.meshes, self.materials = [], [], [], []
        self.textures, self.lights, self.cameras, self.blob = [], [], [], bytearray()
        self.views, self.accessors = [], []
        self.mesh_index, self.material_index, self.texture_index = {}, {}, {}
        self.triangle_count = 0  # as drawn: a mesh counts once for every node that shows it

    def node(self, name, mesh=None, translation=None, rotation=None, size=None, light=None, camera=None, parent=None):
        node = {"name": name}
        if translation is not None:
            node["translation"] = [round(value, POSITION_DIGITS) + 0.0 for value in translation]
        if rotation is not None:
            node["rotation"] = [round(value, UNIT_DIGITS) + 0.0 for value in rotation]
        if size is not None:
            node["scale"] = [size] * 3
        if mesh is not None:
            node["mesh"] = self._mesh(mesh)
            self.triangle_count += sum(len(surface.indices) // 3 for surface in mesh.surfaces.values())
        if camera is not None:
            node["camera"] = len(self.cameras)
            self.cameras.append(camera)
        if light is not None:
            node["extensions"] = {LIGHTS_PUNCTUAL: {"light": len(self.lights)}}
            self.lights.append(light)
        index = len(self.nodes)
        self.nodes.append(node)
        if parent is None:
            self.roots.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def _view(self, data, target=None):
        self.blob += b"\0" * (-len(self.blob) % 4)
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.blob += data
        self.views.append(view)
        return len(self.views) - 1

    def _vectors(self, vectors, digits, kind, bounds=False):
        values = [round(value, digits) + 0.0 for vector in vectors for value in vector]
        accessor = {"componentType": 5126, "count": len(vectors), "type": kind}
        data = struct.pack("<%df" % len(values), *values)
        if bounds:
            stored = struct.unpack("<%df" % len(values), data)
            width = len(vectors[0])
            accessor["min"] = [min(stored[k::width]) for k in range(width)]
            accessor["max"] = [max(stored[k::width]) for k in range(width)]
        accessor["bufferView"] = self._view(data, 34962)
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def _indices(self, indices):
        wide = max(indices) > 65534
        data = struct.pack("<%d%s" % (len(indices), "I" if wide else "H"), *indices)
        accessor = {"componentType": 5125 if wide else 5123, "count": len(indices), "type": "SCALAR"}
        accessor["bufferView"] = self._view(data, 34963)
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def _mesh(self, mesh):
        if mesh not in self.mesh_index:
            primitives = []
            for material, surface in mesh.surfaces.items():
                attributes = {
                    "POSITION": self._vectors(surface.positions, POSITION_DIGITS, "VEC3", bounds=True),
                    "NORMAL": self._vectors(surface.normals, UNIT_DIGITS, "VEC3"),
                }
                if material.texture:
                    attributes["TEXCOORD_0"] = self._vectors(surface.uvs, POSITION_DIGITS, "VEC2")
                primitives.append(
                    {
                        "attributes": attributes,
                        "indices": self._indices(surface.indices),
                        "material": self._material(material),
                    }
                )
            self.mesh_index[mesh] = len(self.meshes)
            self.meshes.append({"name": mesh.name, "primitives": primitives})
        return self.mesh_index[mesh]

    def _material(self, material):
        if material not in self.material_index:
            surface = {
                "baseColorFactor": [*material.base_color, 1.0],
                "metallicFactor": material.metallic,
                "roughnessFactor": material.roughness,
            }
            if material.texture:
                surface["baseColorTexture"] = {"index": self._texture(material.texture)}
            entry = {"name": material.name, "pbrMetallicRoughness": surface}
            if material.radiance:
                # emissiveFactor may not exceed 1: the brightest channel goes into the strength.
                strength = max(material.radiance)
                entry["emissiveFactor"] = [round(value / strength, UNIT_DIGITS) for value in material.radiance]
                entry["extensions"] = {EMISSIVE_STRENGTH: {"emissiveStrength": strength}}
            self.material_index[material] = len(self.materials)
            self.materials.append(entry)
        return self.material_index[material]

    def _texture(self, texture):
        name, png = texture
        if name not in self.texture_index:
            self.texture_index[name] = len(self.textures)
            self.textures.append({"name": name, "mimeType": "image/png", "bufferView": self._view(png)})
        return self.texture_index[name]

    def to_bytes(self):
        used = []
        if self.lights:
            used.append(LIGHTS_PUNCTUAL)
        if any("extensions" in material for material in self.materials):
            used.append(EMISSIVE_STRENGTH)
        root = {"asset": {"version": "2.0", "generator": "Tyndall examples/geometry/make_geometry.py"}, "scene": 0}
        root["scenes"] = [{"name": self.name, "nodes": self.roots}]
        if used:
            root["extensionsUsed"] = used
        if self.lights:
            root["extensions"] = {LIGHTS_PUNCTUAL: {"lights": self.lights}}
        root["nodes"] = self.nodes
        root["meshes"] = self.meshes
        root["materials"] = self.materials
        if self.textures:
            root["textures"] = [{"name": t["name"], "source": k, "sampler": 0} for k, t in enumerate(self.textures)]
            root["images"] = self.textures
            root["samplers"] = [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497}]
        if self.cameras:
            root["cameras"] = self.cameras
        root["accessors"] = self.accessors
        root["bufferViews"] = self.views
        self.blob += b"\0" * (-len(self.blob) % 4)
        root["buffers"] = [{"byteLength": len(self.blob)}]
        text = json.dumps(root, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
        chunks += struct.pack("<II", len(self.blob), 0x004E4942) + bytes(self.blob)
        return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def point_light(name, color, intensity):
    """KHR_lights_punctual point light; intensity in cd, read as W/sr."""
    return {"name": name, "type": "point", "color": list(color), "intensity": intensity}


def spot_light(name, color, intensity, inner_degrees, outer_degrees):
    """KHR_lights_punctual spot along the node's -Z; angles off axis."""
    cone = {
        "innerConeAngle": round(math.radians(inner_degrees), UNIT_DIGITS),
        "outerConeAngle": round(math.radians(outer_degrees), UNIT_DIGITS),
    }
    return {"name": name, "type": "spot", "color": list(color), "intensity": intensity, "spot": cone}


def perspective_camera(name, vertical_fov_degrees, aspect, near=0.1):
    lens = {"yfov": round(math.radians(vertical_fov_degrees), UNIT_DIGITS), "aspectRatio": round(aspect, UNIT_DIGITS)}
    return {"name": name, "type": "perspective", "perspective": {**lens, "znear": near}}
