"""Unwrap meshes for lightmaps. Needs no scene: the driver hands over polygons and positions in world scale.

Request: "meshes": [{"vertices", "loops", "polygons", "margin" (share of the square), "label"}], and beside
it unwrap.bin with positions (float32 x 3), loop_vertex, polygon_start, polygon_size (int32) of each in turn.
Answers with unwrapped.f32: two floats for each loop, mesh after mesh.
"""
import math
import os
import sys
from array import array

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from scene_ops.receivers import read_floats  # noqa: E402

LEAST_AREA = 0.2  # of the square
LEAST_MARGIN = 1e-3


def main(task):
    meshes = task.request["meshes"]
    with open(task.path("unwrap.bin"), "rb") as source, open(task.path("unwrapped.f32"), "wb") as out:
        for number, entry in enumerate(meshes):
            task.progress("unwrap", entry["label"], number, len(meshes))
            ob = make_object(entry, source)
            unwrap_usefully(ob, entry["margin"]).tofile(out)
            bpy.data.meshes.remove(ob.data)
    return {"file": "unwrapped.f32"}


def read_ints(stream, count):
    values = array("i")
    values.fromfile(stream, count)
    return values


def make_object(entry, source):
    mesh = bpy.data.meshes.new("unwrap")
    mesh.vertices.add(entry["vertices"])
    mesh.loops.add(entry["loops"])
    mesh.polygons.add(entry["polygons"])
    mesh.vertices.foreach_set("co", read_floats(source, 3 * entry["vertices"]))
    mesh.loops.foreach_set("vertex_index", read_ints(source, entry["loops"]))
    mesh.polygons.foreach_set("loop_start", read_ints(source, entry["polygons"]))
    sizes = read_ints(source, entry["polygons"])
    if bpy.app.version < (4, 0):
        mesh.polygons.foreach_set("loop_total", sizes)
    mesh.update(calc_edges=True)
    mesh.uv_layers.new(name="Lightmap")
    ob = bpy.data.objects.new("unwrap", mesh)
    bpy.context.scene.collection.objects.link(ob)
    return ob


def unwrap_usefully(ob, margin):
    """UVs of all corners. Many charts with a wide margin between them shrink to nothing: then it is narrowed."""
    while True:
        unwrap(ob, margin)
        uvs = array("f", bytes(8 * len(ob.data.loops)))
        ob.data.uv_layers.active.data.foreach_get("uv", uvs)
        if margin < LEAST_MARGIN or area(uvs, ob.data) > LEAST_AREA:
            return uvs
        margin /= 4


def area(uvs, mesh):
    """Share of the square that the polygons fill."""
    total = 0
    for polygon in mesh.polygons:
        first, size = 2 * polygon.loop_start, 2 * polygon.loop_total
        x, y = uvs[first:first + size:2], uvs[first + 1:first + size:2]
        total += abs(sum(x[k - 1] * y[k] - x[k] * y[k - 1] for k in range(len(x)))) / 2
    return total


def unwrap(ob, margin):
    """Smart UV Project: charts by face direction, no overlaps, packed with a margin between charts."""
    for other in bpy.context.view_layer.objects:
        other.select_set(False)
    ob.select_set(True)
    bpy.context.view_layer.objects.active = ob
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    options = {"angle_limit": math.radians(66), "island_margin": margin, "scale_to_bounds": False}
    if "margin_method" in bpy.ops.uv.smart_project.get_rna_type().properties:  # >= 3.6: margins as asked for
        options["margin_method"] = "FRACTION"
    bpy.ops.uv.smart_project(**options)
    bpy.ops.object.mode_set(mode="OBJECT")


core_task.run(main)
