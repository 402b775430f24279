"""blender -b --factory-startup --python refusal_cases.py -- FOLDER: scenes that must not be baked, and why not."""
import os
import sys

import bpy


def fresh(name):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.name = name
    return bpy.context.object


def save(path):
    bpy.ops.wm.save_as_mainfile(filepath=path, relative_remap=False)


def main(folder):
    path = lambda name: os.path.join(folder, name)
    driver = fresh("driven").driver_add("location", 0).driver
    driver.type, driver.expression = "SCRIPTED", "__import__('os').getpid() * 0 + 1"
    save(path("driver.blend"))

    fresh("cube")
    text = bpy.data.texts.new("auto.py")
    text.write("pass")
    text.use_module = True
    save(path("autorun.blend"))

    fresh("shared")
    save(path("library.blend"))
    fresh("local")
    with bpy.data.libraries.load(path("library.blend"), link=True) as (_, wanted):
        wanted.objects = ["shared"]
    bpy.context.scene.collection.objects.link(bpy.data.objects["shared"])
    save(path("lost_library.blend"))
    os.remove(path("library.blend"))

    fresh("nan_vertex").data.vertices[3].co.x = float("nan")
    save(path("nan_vertex.blend"))
    fresh("nan_place").location.x = float("nan")
    save(path("nan_place.blend"))

    fresh("cube")
    image = bpy.data.images.new("lost", 4, 4)
    image.source, image.filepath, image.use_fake_user = "FILE", path("lost.png"), True
    save(path("lost_image.blend"))


main(sys.argv[sys.argv.index("--") + 1])
