"""Receivers: invisible white Lambertian copies whose corner normals are basis directions.

The driver computed every position, normal and UV (src/bake/receiver.cpp); here they only become a mesh.
Each corner has a vertex of its own, so that no normal is shared.
"""
from array import array

import bpy

from core.arrays import read_floats
from scene_ops import light_linking
from scene_ops.plain_material import new_diffuse


def build_mesh(name, stream, parts):
    """Read positions, normals, UVs (3 + 3 + 2 floats for each corner) from `stream` and build the mesh. `parts`: pairs
    of the number of corners that follow each other and whether they belong to it."""
    positions, normals, uvs = (_read_parts(stream, floats, parts) for floats in (3, 3, 2))
    corners = len(positions) // 3
    triangles = corners // 3

    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(corners)
    mesh.loops.add(corners)
    mesh.polygons.add(triangles)
    mesh.vertices.foreach_set("co", positions)
    mesh.loops.foreach_set("vertex_index", array("i", range(corners)))
    mesh.polygons.foreach_set("loop_start", array("i", range(0, corners, 3)))
    if bpy.app.version < (4, 0):
        mesh.polygons.foreach_set("loop_total", array("i", [3]) * triangles)
    mesh.polygons.foreach_set("use_smooth", array("b", [1]) * triangles)
    mesh.uv_layers.new(name="Lightmap")
    mesh.uv_layers[0].data.foreach_set("uv", uvs)
    mesh.update()
    _set_normals(mesh, normals)
    return mesh


def _read_parts(stream, floats, parts):
    everything = read_floats(stream, floats * sum(corners for corners, _ in parts))
    if all(wanted for _, wanted in parts):
        return everything
    kept, first = array("f"), 0
    for corners, wanted in parts:
        if wanted:
            kept += everything[first:first + floats * corners]
        first += floats * corners
    return kept


def _set_normals(mesh, normals):
    """Before 4.5 Blender keeps them as angles of 16 bits, and turns one whose azimuth lies within 0.81 degrees of the
    corner's outgoing edge into that edge's; from then on it can take them as they are."""
    if bpy.app.version >= (4, 5):
        mesh.attributes.new("custom_normal", "FLOAT_VECTOR", "CORNER").data.foreach_set("vector", normals)
        mesh.update()
        return
    if hasattr(mesh, "use_auto_smooth"):  # <= 4.0: custom normals count only with it
        mesh.use_auto_smooth = True
    xyz = iter(normals)
    mesh.normals_split_custom_set_from_vertices(list(zip(xyz, xyz, xyz)))


def make_material(image):
    """Pure white; `image` is what the bake writes to."""
    material = new_diffuse("rnmbake receiver", (1, 1, 1))
    nodes = material.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    nodes.active = texture
    return material


def make_receiver(scene, mesh, material, light_group=""):
    """Link an object that the camera (and so the bake) sees and no other ray does, and a twin beside it.

    `light_group`: of what it stands for, where lights choose what they light (scene_ops/light_linking.py).
    """
    receiver = _camera_only(scene, mesh)
    twin = _camera_only(scene, mesh)  # a mesh with two users keeps a BVH of its own, which other rays pass by as a whole
    mesh.materials.append(material)
    _no_terminator_offset(receiver)
    light_linking.join_group(receiver, light_group)
    return receiver, twin


def take_away(pair):
    """The receiver and its twin, so that the next bake goes without them; their mesh stays."""
    for ob in pair:
        bpy.data.objects.remove(ob)


def _camera_only(scene, mesh):
    ob = bpy.data.objects.new(mesh.name, mesh)
    scene.collection.objects.link(ob)
    ob.visible_camera = True  # all off: silently not exported
    for ray in ("diffuse", "glossy", "transmission", "volume_scatter", "shadow"):
        setattr(ob, "visible_" + ray, False)
    return ob


def _no_terminator_offset(ob):
    """The properties moved from ob.cycles to ob in 5.0; the old ones then exist and do nothing."""
    for name in ("shadow_terminator_geometry_offset", "shadow_terminator_offset",
                 "shadow_terminator_shading_offset"):
        for owner in (ob, ob.cycles):
            if hasattr(owner, name):
                setattr(owner, name, 0)
