"""blender -b --factory-startup --python tangent_cases.py -- OUT.blend OUT.json: meshes and Blender's own tangents."""
import json
import sys

import bpy


def triangulated(ob, name, smooth=True, levels=0):
    """Apply a subdivision and cut into triangles, so that the mesh has no choice left to make."""
    ob.name = name
    if levels:
        modifier = ob.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = levels
    triangulate = ob.modifiers.new("Triangulate", "TRIANGULATE")
    triangulate.quad_method = "FIXED"
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(ob.evaluated_get(graph), preserve_all_data_layers=True, depsgraph=graph)
    ob.modifiers.clear()
    ob.data = mesh
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    mesh.update()
    return ob


def active():
    return bpy.context.view_layer.objects.active


def mirror_uvs(ob):
    """The half of the faces at x < 0 shows the picture mirrored."""
    uv = ob.data.uv_layers.active.data
    for polygon in ob.data.polygons:
        if polygon.center.x < 0:
            for loop in polygon.loop_indices:
                uv[loop].uv.x = 1 - uv[loop].uv.x


def tangents_of(mesh):
    mesh.calc_tangents(uvmap=mesh.uv_layers.active.name)
    return [[*loop.tangent, loop.bitangent_sign] for loop in mesh.loops]


def main(blend, tangents):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_monkey_add()
    triangulated(active(), "suzanne", levels=1)
    bpy.ops.mesh.primitive_uv_sphere_add()
    triangulated(active(), "sphere")
    bpy.ops.mesh.primitive_uv_sphere_add()
    mirror_uvs(triangulated(active(), "sphere_mirrored"))
    bpy.ops.mesh.primitive_cone_add()
    triangulated(active(), "cone_flat", smooth=False)
    bpy.ops.mesh.primitive_torus_add(generate_uvs=True)
    triangulated(active(), "torus").rotation_euler = (0.3, 1.1, 2.0)
    bpy.context.view_layer.update()
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    with open(tangents, "w", encoding="utf-8") as stream:
        json.dump({ob.name: tangents_of(ob.data) for ob in bpy.context.scene.objects}, stream)


main(*sys.argv[sys.argv.index("--") + 1:])
