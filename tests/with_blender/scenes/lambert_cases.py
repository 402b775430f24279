"""blender -b --factory-startup --python lambert_cases.py -- FOLDER: room.blend and materials.blend for --materials lambert."""
import os
import sys

import bpy

WHITE = (0.8, 0.8, 0.8, 1)


def material(name, build):
    """`build(tree)` returns the output socket that goes to the surface."""
    made = bpy.data.materials.new(name)
    if not made.use_nodes:
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    tree.links.new(build(tree), tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    return made


def shader(kind, **inputs):
    def build(tree):
        node = tree.nodes.new("ShaderNode" + kind)
        for name, value in inputs.items():
            names = {"Emission": ("Emission Color", "Emission"), "Transmission": ("Transmission Weight", "Transmission"),
                     "BaseColor": ("Base Color",), "EmissionStrength": ("Emission Strength",)}.get(name, (name,))
            socket = next(node.inputs[name] for name in names if name in node.inputs)
            if callable(value):
                tree.links.new(value(tree), socket)
            else:
                socket.default_value = value
        return node.outputs[0]
    return build


def checker(one, other, scale):
    """Squares in UV space."""
    def build(tree):
        node = tree.nodes.new("ShaderNodeTexChecker")
        for name, value in (("Color1", one), ("Color2", other), ("Scale", scale)):
            node.inputs[name].default_value = value
        tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["UV"], node.inputs["Vector"])
        return node.outputs["Color"]
    return build


def mix(share, one, other):
    def build(tree):
        node = tree.nodes.new("ShaderNodeMixShader")
        node.inputs[0].default_value = share
        tree.links.new(one(tree), node.inputs[1])
        tree.links.new(other(tree), node.inputs[2])
        return node.outputs[0]
    return build


def add(one, other):
    def build(tree):
        node = tree.nodes.new("ShaderNodeAddShader")
        tree.links.new(one(tree), node.inputs[0])
        tree.links.new(other(tree), node.inputs[1])
        return node.outputs[0]
    return build


def grouped(inner):
    """In a node group, behind a reroute."""
    def build(tree):
        group = bpy.data.node_groups.new("group", "ShaderNodeTree")
        if hasattr(group, "interface"):
            group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
        else:
            group.outputs.new("NodeSocketShader", "Shader")
        reroute = group.nodes.new("NodeReroute")
        group.links.new(inner(group), reroute.inputs[0])
        group.links.new(reroute.outputs[0], group.nodes.new("NodeGroupOutput").inputs[0])
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        return node.outputs[0]
    return build


def by_ray(one, other):
    """`other` for shadow rays."""
    def build(tree):
        mixed = mix(0.5, one, other)(tree)
        tree.links.new(tree.nodes.new("ShaderNodeLightPath").outputs["Is Shadow Ray"], mixed.node.inputs[0])
        return mixed
    return build


def quad(name, corners, *materials, collection=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", (0, 0, 1, 0, 1, 1, 0, 1))
    for entry in materials:
        mesh.materials.append(entry)
    ob = bpy.data.objects.new(name, mesh)
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def room(path):
    """A floor that sees a checkered wall, a textured lamp, a slot linked to its object, and instances."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    white = material("white", shader("BsdfDiffuse", Color=WHITE))
    red = material("red", shader("BsdfDiffuse", Color=(0.9, 0.1, 0.1, 1)))
    wall = material("wall", shader("BsdfDiffuse", Color=checker((0.9, 0.8, 0.1, 1), (0.1, 0.2, 0.9, 1), 3)))
    lamp = material("lamp", shader("Emission", Strength=8.0, Color=checker((1, 0.1, 0, 1), (0, 0.3, 1, 1), 2)))
    quad("floor", [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)], white)
    quad("wall", [(-2, 2, 0), (2, 2, 0), (2, 2, 3), (-2, 2, 3)], wall)
    quad("lamp", [(-1.5, 1, 3), (1.5, 1, 3), (1.5, -1, 3), (-1.5, -1, 3)], lamp)
    side = quad("side", [(-2, -2, 0), (-2, 2, 0), (-2, 2, 3), (-2, -2, 3)], white)
    side.material_slots[0].link = "OBJECT"
    side.material_slots[0].material = red
    library = bpy.data.collections.new("library")
    quad("panel", [(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)], wall, collection=library).rotation_euler.z = 3.14159265
    for number in range(2):
        empty = bpy.data.objects.new(f"place_{number}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", library
        empty.location, empty.scale = (1.9, 1.5 * number, 0), (1, 1, 1 + number)
        bpy.context.scene.collection.objects.link(empty)
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy, sun.rotation_euler = 2, (0.9, 0, 0.2)
    bpy.context.scene.collection.objects.link(sun)
    bpy.ops.wm.save_as_mainfile(filepath=path)


def materials(path):
    """One quad for each material; lambert_check.py bakes them one by one and compares."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    base = (0.8, 0.4, 0.2, 1)
    cases = {
        "diffuse": shader("BsdfDiffuse", Color=base),
        "rough_diffuse": shader("BsdfDiffuse", Color=base, Roughness=1.0),
        "emission": shader("Emission", Color=(1, 0.87, 0.68, 1), Strength=14.0),
        "principled": shader("BsdfPrincipled", BaseColor=base),
        "metallic": shader("BsdfPrincipled", BaseColor=base, Metallic=0.25),
        "transmission": shader("BsdfPrincipled", BaseColor=base, Transmission=0.5),
        "glowing": shader("BsdfPrincipled", BaseColor=base, Emission=(1, 0.5, 0.25, 1), EmissionStrength=7.0),
        "mixed": mix(0.25, shader("BsdfDiffuse", Color=base), shader("Emission", Strength=3.0)),
        "glossy": shader("BsdfGlossy"),
        "glass": shader("BsdfGlass"),
        "half_transparent": mix(0.5, shader("BsdfDiffuse", Color=base), shader("BsdfTransparent")),
        "alpha": shader("BsdfPrincipled", BaseColor=base, Alpha=0.25),
        "tinted": grouped(add(mix(0.75, shader("BsdfDiffuse", Color=base), shader("BsdfTransparent", Color=(1, 0.5, 0, 1))),
                              shader("Emission", Strength=2.0))),
        "too_much": add(shader("BsdfDiffuse", Color=base), shader("BsdfTransparent", Color=(0.5, 0.5, 0.5, 1))),
        "by_ray": by_ray(shader("BsdfDiffuse", Color=base), shader("BsdfTransparent")),
    }
    for number, (name, build) in enumerate(cases.items()):
        x = 2 * number
        quad(name, [(x, 0, 0), (x + 1, 0, 0), (x + 1, 1, 0), (x, 1, 0)], material(name, build))
    bpy.ops.wm.save_as_mainfile(filepath=path)


folder = sys.argv[sys.argv.index("--") + 1]
room(os.path.join(folder, "room.blend"))
materials(os.path.join(folder, "materials.blend"))
