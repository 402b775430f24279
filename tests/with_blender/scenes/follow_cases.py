"""blender -b --factory-startup --python follow_cases.py -- FOLDER: scenes for tests/with_blender/follow_test.cpp.

cells.blend: small scenes so far apart that none lights another, each with a floor under it and one thing that a tracer has to
follow. nosky.blend, sets.blend: the same for what concerns a whole scene. judged.blend: for validate.
"""
import math
import os
import sys

import bpy

APART = 60.0
POINT = 4 * math.pi ** 2  # W that give an E/pi of 1 at a distance of 1, straight below


def new_tree(block):
    if not block.use_nodes:
        block.use_nodes = True
    block.node_tree.nodes.clear()
    return block.node_tree


def material(name, kind="BsdfDiffuse", socket="Surface", **inputs):
    made = bpy.data.materials.new(name)
    tree = new_tree(made)
    shader = tree.nodes.new("ShaderNode" + kind)
    for key, value in inputs.items():
        shader.inputs[key].default_value = value
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[socket])
    return made


def add_input(made, node_kind, output, socket, **settings):
    """A node that feeds the shader of a material."""
    tree = made.node_tree
    node = tree.nodes.new("ShaderNode" + node_kind)
    for key, value in settings.items():
        setattr(node, key, value)
    shader = next(one for one in tree.nodes if any(out.type == "SHADER" for out in one.outputs))
    tree.links.new(node.outputs[output], shader.inputs[socket])
    return node


def mesh_object(name, corners, faces, made, at):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    layer = mesh.uv_layers.new(name="Lightmap")
    columns = math.ceil(math.sqrt(len(faces)))
    for face in mesh.polygons:
        for k, loop in enumerate(face.loop_indices):
            x, y = face.index % columns + (0, 1, 1, 0)[k], face.index // columns + (0, 0, 1, 1)[k]
            layer.data[loop].uv = (x / columns, y / columns)
    mesh.materials.append(made)
    ob = bpy.data.objects.new(name, mesh)
    ob.location = at
    bpy.context.scene.collection.objects.link(ob)
    return ob


def square(name, half, made, at, down=False):
    corners = [(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)]
    return mesh_object(name, corners, [(0, 3, 2, 1) if down else (0, 1, 2, 3)], made, at)


def room(name, made, at):
    """Two units a side, seen from within."""
    corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
    return mesh_object(name, corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                                       (1, 5, 7, 3)], made, at)


def lamp(name, kind, at, energy, **settings):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    if kind == "POINT":
        data.shadow_soft_size = 0
    for key, value in settings.items():
        setattr(data, key, value)
    ob = bpy.data.objects.new(name, data)
    ob.location = at
    bpy.context.scene.collection.objects.link(ob)
    return ob


class Cells:
    """Each with a small black floor at its origin, which is what is measured."""

    def __init__(self):
        self.count = 0
        self.black = material("black", Color=(0, 0, 0, 1))

    def new(self, name):
        place = (APART * (self.count % 4), APART * (self.count // 4), 0)
        self.count += 1
        if name:
            square(name, 0.01, self.black, place)
        return lambda x, y, z: (place[0] + x, place[1] + y, place[2] + z)


def new_world(color=(0, 0, 0), strength=1.0):
    world = bpy.data.worlds.new("world")
    tree = new_tree(world)
    background = tree.nodes.new("ShaderNodeBackground")
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (*color, 1), strength
    tree.links.new(background.outputs[0], tree.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
    bpy.context.scene.world = world
    return world


def glowing(name, **inputs):
    return material(name, "Emission", **inputs)


def cells():
    new_world()
    made = Cells()
    at = made.new("fog")
    lamp("lamp of fog", "POINT", at(0, 0, 1), POINT)
    square("mist", 3, material("mist", "VolumeAbsorption", "Volume", Density=1e-9), at(0, 0, 0.5))
    at = made.new("")
    lamp("lamp of room", "POINT", at(0, 0, 0), 24 * math.pi).data.cycles.max_bounces = 2
    room("room", material("white", Color=(0.8, 0.8, 0.8, 1)), at(0, 0, 0))
    at = made.new("negative")
    lamp("lamp of negative", "POINT", at(0, 0, 0.5), POINT / 4)
    square("sink", 1, glowing("sink", Strength=-0.5), at(0, 0, 1), down=True)
    at = made.new("ray")
    seen = glowing("seen")
    other = add_input(seen, "Math", 0, "Strength", operation="MULTIPLY_ADD")
    other.inputs[1].default_value, other.inputs[2].default_value = 4, 1
    seen.node_tree.links.new(seen.node_tree.nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], other.inputs[0])
    square("seen", 1, seen, at(0, 0, 1), down=True)
    at = made.new("property")
    asked = glowing("asked")
    add_input(asked, "Attribute", "Fac", "Strength", attribute_type="OBJECT", attribute_name="glow")
    square("asked", 1, asked, at(0, 0, 1), down=True)["glow"] = 0.25
    at = made.new("portal")
    lamp("lamp of portal", "AREA", at(0, 0, 1), 10).data.cycles.is_portal = True
    lamp("hidden lamp", "AREA", at(0, 0, 1), 10).visible_diffuse = False
    lamp("other lamp of portal", "POINT", at(0, 0, 1), POINT)
    tint = glowing("tint")
    add_input(tint, "Attribute", "Color", "Color", attribute_type="INSTANCER", attribute_name="tint")
    random = glowing("random")
    add_input(random, "ObjectInfo", "Random", "Strength")
    for name, shown in (("instance", tint), ("random", random)):
        at = made.new(name)
        panel = square("panel of " + name, 1, shown, (0, 0, -90), down=True)
        panel.hide_render = True
        instance(panel, at(0, 0, 1))
    at = made.new("random object")
    square("panel of random object", 1, random, at(0, 0, 1), down=True)


def instance(panel, place):
    """Of a panel, at a place, with the attribute `tint`."""
    host = mesh_object("host of " + panel.name, [(0, 0, -99), (1e-3, 0, -99), (0, 1e-3, -99)], [(0, 1, 2)],
                       bpy.data.materials["black"], (0, 0, 0))
    group = bpy.data.node_groups.new("instances", "GeometryNodeTree")
    if hasattr(group, "interface"):
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes = group.nodes
    line, instances, info, store, out = (nodes.new(kind) for kind in (
        "GeometryNodeMeshLine", "GeometryNodeInstanceOnPoints", "GeometryNodeObjectInfo",
        "GeometryNodeStoreNamedAttribute", "NodeGroupOutput"))
    line.inputs["Count"].default_value, line.inputs["Start Location"].default_value = 1, place
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = panel, True
    store.data_type, store.domain, store.inputs["Name"].default_value = "FLOAT_COLOR", "INSTANCE", "tint"
    next(one for one in store.inputs if one.enabled and one.name == "Value").default_value = (0.9, 0.1, 0.3, 1)
    for one, other in ((line.outputs[0], instances.inputs["Points"]),
                       (info.outputs["Geometry"], instances.inputs["Instance"]),
                       (instances.outputs[0], store.inputs["Geometry"]), (store.outputs[0], out.inputs[0])):
        group.links.new(one, other)
    host.modifiers.new("instances", "NODES").node_group = group


def nosky():
    """A view layer without Environment: the sun alone."""
    new_world((1, 1, 1), 5)
    square("floor", 1, material("grey", Color=(0.5, 0.5, 0.5, 1)), (0, 0, 0))
    lamp("sun", "SUN", (0, 0, 5), math.pi, angle=0)
    bpy.context.view_layer.use_sky = False


def sets():
    """The sun and a roof over half of the sky come from a background set."""
    own = bpy.context.scene
    new_world((1, 1, 1), 1)
    square("floor", 0.01, material("black", Color=(0, 0, 0, 1)), (0, 0, 0))
    other = bpy.data.scenes.new("set")
    for ob in (lamp("sun", "SUN", (0, 0, 5), math.pi, angle=0),
               mesh_object("wall", [(0, -50, 0), (0, 50, 0), (0, 50, 100), (0, -50, 100)], [(0, 1, 2, 3)],
                           bpy.data.materials["black"], (0.02, 0, 0))):
        own.collection.objects.unlink(ob)
        other.collection.objects.link(ob)
    own.background_set = other


def judged():
    """A furnace of albedo 0.9, which any limit of bounces darkens, and a lamp with nodes, which no tracer follows."""
    new_world()
    white = material("white", Color=(0.9, 0.9, 0.9, 1))
    tree = white.node_tree
    shaders = [next(node for node in tree.nodes if node.type == "BSDF_DIFFUSE"), tree.nodes.new("ShaderNodeEmission"),
               tree.nodes.new("ShaderNodeAddShader")]
    shaders[1].inputs["Strength"].default_value = 0.1
    for place, shader in enumerate(shaders[:2]):
        tree.links.new(shader.outputs[0], shaders[2].inputs[place])
    tree.links.new(shaders[2].outputs[0], next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL").inputs[0])
    room("room", white, (0, 0, 0))
    square("floor", 0.5, material("black", Color=(0, 0, 0, 1)), (APART, 0, 0))
    tree = new_tree(lamp("lamp", "POINT", (APART, 0, 1), POINT).data)
    falloff, emission = tree.nodes.new("ShaderNodeLightFalloff"), tree.nodes.new("ShaderNodeEmission")
    tree.links.new(falloff.outputs["Linear"], emission.inputs["Strength"])
    tree.links.new(emission.outputs[0], tree.nodes.new("ShaderNodeOutputLight").inputs["Surface"])


def main(folder):
    for build in (cells, nosky, sets, judged):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.context.scene.render.engine = "CYCLES"
        build()
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, build.__name__ + ".blend"))


main(sys.argv[sys.argv.index("--") + 1])
