"""Blender runs this: saves the open scene with materials that only scatter diffusely, and let nothing through. What a specular lobe
takes away from diffuse light, and in which order see-through surfaces are shown, is an engine's own matter. A scene without a camera
gets one.

    blender -b --factory-startup SCENE --python matt_scene.py -- FILE
"""
import sys

import bpy
from mathutils import Vector


def add_camera():
    """Looks at everything from the front right and above."""
    corners = [ob.matrix_world @ Vector(corner) for ob in bpy.data.objects if ob.type == "MESH" for corner in ob.bound_box]
    low, high = (Vector(map(pick, zip(*corners))) for pick in (min, max))
    towards = Vector((0.6, -1, 0.5)).normalized()
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (low + high) / 2 + towards * 1.2 * (high - low).length
    camera.rotation_euler = towards.to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


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
if bpy.context.scene.camera is None:
    add_camera()
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[-1])
