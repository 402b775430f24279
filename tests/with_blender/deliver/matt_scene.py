"""Blender runs this: saves the open scene with materials that only scatter diffusely. What a specular lobe takes away from diffuse
light is an engine's own matter.

    blender -b --factory-startup SCENE --python matt_scene.py -- FILE
"""
import sys

import bpy

for material in bpy.data.materials:
    for node in material.node_tree.nodes if material.use_nodes else ():
        if node.type == "BSDF_PRINCIPLED":
            specular = node.inputs.get("Specular IOR Level") or node.inputs["Specular"]
            specular.default_value = 0
            node.inputs["Metallic"].default_value = 0
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
