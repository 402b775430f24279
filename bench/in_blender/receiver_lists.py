"""Prepares receivers the way that is written first: Python lists, a tuple for each corner and basis.

For comparison only; rnmbake does it with arrays and in C++.

    blender -b SCENE.blend --python receiver_lists.py -- ANSWER.json
"""
import json
import math
import sys
import time

import bmesh
import bpy
from mathutils import Vector

BASES = [Vector((0, 0, 1)), Vector((math.sqrt(2 / 3), 0, 1 / math.sqrt(3))),
         Vector((-1 / math.sqrt(6), 1 / math.sqrt(2), 1 / math.sqrt(3))),
         Vector((-1 / math.sqrt(6), -1 / math.sqrt(2), 1 / math.sqrt(3)))]


def evaluated_meshes():
    """Triangulated copies in world space, with tangents."""
    graph = bpy.context.evaluated_depsgraph_get()
    for ob in list(bpy.context.scene.objects):
        if ob.type != "MESH" or ob.hide_render or not ob.data.polygons:
            continue
        mesh = bpy.data.meshes.new_from_object(ob.evaluated_get(graph))
        edit = bmesh.new()
        edit.from_mesh(mesh)
        bmesh.ops.triangulate(edit, faces=edit.faces)
        edit.to_mesh(mesh)
        edit.free()
        if not mesh.uv_layers:
            mesh.uv_layers.new(name="Lightmap")
        mesh.transform(ob.matrix_world)
        mesh.calc_tangents()
        yield mesh


def corners_of(mesh, lists):
    """Appends position, normal and UV of each corner for each basis."""
    positions, normals, uvs = lists
    layer = mesh.uv_layers[0].data
    for basis in BASES:
        for polygon in mesh.polygons:
            for index in polygon.loop_indices:
                loop = mesh.loops[index]
                normal = loop.tangent * basis.x + loop.bitangent * basis.y + loop.normal * basis.z
                positions.append(mesh.vertices[loop.vertex_index].co + polygon.normal * 1e-5)
                normals.append(normal.normalized())
                uvs.append(layer[index].uv.copy())


def build(lists):
    """One mesh of unshared corners; yields the name of each step when it is done."""
    positions, normals, uvs = lists
    mesh = bpy.data.meshes.new("receiver")
    mesh.from_pydata(positions, [], [(i, i + 1, i + 2) for i in range(0, len(positions), 3)])
    mesh.uv_layers.new(name="Lightmap")
    layer = mesh.uv_layers[0].data
    for index, uv in enumerate(uvs):
        layer[index].uv = uv
    yield "build"
    for polygon in mesh.polygons:
        polygon.use_smooth = True
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(normals)
    yield "normals"


def main(answer):
    clock, steps, lists = time.process_time(), {}, ([], [], [])

    def lap(name):
        nonlocal clock
        now = time.process_time()
        steps[name] = steps.get(name, 0) + now - clock
        clock = now

    for mesh in evaluated_meshes():
        lap("read")
        corners_of(mesh, lists)
        lap("directions")
    for name in build(lists):
        lap(name)
    with open(answer, "w", encoding="utf-8") as stream:
        json.dump({"steps": steps, "triangles": len(lists[0]) // 3}, stream)


main(sys.argv[-1])
