"""blender -b --factory-startup --python bad_input_cases.py -- FOLDER: small scenes, each with one thing wrong.

good.blend is the exception: three cards under a sun, one of them ("offender") far away at x = 2000.
"""
import os
import sys

import bpy

MARKER = "script_was_here"  # what the auto-run script would leave beside its scene


def link(ob):
    bpy.context.scene.collection.objects.link(ob)
    return ob


def card(name, x=0.0):
    """A unit square that faces up, with lightmap UVs that fill the map."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="Lightmap")
    ob = link(bpy.data.objects.new(name, mesh))
    ob.location.x = x
    return ob


def sun():
    light = bpy.data.lights.new("sun", "SUN")
    light.energy = 3
    link(bpy.data.objects.new("sun", light)).location = (0, 0, 5)


def edges_only(name):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0)], [(0, 1)], [])
    return link(bpy.data.objects.new(name, mesh))


def good(_folder):
    for x, name in ((0, "floor"), (2000, "offender"), (4, "wall")):
        card(name, x)


def no_meshes(_folder):
    link(bpy.data.objects.new("empty", None))


def no_faces(_folder):
    edges_only("wire")


def some_faces(_folder):
    edges_only("wire")
    card("floor")


def zero_uvs(_folder):
    layer = card("flat_uvs").data.uv_layers["Lightmap"]
    layer.data.foreach_set("uv", [0.0] * (2 * len(layer.data)))


def no_area(_folder):
    """Meshes without UVs: a square with a line beside it, and one of lines alone, which Blender's own unwrapping
    (3.4) never leaves: rounding gives its faces an area, but no normal."""
    points = [(5.814213752746582, -9.422918319702148, 6.716397762298584),
              (4.86979341506958, -11.947897911071777, 4.489779949188232),
              (3.4841995239257812, -15.652389526367188, 1.2230255603790283),
              (3.5154166221618652, -15.568928718566895, 1.2966245412826538),
              (8.73170280456543, -1.622786045074463, 13.594834327697754),
              (3.1746292114257812, -16.48004913330078, 0.4931650757789612)]
    mesh = bpy.data.meshes.new("lines")
    mesh.from_pydata(points, [], [(0, 1, 2), (3, 4, 5)])
    link(bpy.data.objects.new("lines", mesh))
    mesh = bpy.data.meshes.new("partly")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), *points[:3]], [], [(0, 1, 2, 3), (4, 5, 6)])
    link(bpy.data.objects.new("partly", mesh))


def doubled(_folder):
    """A square that is there twice, and one with another on its back."""
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    for name, second in (("kit", (4, 5, 6, 7)), ("leaf", (6, 5, 4, 7))):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(2 * points, [], [(0, 1, 2, 3), second])
        link(bpy.data.objects.new(name, mesh)).location.x = 2 * (name == "leaf")


def dark(_folder):
    card("floor")
    bpy.data.lights["sun"].energy = 0


def nan_vertex(_folder):
    card("floor")
    card("broken", 2).data.vertices[3].co.x = float("nan")


def names(_folder):
    wanted = ("../../x", "a/b", "Säule 柱", "n" * 300, "case", "CASE", ".hidden", "-flag", "con")
    for x, name in enumerate(wanted):
        card(name, 2.0 * x)


def autorun(folder):
    card("floor")
    text = bpy.data.texts.new("auto.py")
    text.write(f"open({os.path.join(folder, MARKER)!r}, 'w').close()\n")
    text.use_module = True


def driver(_folder):
    driven = card("driven").driver_add("location", 0).driver
    driven.type, driven.expression = "SCRIPTED", "__import__('os').getpid() * 0 + 1"


def device(_folder):
    """A material that reads a picture without end."""
    material = bpy.data.materials.new("endless")
    material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = bpy.data.images.new("zeros", 1, 1)
    node.image.source, node.image.filepath = "FILE", "/dev/zero"
    card("floor").data.materials.append(material)


def simulations(folder):
    """Written when the file is opened: the fluid's cache, where it says; in later frames the cloth's, beside it."""
    card("floor")
    cloth = card("cloth").modifiers.new("cloth", "CLOTH")
    bpy.ops.mesh.primitive_cube_add(location=(0, 0, 3))
    bpy.context.object.name = "domain"
    domain = bpy.context.object.modifiers.new("fluid", "FLUID")
    domain.fluid_type, domain.show_viewport = "DOMAIN", False
    domain.domain_settings.cache_directory = os.path.join(folder, "simulation_was_here")
    domain.domain_settings.resolution_max = 8
    lie_in(folder, "simulations")
    cloth.point_cache.use_disk_cache = True
    show_as_saved(domain)


def paint(folder):
    """Written when the file is opened: the canvas' cache, beside it."""
    card("floor")
    ob = bpy.context.view_layer.objects.active = card("canvas")
    canvas = ob.modifiers.new("paint", "DYNAMIC_PAINT")
    bpy.ops.dpaint.type_toggle(type="CANVAS")
    lie_in(folder, "paint")
    canvas.canvas_settings.canvas_surfaces[0].point_cache.use_disk_cache = True
    show_as_saved(canvas)


def lie_in(folder, name):
    """A disk cache lies beside a file: needs one."""
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, name + ".blend"))


def show_as_saved(modifier):
    """In the file alone: a simulation must not run here. Blender 4.3 of Debian dies of any fluid, as its Python is too new."""
    def show(*_):
        modifier.show_viewport = True

    def hide(*_):
        modifier.show_viewport = False
    hide()
    bpy.app.handlers.save_pre.append(show)
    bpy.app.handlers.save_post.append(hide)


def main(folder):
    for build in (good, no_meshes, no_faces, some_faces, zero_uvs, no_area, doubled, dark, nan_vertex, names, autorun, driver,
                  device, simulations, paint):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        sun()
        build(folder)
        bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, build.__name__ + ".blend"), compress=False)


main(sys.argv[sys.argv.index("--") + 1])
