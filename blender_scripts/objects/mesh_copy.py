"""Evaluated meshes as meshes of the file, with the normals and texture space that a plain copy loses."""
from array import array

import bpy

from scene_ops import texture_space


def copy_mesh(ob):
    """Copy the mesh of an evaluated object; in the render depsgraph it keeps all UV layers."""
    mesh = bpy.data.meshes.new_from_object(ob)
    if ob.original.type == "META":  # the field's own
        _keep_normals(mesh, ob.data)
    if ob.original.type != "MESH" or ob.modifiers or ob.original.data.shape_keys:
        _keep_generated(mesh, ob.data)
    return mesh


def _keep_normals(mesh, evaluated):
    if hasattr(mesh, "use_auto_smooth"):  # <= 4.0
        mesh.use_auto_smooth = True
        evaluated.calc_normals_split()
        normals = [tuple(loop.normal) for loop in evaluated.loops]
    else:
        normals = [tuple(corner.vector) for corner in evaluated.corner_normals]
    mesh.normals_split_custom_set(normals)


def _keep_generated(mesh, evaluated):
    """Generated coordinates are those of the shape before modifiers, where Blender knows that: another mesh says it."""
    shape, before = (_places(evaluated.vertices, name) for name in ("co", "undeformed_co"))
    texture_space.keep(mesh, evaluated)
    if shape != before:
        mesh.texco_mesh = bpy.data.meshes.new("rnmbake undeformed")
        mesh.texco_mesh.vertices.add(len(evaluated.vertices))
        mesh.texco_mesh.vertices.foreach_set("co", before)
        texture_space.keep(mesh.texco_mesh, evaluated)


def _places(vertices, name):
    values = array("f", bytes(12 * len(vertices)))
    vertices.foreach_get(name, values)
    return values
