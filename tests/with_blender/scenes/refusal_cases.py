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


def displaced(ob):
    material = bpy.data.materials.new("rough rock")
    material.use_nodes = True
    owner = material if hasattr(material, "displacement_method") else material.cycles  # before 4.1
    owner.displacement_method = "BOTH"
    tree = material.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeDisplacement").outputs[0],
                   tree.get_output_node("CYCLES").inputs["Displacement"])
    ob.data.materials.append(material)


def programmed():
    """A material whose colour an OSL script would make."""
    material = bpy.data.materials.new("pattern")
    material.use_nodes = True
    tree = material.node_tree
    script = tree.nodes.new("ShaderNodeScript")
    script.script = bpy.data.texts.new("pattern.osl")
    script.script.write("shader pattern(output color Color = 0) { Color = 1; }")
    socket = script.outputs.get("Color") or script.outputs.new("NodeSocketColor", "Color")
    tree.links.new(socket, next(node for node in tree.nodes if node.type == "BSDF_PRINCIPLED").inputs["Base Color"])
    return material


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
    with open(path("text.png"), "w", encoding="utf-8") as stream:
        stream.write("no picture at all")
    bpy.data.images.load(path("text.png")).use_fake_user = True
    bpy.context.object.modifiers.new("cache", "MESH_CACHE").filepath = path("lost.mdd")
    save(path("lost_files.blend"))

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.object.text_add()
    bpy.context.object.name = "relief"
    displaced(bpy.context.object)
    save(path("displaced.blend"))
    fresh("cube").data.materials.append(programmed())
    bpy.context.scene.render.engine, bpy.context.scene.cycles.shading_system = "CYCLES", True
    save(path("program.blend"))


main(sys.argv[sys.argv.index("--") + 1])
