"""A place of its own for every point of a surface: the scene's lightmap UVs, or an unwrap of our own."""
import math
from array import array

import bmesh
import bpy
from mathutils import Matrix

from core.task import Refusal
from lambert.materials import UV_ATTRIBUTE

LIGHTMAP_NAMES = ("Lightmap", "UV2", "lightmap")  # as src/bake/targets.cpp looks for them
MARGIN = 3  # texels between charts
MANY = 20000  # polygons: Blender's packing with gaps takes minutes then
LITTLE = 0.2  # charts that fill less of the square are mostly gaps


def world_area(mesh, matrix):
    """Square units, polygon by polygon."""
    placed = mesh.copy()
    placed.transform(matrix)
    areas = array("f", bytes(4 * len(placed.polygons)))
    placed.polygons.foreach_get("area", areas)
    bpy.data.meshes.remove(placed)
    return math.fsum(areas)


def own_layer(mesh):
    """The name of a layer that is made for lightmaps and stays inside the unit square, or None."""
    for name in LIGHTMAP_NAMES:
        if name in mesh.uv_layers:
            uv = read_uv(mesh.uv_layers[name])
            return name if uv and min(uv) >= -1e-4 and max(uv) <= 1.0001 and any(uv) else None
    return None


def read_uv(layer):
    uv = array("f", bytes(8 * len(layer.data)))
    layer.data.foreach_get("uv", uv)
    return uv


def unwrap(bench, mesh, matrix, side):
    """UVs of a copy in world scale, so that the mesh itself never enters Edit mode.

    Where there are so many charts that the gaps leave them no room, narrower gaps have to do.
    """
    placed = mesh.copy()
    placed.transform(matrix)
    while placed.uv_layers:
        placed.uv_layers.remove(placed.uv_layers[0])
    placed.uv_layers.new(name="unwrap")
    ob = bpy.data.objects.new("rnmbake unwrap", placed)
    with bench.holding(ob):
        gaps = (MARGIN / side, MARGIN / side / 8, 0)
        for gap in gaps if len(placed.polygons) < MANY else gaps[-1:]:
            smart_project(placed, gap)
            uv = read_uv(placed.uv_layers[0])
            if filled(placed, uv) >= LITTLE:
                break
    bpy.data.objects.remove(ob)
    bpy.data.meshes.remove(placed)
    return uv


def smart_project(mesh, gap):
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.reveal(select=False)
    if select_solid_faces(mesh):
        project(gap)
    bpy.ops.object.mode_set(mode="OBJECT")


def select_solid_faces(mesh):
    """Selects the faces that have a normal; whether there are any. Among others alone 3.4 looks for a direction
    for ever: rounding may give a face of three points on a line an area, but no normal."""
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.mesh.select_all(action="DESELECT")
    edited = bmesh.from_edit_mesh(mesh)
    solid = [face for face in edited.faces if face.normal.length > 0.5]
    for face in solid:
        face.select_set(True)
    bmesh.update_edit_mesh(mesh)
    return bool(solid)


def project(gap):
    options = {"angle_limit": math.radians(66), "island_margin": gap, "scale_to_bounds": False}
    if "margin_method" in bpy.ops.uv.smart_project.get_rna_type().properties:  # >= 3.6
        options["margin_method"] = "FRACTION"
    bpy.ops.uv.smart_project(**options)


def filled(mesh, uv):
    """The share of the unit square that a mesh covers in UV space: the area of a mesh that lies there."""
    loops, polygons = len(mesh.loops), len(mesh.polygons)
    flat = bpy.data.meshes.new("rnmbake flat")
    flat.vertices.add(loops)
    flat.loops.add(loops)
    flat.polygons.add(polygons)
    places = array("f", bytes(12 * loops))
    places[0::3], places[1::3] = uv[0::2], uv[1::2]
    flat.vertices.foreach_set("co", places)
    flat.loops.foreach_set("vertex_index", range(loops))
    for name in ("loop_start", "loop_total") if bpy.app.version < (4, 0) else ("loop_start",):
        values = array("i", bytes(4 * polygons))
        mesh.polygons.foreach_get(name, values)
        flat.polygons.foreach_set(name, values)
    flat.update(calc_edges=True)
    area = world_area(flat, Matrix())
    bpy.data.meshes.remove(flat)
    return area


def mesh_to_bake(mesh, layer, uv):
    """A copy whose active layer is the place to bake to; textures go on reading the active-render one."""
    copy = mesh.copy()
    layers = copy.uv_layers
    if layer:
        layers.active = layers[layer]
        return copy
    if not layers:
        layers.new(name="none", do_init=False)  # what a texture reads where there are no UVs: zero
    target = layers.new(name=UV_ATTRIBUTE, do_init=False)
    if target is None:
        raise Refusal(f"mesh '{mesh.name}': all of its {len(layers)} UV layers are taken and its materials need "
                      "one more to be baked; remove one, or use --materials full")
    target.data.foreach_set("uv", uv)
    layers.active = target
    return copy


def keep_uv(mesh, uv):
    """Store UVs as a plain attribute: another UV layer would be taken for the scene's lightmap UVs."""
    if UV_ATTRIBUTE in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[UV_ATTRIBUTE])
    attribute = mesh.attributes.new(UV_ATTRIBUTE, "FLOAT_VECTOR", "CORNER")
    vectors = array("f", bytes(12 * len(attribute.data)))
    vectors[0::3], vectors[1::3] = uv[0::2], uv[1::2]
    attribute.data.foreach_set("vector", vectors)
