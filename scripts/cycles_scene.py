"""Renders a scene file with Blender's Cycles, for comparison: what scripts/race_cycles.py gives to Blender, to be run in it.

    blender -b --factory-startup --python scripts/cycles_scene.py -- SCENE.scene.json OUT.exr --size 512x512 --seconds 60

Of scene files it knows what the races need: geometry (.glb), point and spot lights with a hard edge, one sun, an even sky, and media of
Henyey-Greenstein species with coefficients in 1/m, in a box, a grid, everywhere, or thinning with height. Anything else is an error.
Blender's world has z up: (x, y, z) here is (x, -z, y) there. Light is spectral radiance in both; Blender states lamps by power, P = 4 pi I.
"""
import argparse
import json
import math
import os
import sys

try:
    import bpy
    import numpy
    from mathutils import Matrix, Vector
    numpy.bool = bool  # Debian's Blender 3.4 reads glTF by a name that its NumPy has lost
except ImportError:
    bpy = None  # not in Blender

SIZE_OF_EVERYTHING = 3000.0  # a medium without bounds ends so far from the origin [m]


def turned(v):
    return Vector((v[0], -v[2], v[1]))


def look(thing, direction, up=None):
    """Turns a lamp or camera, which looks along its own -z."""
    thing.rotation_mode = "QUATERNION"
    if up is None:
        thing.rotation_quaternion = turned(direction).to_track_quat("-Z", "Y")
        return
    back, up = -turned(direction).normalized(), turned(up)
    right = up.cross(back).normalized()
    thing.rotation_quaternion = Matrix((right, back.cross(right), back)).transposed().to_quaternion()


def triplet(x):
    return [x] * 3 if isinstance(x, (int, float)) else list(x)


def add(name, data):
    thing = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(thing)
    return thing


def add_light(light, number):
    kind = light["type"]
    name = "%s.%d" % (kind, number)
    if kind == "environment":
        world = bpy.context.scene.world
        world.use_nodes = True
        background = world.node_tree.nodes["Background"]
        background.inputs["Color"].default_value = triplet(light["radiance"]) + [1.0]
        background.inputs["Strength"].default_value = 1.0
        return
    data = bpy.data.lights.new(name, {"point": "POINT", "spot": "SPOT", "sun": "SUN"}[kind])
    thing = add(name, data)
    strength = triplet(light["irradiance" if kind == "sun" else "intensity"])
    most = max(strength)
    data.color = [x / most for x in strength]
    data.energy = most if kind == "sun" else most * 4.0 * math.pi
    if kind == "sun":
        data.angle = math.radians(light.get("angular_diameter", 0.0))
    else:
        thing.location = turned(light["position"])
        data.shadow_soft_size = 0.0
    if kind == "spot":
        if light["inner_angle"] != light["outer_angle"]:
            raise SystemExit("a spot with a soft edge")
        data.spot_size = 2.0 * math.radians(light["outer_angle"])
        data.spot_blend = 0.0
    if kind != "point":
        look(thing, light["direction"])


def plain_surfaces():
    """Blender's own surface for glTF has Disney's diffuse part, which at roughness 1 and grazing angles is far brighter than glTF's: in its
    place a Lambertian one and, with what a dielectric reflects in the mean, GGX."""
    for material in list(bpy.data.materials):
        tree = material.node_tree
        principled = tree.nodes["Principled BSDF"]
        color, roughness = tuple(principled.inputs["Base Color"].default_value), principled.inputs["Roughness"].default_value
        tree.nodes.clear()
        output, mix = tree.nodes.new("ShaderNodeOutputMaterial"), tree.nodes.new("ShaderNodeMixShader")
        diffuse, glossy = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeBsdfGlossy")
        diffuse.inputs["Color"].default_value = color
        glossy.distribution = "GGX"
        glossy.inputs["Roughness"].default_value = roughness
        mix.inputs[0].default_value = 0.05
        tree.links.new(diffuse.outputs[0], mix.inputs[1])
        tree.links.new(glossy.outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs["Surface"])


def medium_shader(species, profile, name):
    """A volume shader of one species: scattering and absorption in 1/m, grey."""
    phase = species["phase"]
    if phase["law"] != "henyey_greenstein":
        raise SystemExit("the law " + phase["law"])
    if "density" in species:
        extinction, albedo = species["density"], species.get("albedo", 1.0)
        scattering, absorption = extinction * albedo, extinction * (1.0 - albedo)
    else:
        scattering, absorption = species["scattering"], species["absorption"]
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    both = tree.nodes.new("ShaderNodeAddShader")
    scatter, absorb = tree.nodes.new("ShaderNodeVolumeScatter"), tree.nodes.new("ShaderNodeVolumeAbsorption")
    scatter.inputs["Color"].default_value = (1, 1, 1, 1)
    scatter.inputs["Anisotropy"].default_value = phase["g"]
    absorb.inputs["Color"].default_value = (0, 0, 0, 1)
    tree.links.new(scatter.outputs[0], both.inputs[0])
    tree.links.new(absorb.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], output.inputs["Volume"])
    factor = None
    law = profile["law"] if profile else "constant"
    if law == "exponential":
        position = tree.nodes.new("ShaderNodeNewGeometry")
        height = tree.nodes.new("ShaderNodeSeparateXYZ")
        tree.links.new(position.outputs["Position"], height.inputs[0])
        divide = tree.nodes.new("ShaderNodeMath")
        divide.operation = "DIVIDE"
        tree.links.new(height.outputs["Z"], divide.inputs[0])
        divide.inputs[1].default_value = -profile["scale_height"]
        exponential = tree.nodes.new("ShaderNodeMath")
        exponential.operation = "EXPONENT"
        tree.links.new(divide.outputs[0], exponential.inputs[0])
        factor = exponential.outputs[0]
    elif law == "grid":
        attribute = tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = profile["name"]
        factor = attribute.outputs["Fac"]
    elif law != "constant":
        raise SystemExit("the profile " + law)
    for node, density in ((scatter, scattering), (absorb, absorption)):
        if factor is None:
            node.inputs["Density"].default_value = density
            continue
        times = tree.nodes.new("ShaderNodeMath")
        times.operation = "MULTIPLY"
        times.inputs[1].default_value = density
        tree.links.new(factor, times.inputs[0])
        tree.links.new(times.outputs[0], node.inputs["Density"])
    if factor is None:
        material.cycles.homogeneous_volume = True
    return material


def add_box(low, high, material):
    corners = [[(low, high)[i >> a & 1][a] for a in range(3)] for i in range(8)]
    mesh = bpy.data.meshes.new(material.name)
    mesh.from_pydata([turned(c) for c in corners], [],
                     [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    mesh.materials.append(material)
    add(material.name, mesh)


def add_medium(medium, profile, bounds, folder, name):
    for number, species in enumerate(medium["species"]):
        inner = species.get("profile")
        if profile and profile["law"] == "box":
            add_box(profile["min"], profile["max"], medium_shader(species, inner, "%s.%d" % (name, number)))
        elif profile and profile["law"] == "grid":
            data = bpy.data.volumes.new(name)
            data.filepath = os.path.join(folder, profile["file"])
            data.materials.append(medium_shader(species, profile, "%s.%d" % (name, number)))
            thing = add(name, data)
            thing.rotation_mode = "XYZ"
            thing.rotation_euler = (math.pi / 2, 0, 0)
        elif profile is None:
            high = [SIZE_OF_EVERYTHING] * 3
            low = [-x for x in high]
            if inner and inner["law"] == "exponential":
                low[1], high[1] = -1.0, 15.0 * inner["scale_height"]
            if bounds:
                low, high = bounds
            add_box(low, high, medium_shader(species, inner, "%s.%d" % (name, number)))
        else:
            raise SystemExit("the profile " + profile["law"])


def main():
    parser = argparse.ArgumentParser(description="Render a scene file with Cycles, in Blender.")
    parser.add_argument("scene")
    parser.add_argument("output")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--seconds", type=float, default=0.0)
    parser.add_argument("--samples", type=int, default=1 << 20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--bounds", help="six numbers: where a medium without bounds ends")
    arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else None)
    if bpy is None:
        sys.exit("cycles_scene: this runs in Blender: blender -b --factory-startup --python scripts/cycles_scene.py -- ..")
    bounds = None
    if arguments.bounds:
        numbers = [float(x) for x in arguments.bounds.split(",")]
        bounds = numbers[:3], numbers[3:]
    folder = os.path.dirname(os.path.abspath(arguments.scene))
    with open(arguments.scene, encoding="utf-8") as file:
        description = json.load(file)

    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    scene.render.engine = "CYCLES"
    for geometry in description.get("geometry", []):
        bpy.ops.import_scene.gltf(filepath=os.path.join(folder, geometry))
    plain_surfaces()
    for number, light in enumerate(description["lights"]):
        add_light(light, number)
    if "medium" in description:
        add_medium(description["medium"], None, bounds, folder, "air")
    for number, volume in enumerate(description.get("volumes", [])):
        add_medium(volume["medium"], volume["profile"], None, folder, "volume.%d" % number)

    camera = description["camera"]
    data = bpy.data.cameras.new("camera")
    thing = add("camera", data)
    thing.location = turned(camera["position"])
    look(thing, [a - b for a, b in zip(camera["look_at"], camera["position"])], camera.get("up", [0, 1, 0]))
    data.sensor_fit, data.sensor_height = "VERTICAL", 24.0
    data.lens = 12.0 / math.tan(math.radians(camera["vertical_fov"]) / 2)
    data.clip_start, data.clip_end = 1e-3, 1e6
    scene.camera = thing

    width, height = (int(x) for x in arguments.size.split("x"))
    render, cycles = scene.render, scene.cycles
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100
    render.threads_mode, render.threads = "FIXED", arguments.threads
    render.use_persistent_data = False
    cycles.device = "CPU"
    cycles.samples, cycles.seed, cycles.time_limit = arguments.samples, arguments.seed, arguments.seconds
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.max_bounces = cycles.volume_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 1024
    cycles.transmission_bounces = cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0.0
    cycles.volume_max_steps = 65536
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode, render.image_settings.color_depth = "RGB", "32"
    render.image_settings.exr_codec = "ZIP"
    render.filepath = os.path.abspath(arguments.output)
    bpy.ops.render.render(write_still=True)


main()
