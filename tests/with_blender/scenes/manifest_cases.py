"""blender -b --factory-startup --python manifest_cases.py -- OUT.blend: one object for each kind of manifest entry."""
import sys

import bpy


def named(name):
    ob = bpy.context.view_layer.objects.active
    ob.name = name
    return ob


def drop_uvs(ob):
    while ob.data.uv_layers:
        ob.data.uv_layers.remove(ob.data.uv_layers[0])


bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.world = bpy.data.worlds.new("sky")
bpy.context.scene.world.color = (0.5, 0.6, 0.7)

bpy.ops.mesh.primitive_plane_add(size=6)
named("floor").data.uv_layers[0].name = "Lightmap"

bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 2))
cube = named("smooth")  # its corner normals lie 54.7 degrees off its faces
cube.data.polygons.foreach_set("use_smooth", [True] * len(cube.data.polygons))
drop_uvs(cube)  # to be unwrapped

bpy.ops.mesh.primitive_plane_add(size=1, location=(2, 0, 1))
dust = named("dust")  # no texel's centre lies in it
dust.data.uv_layers[0].name = "Lightmap"
for loop in dust.data.uv_layers[0].data:
    loop.uv = (0.3 + 1e-4 * loop.uv[0], 0.3 + 1e-4 * loop.uv[1])

bpy.ops.mesh.primitive_plane_add(size=1, location=(-2, 0, 1))
named("left out")

bpy.ops.wm.save_as_mainfile(filepath=sys.argv[sys.argv.index("--") + 1])
