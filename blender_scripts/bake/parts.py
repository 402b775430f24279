"""A part of a mesh as an object of its own, while the rest of it stays in the scene as another."""
from array import array
from contextlib import contextmanager

import bmesh
import bpy


@contextmanager
def as_object(task, target, whole):
    """The object to bake: `whole`, or for as long as this lasts the polygons that target["polygons"] names."""
    if "polygons" not in target:
        yield whole
        return
    with open(task.path(target["polygons"]), "rb") as stream:
        polygons = set(array("i", stream.read()))
    pieces = [_piece(whole, lambda index: index in polygons), _piece(whole, lambda index: index not in polygons)]
    whole.hide_render = True
    yield pieces[0]
    whole.hide_render = False
    for piece in pieces:
        bpy.data.meshes.remove(piece.data)


def _piece(whole, keep):
    """A copy of `whole` with some of its polygons, each with the normals that it had."""
    normals = _kept_normals(whole.data, keep)
    ob = whole.copy()
    ob.data = whole.data.copy()
    faces = bmesh.new()
    faces.from_mesh(ob.data)
    faces.faces.ensure_lookup_table()
    bmesh.ops.delete(faces, geom=[face for face in faces.faces if not keep(face.index)], context="FACES")
    faces.to_mesh(ob.data)
    faces.free()
    if hasattr(ob.data, "use_auto_smooth"):
        ob.data.use_auto_smooth = True
    ob.data.normals_split_custom_set(normals)
    bpy.context.scene.collection.objects.link(ob)
    return ob


def _kept_normals(mesh, keep):
    if hasattr(mesh, "calc_normals_split"):  # <= 4.0
        mesh.calc_normals_split()
        normals = [tuple(loop.normal) for loop in mesh.loops]
    else:
        normals = [tuple(corner.vector) for corner in mesh.corner_normals]
    return [normals[loop] for polygon in mesh.polygons if keep(polygon.index) for loop in polygon.loop_indices]
