"""Bakes one face of one light probe the way that is written first: a small white plane and a bake of its own.

For comparison only; rnmbake bakes all directions of all probes in one call.

    blender -b SCENE.blend --python probe_face.py -- X Y Z SAMPLES ANSWER.json
"""
import json
import sys
from pathlib import Path

import bpy


def plane_at(place):
    """It faces up, and hides nothing from the light that it meets."""
    bpy.ops.mesh.primitive_plane_add(size=1e-3, location=place)
    plane = bpy.context.object
    plane.visible_diffuse = plane.visible_glossy = plane.visible_shadow = False
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    white, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    white.inputs["Color"].default_value = (1, 1, 1, 1)
    tree.links.new(white.outputs[0], output.inputs["Surface"])
    picture = tree.nodes.new("ShaderNodeTexImage")
    picture.image = bpy.data.images.new("light", 1, 1, float_buffer=True)
    tree.nodes.active = picture
    plane.data.materials.append(material)
    return picture.image


def main(x, y, z, samples, answer):
    image = plane_at((float(x), float(y), float(z)))
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = int(samples), False, False
    bpy.ops.object.bake(type="DIFFUSE", pass_filter={"DIRECT", "INDIRECT"}, margin=0)
    Path(answer).write_text(json.dumps({"light": list(image.pixels[:3])}), encoding="utf-8")


main(*sys.argv[sys.argv.index("--") + 1:])
