"""blender -b --factory-startup --python content_cases.py -- FOLDER: content.blend, with what real scenes are made of.

Everything stands a few units apart under a white sky, so that each object's light is its own, and every
material is a plain diffuse one, so that all recipes agree on the flat lightmap.
"""
import itertools
import os
import sys

import bpy

PLACES = ((6.0 * x, 6.0 * y, 0.0) for y, x in itertools.product(range(10), range(6)))


def link(ob, collection=None):
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def place(ob):
    ob.location = next(PLACES)
    return ob


def cube_mesh(name, size=1.0, lightmap=True):
    """Six charts in a 3 x 2 grid, with gaps; the first layer maps each face to the whole square."""
    corners = [(x * size, y * size, z * size) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", [v for _ in faces for uv in square for v in uv])
    if lightmap:
        charts = [((face % 3 + 0.06 + 0.88 * u) / 3, (face // 3 + 0.06 + 0.88 * v) / 2)
                  for face in range(6) for u, v in square]
        mesh.uv_layers.new(name="Lightmap").data.foreach_set("uv", [v for uv in charts for v in uv])
    return mesh


def cube(name, mesh=None, collection=None):
    return link(place(bpy.data.objects.new(name, mesh or cube_mesh(name))), collection)


def diffuse(name, color, use_nodes=True):
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*color, 1)
    material.use_nodes = use_nodes
    if not use_nodes:
        return material
    nodes = material.node_tree.nodes
    nodes.clear()
    shader, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*color, 1)
    material.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def transforms():
    shared = cube_mesh("shared")
    cube("shared_1", shared)
    cube("shared_2", shared).rotation_euler = (0.4, 0.2, 1)
    cube("mirrored", shared).scale = (-1, 0.5, 1.5)
    parent = link(place(bpy.data.objects.new("parent", None)))
    parent.scale, parent.rotation_euler = (1, -1, 0.7), (0, 0, 0.5)
    child = link(bpy.data.objects.new("child", shared))
    child.parent, child.location = parent, (0.5, 0, 0)


def modifiers():
    cube("array", cube_mesh("array", 0.4)).modifiers.new("Array", "ARRAY").count = 3
    smooth = cube("subdivided")
    modifier = smooth.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 2
    cube("no_uv_bevel", cube_mesh("bevel", lightmap=False)).modifiers.new("Bevel", "BEVEL").width = 0.2
    keyed = cube("shape_keys")
    keyed.shape_key_add(name="Basis")
    key = keyed.shape_key_add(name="Tall")
    for top in (1, 3, 5, 7):  # all four: polygons stay flat
        key.data[top].co.z = 1.8
    key.value = 1
    keyed_bare = cube("shape_keys_bare", cube_mesh("shape_keys_bare", lightmap=False))
    keyed_bare.shape_key_add(name="Basis")
    keyed_bare.shape_key_add(name="Tall").value = 1


def materials():
    red, grey = diffuse("red", (0.8, 0.1, 0.1)), diffuse("grey", (0.5, 0.5, 0.5))
    several = cube("several_slots")
    for number, material in enumerate((red, None, grey, None)):
        several.data.materials.append(material)
        several.data.polygons[number].material_index = min(number, 2)
    on_object = cube("object_slot")
    on_object.data.materials.append(red)
    on_object.material_slots[0].link = "OBJECT"
    on_object.material_slots[0].material = grey
    cube("without_nodes").data.materials.append(diffuse("plain", (0.3, 0.6, 0.3), use_nodes=False))
    cube("empty_slot").data.materials.append(None)
    two = cube_mesh("two", 0.6)
    two.materials.append(red)
    two.materials.append(grey)
    two.polygons.foreach_set("material_index", [0, 0, 0, 1, 1, 1])
    for number in (1, 2):
        cube(f"two_slots_{number}", two)


def visibility():
    for name, attribute in (("not_in_render", "hide_render"), ("not_in_viewport", "hide_viewport")):
        setattr(cube(name), attribute, True)
        collection = bpy.data.collections.new(name)
        bpy.context.scene.collection.children.link(collection)
        cube("collection_" + name, collection=collection)
        setattr(collection, attribute, True)
    cube("eye_closed").hide_set(True)
    cube("not_selectable").hide_select = True


def instances():
    library = bpy.data.collections.new("library")  # not in the scene: seen only through instances
    for number in range(2):
        ob = link(bpy.data.objects.new(f"part_{number}", cube_mesh(f"part_{number}", 0.5)), library)
        ob.location = (2.0 * number, 0, 0)
    for number in range(2):
        empty = bpy.data.objects.new(f"instancer_{number}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", library
        link(place(empty))


def geometry_nodes():
    """A small cube at every corner of a square, and the square itself."""
    group = bpy.data.node_groups.new("scatter", "GeometryNodeTree")
    if hasattr(group, "interface"):
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    begin, end, inner, scatter, join = (group.nodes.new(kind) for kind in (
        "NodeGroupInput", "NodeGroupOutput", "GeometryNodeMeshCube", "GeometryNodeInstanceOnPoints",
        "GeometryNodeJoinGeometry"))
    inner.inputs["Size"].default_value = (0.5, 0.5, 0.5)
    for source, sink in ((begin.outputs[0], scatter.inputs["Points"]), (inner.outputs["Mesh"], scatter.inputs["Instance"]),
                         (begin.outputs[0], join.inputs[0]), (scatter.outputs[0], join.inputs[0]),
                         (join.outputs[0], end.inputs[0])):
        group.links.new(source, sink)
    mesh = bpy.data.meshes.new("scatter")
    mesh.from_pydata([(0, 0, 0), (3, 0, 0), (3, 3, 0), (0, 3, 0)], [], [(0, 1, 2, 3)])
    ob = link(place(bpy.data.objects.new("scatter", mesh)))
    ob.modifiers.new("Nodes", "NODES").node_group = group


def curves():
    curve = bpy.data.curves.new("tube", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.4
    spline = curve.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co, spline.points[1].co = (0, 0, 0, 1), (2, 0, 1, 1)
    link(place(bpy.data.objects.new("tube", curve)))
    text = bpy.data.curves.new("text", "FONT")
    text.body, text.extrude, text.size = "L", 0.3, 3
    link(place(bpy.data.objects.new("text", text)))


def loose_parts():
    mesh = bpy.data.meshes.new("pieces")
    square = [(0, 0), (1, 0), (1, 1), (0, 1)]
    mesh.from_pydata([(x + 2 * n, y, 0.5 * n) for n in range(3) for x, y in square], [],
                     [tuple(range(4 * n, 4 * n + 4)) for n in range(3)])
    uvs = [((n + 0.05 + 0.9 * x) / 3, y) for n in range(3) for x, y in square]
    mesh.uv_layers.new(name="Lightmap").data.foreach_set("uv", [v for uv in uvs for v in uv])
    link(place(bpy.data.objects.new("pieces", mesh)))


def libraries(folder):
    """library.blend, of which an object, a mesh and a collection instance are linked."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    collection = bpy.data.collections.new("linked_collection")
    bpy.context.scene.collection.children.link(collection)
    link(bpy.data.objects.new("linked_part", cube_mesh("linked_part", 0.7)), collection)
    ob = link(bpy.data.objects.new("linked_object", cube_mesh("linked_object")))
    ob.location = (-8, 0, 0)
    link(bpy.data.objects.new("mesh_holder", cube_mesh("linked_mesh")))
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "library.blend"))


def linked(folder):
    with bpy.data.libraries.load(os.path.join(folder, "library.blend"), link=True) as (_, wanted):
        wanted.objects, wanted.meshes = ["linked_object"], ["linked_mesh"]
        wanted.collections = ["linked_collection"]
    link(bpy.data.objects["linked_object"])
    cube("local_with_linked_mesh", bpy.data.meshes["linked_mesh"])
    empty = bpy.data.objects.new("linked_instancer", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", bpy.data.collections["linked_collection"]
    link(place(empty))


def white_sky():
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    nodes = world.node_tree.nodes
    nodes.clear()
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    background.inputs["Color"].default_value = (1, 1, 1, 1)
    world.node_tree.links.new(background.outputs[0], output.inputs["Surface"])
    bpy.context.scene.world = world


def edit_mode():
    """Last: the file is saved in this mode."""
    edited = cube("edit_mode")
    bpy.context.view_layer.objects.active = edited
    bpy.ops.object.mode_set(mode="EDIT")


def main(folder):
    libraries(folder)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    white_sky()
    for build in (transforms, modifiers, materials, visibility, instances, geometry_nodes, curves, loose_parts):
        build()
    linked(folder)
    edit_mode()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "content.blend"), relative_remap=False)


main(sys.argv[sys.argv.index("--") + 1])
