"""A writer of binary glTF 2.0, with nothing but the standard library.

The bytes depend on the calls alone: coordinates are rounded before they are stored, so that a last digit of another
libm does not reach the file.
"""

import json
import math
import struct

POSITION_DIGITS = 4  # 0.1 mm
UNIT_DIGITS = 6

EMISSIVE_STRENGTH = "KHR_materials_emissive_strength"
LIGHTS_PUNCTUAL = "KHR_lights_punctual"


class Document:
    """A glTF scene being assembled: nodes in the order given, everything they name stored once."""

    def __init__(self, name):
        self.name = name
        self.nodes, self.roots, self.meshes, self.materials = [], [], [], []
        self.textures, self.lights, self.cameras, self.blob = [], [], [], bytearray()
        self.views, self.accessors, self.tracks = [], [], []
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

    def move(self, node, path, times, values):
        """Keys of a node's "translation", "rotation" or "scale", in seconds; between them it goes straight."""
        digits, kind = (UNIT_DIGITS, "VEC4") if path == "rotation" else (POSITION_DIGITS, "VEC3")
        keys = self._vectors([(time,) for time in times], UNIT_DIGITS, "SCALAR", bounds=True, target=None)
        self.tracks.append((node, path, keys, self._vectors(values, digits, kind, target=None)))

    def _view(self, data, target=None):
        self.blob += b"\0" * (-len(self.blob) % 4)
        view = {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data)}
        if target:
            view["target"] = target
        self.blob += data
        self.views.append(view)
        return len(self.views) - 1

    def _vectors(self, vectors, digits, kind, bounds=False, target=34962):
        values = [round(value, digits) + 0.0 for vector in vectors for value in vector]
        accessor = {"componentType": 5126, "count": len(vectors), "type": kind}
        data = struct.pack("<%df" % len(values), *values)
        if bounds:
            stored = struct.unpack("<%df" % len(values), data)
            width = len(vectors[0])
            accessor["min"] = [min(stored[k::width]) for k in range(width)]
            accessor["max"] = [max(stored[k::width]) for k in range(width)]
        accessor["bufferView"] = self._view(data, target)
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
        if self.tracks:
            targets = [{"node": node, "path": path} for node, path, _, _ in self.tracks]
            root["animations"] = [
                {
                    "name": self.name,
                    "channels": [{"sampler": k, "target": target} for k, target in enumerate(targets)],
                    "samplers": [{"input": keys, "output": values} for _, _, keys, values in self.tracks],
                }
            ]
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
