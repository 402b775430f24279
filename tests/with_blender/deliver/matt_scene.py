"""Blender runs this: saves the open scene with materials that only scatter diffusely, and let nothing through. What a specular lobe
takes away from diffuse light, and in which order see-through surfaces are shown, is an engine's own matter.

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
        elif node.type == "MIX_SHADER":
            sides = [side.links[0].from_node.type if side.is_linked else "" for side in node.inputs[1:]]
            if "BSDF_TRANSPARENT" in sides:
                for link in node.inputs[0].links:
                    material.node_tree.links.remove(link)
                node.inputs[0].default_value = sides[0] == "BSDF_TRANSPARENT"
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
