"""Gives each lamp that shines on its front only a black back, so that a model without such lamps shows the same light.

Such a lamp is a mesh whose emission hangs on the Geometry node's Backfacing. The back is a black copy of it, a
ten-thousandth of a unit behind. Arguments: the scene to write, the answer's path (how many there were).
"""
import json
import os
import sys

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../blender_scripts"))
sys.dont_write_bytecode = True

from scene_ops.plain_material import new_diffuse  # noqa: E402

BEHIND = 1e-4


def one_sided(material):
    return material and material.use_nodes and any(
        link.from_socket.name == "Backfacing" for link in material.node_tree.links)


def back_of(lamp):
    """A copy in the world's space, moved against the normals."""
    mesh = bpy.data.meshes.new_from_object(lamp)
    mesh.transform(lamp.matrix_world)
    normals = [vertex.normal.copy() for vertex in mesh.vertices]
    for vertex, normal in zip(mesh.vertices, normals):
        vertex.co -= BEHIND * normal
    mesh.materials.clear()
    mesh.materials.append(new_diffuse("black", (0, 0, 0)))
    return bpy.data.objects.new(f"back of {lamp.name}", mesh)


def main():
    out, answer = sys.argv[sys.argv.index("--") + 1:]
    lamps = [one for one in bpy.context.scene.objects
             if one.type == "MESH" and any(map(one_sided, one.data.materials))]
    for lamp in lamps:
        bpy.context.scene.collection.objects.link(back_of(lamp))
    bpy.ops.wm.save_as_mainfile(filepath=out)
    with open(answer, "w", encoding="utf-8") as file:
        json.dump({"lamps": len(lamps)}, file)


main()
