"""blender -b --factory-startup --python survey_cases.py -- OUT.blend: one scene with everything that a survey meets."""
import sys

import bpy


def link(ob, collection=None):
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def cube_mesh(name):
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    mesh.uv_layers.new(name="UVMap")
    return mesh


def cube(name, mesh=None, collection=None, location=(0, 0, 0)):
    ob = bpy.data.objects.new(name, mesh or cube_mesh(name))
    ob.location = location
    return link(ob, collection)


def curve_object(name, kind, bevel):
    curve = bpy.data.curves.new(name, kind)
    curve.dimensions = "3D"
    curve.bevel_depth = bevel
    spline = curve.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co, spline.points[1].co = (0, 0, 0, 1), (1, 0, 0, 1)
    return link(bpy.data.objects.new(name, curve))


def text_metaballs_surface():
    text = bpy.data.curves.new("text", "FONT")
    text.body = "A"
    link(bpy.data.objects.new("text", text))
    for number in range(2):  # one family: the first draws for both
        ball = bpy.data.metaballs.new("ball")
        ball.elements.new()
        name = "ball" if number == 0 else "ball.001"
        link(bpy.data.objects.new(name, ball)).location = (5 + number, 0, 0)
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.context.object.name = "surface"


def modifiers():
    array = cube("array")
    modifier = array.modifiers.new("Array", "ARRAY")
    modifier.count = 3
    viewport_only = cube("viewport_only")
    modifier = viewport_only.modifiers.new("Mirror", "MIRROR")
    modifier.show_render, modifier.show_viewport = False, True
    render_only = cube("render_only")
    modifier = render_only.modifiers.new("Mirror", "MIRROR")
    modifier.show_render, modifier.show_viewport = True, False
    levels = cube("levels")
    modifier = levels.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels, modifier.render_levels = 0, 2


def visibility():
    hidden = bpy.data.collections.new("hidden")
    hidden.hide_render = True
    bpy.context.scene.collection.children.link(hidden)
    cube("in_hidden_collection", collection=hidden)
    viewport = bpy.data.collections.new("hidden in viewport")
    viewport.hide_viewport = True
    bpy.context.scene.collection.children.link(viewport)
    cube("in_viewport_hidden_collection", collection=viewport)
    cube("hidden_for_render").hide_render = True
    cube("hidden_in_viewport").hide_viewport = True
    cube("eye_closed").hide_set(True)
    cube("not_for_camera").visible_camera = False
    excluded = bpy.data.collections.new("excluded")
    bpy.context.scene.collection.children.link(excluded)
    cube("in_excluded_collection", collection=excluded)
    bpy.context.view_layer.layer_collection.children["excluded"].exclude = True


def instances():
    library = bpy.data.collections.new("library")  # not in the scene: seen only through instances
    cube("part_a", collection=library)
    cube("part_b", collection=library, location=(0, 3, 0))
    text = bpy.data.curves.new("part_text", "FONT")
    text.body = "A"
    link(bpy.data.objects.new("part_text", text), library)
    for number in range(2):
        empty = bpy.data.objects.new(f"instancer_{number}", None)
        empty.instance_type, empty.instance_collection = "COLLECTION", library
        empty.location = (10 * (number + 1), 0, 0)
        link(empty)


def group_with_geometry(name):
    group = bpy.data.node_groups.new(name, "GeometryNodeTree")
    if hasattr(group, "interface"):
        group.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
        group.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    return group, group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")


def geometry_nodes():
    """A cube at every corner of a plane, and the plane itself."""
    group, begin, end = group_with_geometry("scatter")
    nodes, links = group.nodes, group.links
    inner, scatter, join = (nodes.new(kind) for kind in (
        "GeometryNodeMeshCube", "GeometryNodeInstanceOnPoints", "GeometryNodeJoinGeometry"))
    links.new(begin.outputs[0], scatter.inputs["Points"])
    links.new(inner.outputs["Mesh"], scatter.inputs["Instance"])
    links.new(begin.outputs[0], join.inputs[0])
    links.new(scatter.outputs[0], join.inputs[0])
    links.new(join.outputs[0], end.inputs[0])
    mesh = bpy.data.meshes.new("scatter")
    mesh.from_pydata([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)], [], [(0, 1, 2, 3)])
    link(bpy.data.objects.new("scatter", mesh)).modifiers.new("Nodes", "NODES").node_group = group


def transforms():
    shared = cube_mesh("shared")
    cube("shared_1", shared)
    cube("shared_2", shared, location=(3, 0, 0))
    cube("mirrored", shared).scale = (-1, 2, 3)
    parent = bpy.data.objects.new("parent", None)
    parent.location, parent.scale = (0, 0, 7), (2, 2, 2)
    child = cube("child", shared, location=(1, 0, 0))
    child.parent = link(parent)
    keyed = cube("shape_keys")
    keyed.shape_key_add(name="Basis")
    key = keyed.shape_key_add(name="Tall")
    key.data[7].co.z = 9
    key.value = 1


def materials():
    red, white = bpy.data.materials.new("red"), bpy.data.materials.new("white")
    ob = cube("slots")
    for material in (red, None, white):
        ob.data.materials.append(material)
    ob.data.polygons[0].material_index = 2
    ob.data.polygons[1].material_index = 1
    linked_to_object = cube("object_slot")
    linked_to_object.data.materials.append(red)
    linked_to_object.material_slots[0].link = "OBJECT"
    linked_to_object.material_slots[0].material = white


def names_and_oddities():
    for name in ("../../x", "a/b", "Säule 柱", "n" * 63):
        cube(name)
    link(bpy.data.objects.new("no_faces", bpy.data.meshes.new("no_faces")))
    custom = cube("second_layer")
    custom.data.uv_layers.new(name="Lightmap")
    custom.data.uv_layers["Lightmap"].active = True


def lights():
    for kind in ("POINT", "SUN", "SPOT", "AREA"):
        light = bpy.data.lights.new(kind, kind)
        light.energy, light.color = 12.5, (1, 0.5, 0.25)
        link(bpy.data.objects.new(kind.lower(), light)).location = (0, 0, 20)


def main(path):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for build in (text_metaballs_surface, modifiers, visibility, instances, geometry_nodes, transforms, materials,
                  names_and_oddities, lights):
        build()
    curve_object("tube", "CURVE", 0.1)
    curve_object("path_without_faces", "CURVE", 0)
    edited = cube("edit_mode")
    bpy.context.view_layer.objects.active = edited
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.wm.save_as_mainfile(filepath=path)


main(sys.argv[sys.argv.index("--") + 1])
