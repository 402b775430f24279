"""A plane of 2 x 2 that nothing lights, as a .blend and as a glTF: dark_plane.py FILE.blend FILE.glb"""
import sys

import bpy

blend, glb = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_plane_add(size=2)  # its UVs run along x and y
bpy.context.object.name = "floor"
bpy.ops.wm.save_as_mainfile(filepath=blend)
bpy.ops.export_scene.gltf(filepath=glb, export_format="GLB", export_lights=False)
