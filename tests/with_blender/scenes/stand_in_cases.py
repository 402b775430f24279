"""blender -b --factory-startup --python stand_in_cases.py: plain objects look as what they stand for, in every pixel and flag.

Each scene is rendered as it is, then with all of its surfaces realized, then as a flat scene. All light is sharp and direct.
"""
import math
import os
import sys
import tempfile

import bpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../blender_scripts"))
from lambert import collect, flat_scene  # noqa: E402
from objects import realize, shown, stand_ins  # noqa: E402

WIDTH = 4.0  # of a cell, which is three pixels wide; what it shows lies around its middle
HAS_LINKING = bpy.app.version >= (4, 0)


class Cells:
    def __init__(self):
        self.count = 0

    def new(self):
        self.count += 1
        return WIDTH * (self.count - 0.5)


def link(ob, collection=None):
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def square(name, x, height=0.0, collection=None, half=1.5):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap").data.foreach_set("uv", [0, 0, 0.6, 0, 0.6, 0.4, 0, 0.4])
    ob = link(bpy.data.objects.new(name, mesh), collection)
    ob.location = (x, 0, height)
    return ob


def lid(name, x, collection=None):
    """Keeps the sun from the middle of a cell; no camera sees it."""
    ob = square(name, x, 1, collection, 1)
    ob.visible_camera = False
    return ob


def lamp(name, kind, energy, collection=None):
    data = bpy.data.lights.new(name, kind)
    data.energy = energy
    if kind == "SUN":
        data.angle = 0
    return link(bpy.data.objects.new(name, data), collection)


def sun(name="sun", collection=None):
    return lamp(name, "SUN", math.pi, collection)


def instancer(name, collection):
    ob = link(bpy.data.objects.new(name, None))
    ob.instance_type, ob.instance_collection = "COLLECTION", collection
    return ob


def instanced(name, x, make=square):
    """(object, what places it)"""
    collection = bpy.data.collections.new(name)
    return make(name, x, collection=collection), instancer("instancer of " + name, collection)


def glowing(ob, node, output, **settings):
    """With the colour that a node gives; no light to others."""
    material = bpy.data.materials.new(ob.name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    source, emission, out = (nodes.new("ShaderNode" + kind) for kind in (node, "Emission", "OutputMaterial"))
    for name, value in settings.items():
        setattr(source, name, value)
    material.node_tree.links.new(source.outputs[output], emission.inputs["Color"])
    material.node_tree.links.new(emission.outputs[0], out.inputs["Surface"])
    ob.data.materials.append(material)
    if hasattr(material.cycles, "emission_sampling"):
        material.cycles.emission_sampling = "NONE"
    else:
        material.cycles.sample_as_light = False
    return ob


def plain(cells):
    """All but lights that choose, under one sun."""
    sun()
    for name, flag, value in (("shadowless", "visible_shadow", False), ("lid", "visible_diffuse", False)):
        x = cells.new()
        square("floor of " + name, x)
        setattr(instanced(name, x, lid)[1], flag, value)
    for flag in ("is_holdout", "is_shadow_catcher"):
        for of_instancer in (False, True):
            setattr(instanced(f"{flag} {of_instancer}", cells.new())[of_instancer], flag, True)
    flags(*instanced("flags", cells.new()))
    for name, node, output, settings in (("random", "ObjectInfo", "Random", {}), ("tint", "ObjectInfo", "Color", {}),
                                         ("wear", "Attribute", "Color", {"attribute_type": "OBJECT", "attribute_name": "wear"}),
                                         ("tear", "Attribute", "Color", {"attribute_type": "INSTANCER", "attribute_name": "tear"})):
        ob, placing = instanced(name, cells.new())
        glowing(ob, node, output, **settings)
        ob["wear"], placing["tear"] = 0.3, 0.6
        placing.color = (0.1, 0.2, 0.3, 1)
    glowing(square("random of its own", cells.new()), "ObjectInfo", "Random")
    text = link(bpy.data.objects.new("random of a text", bpy.data.curves.new("text", "FONT")))
    text.data.body, text.data.size, text.location = "I", 8, (cells.new() - 1, -2.8, 0)
    text.data.offset = 0.2
    glowing(text, "ObjectInfo", "Random")
    glowing(square("generated", cells.new(), half=0.5), "TexCoord", "Generated").modifiers.new("Array", "ARRAY").count = 2
    for output in ("Generated", "UV"):
        on_faces("face " + output, cells.new(), "TexCoord", output)
    on_faces("face map", cells.new(), "UVMap", "UV")
    sheared(cells.new())
    ball = link(bpy.data.objects.new("ball", bpy.data.metaballs.new("ball")))
    ball.data.elements.new().radius = 2
    ball.location.x = cells.new()


def on_faces(name, x, node, output):
    """Placed by a face, whose coordinates it shows."""
    host = square("host of " + name, x, half=0.5)
    host.instance_type, host.show_instancer_for_render = "FACES", False
    ob = glowing(square(name, 0), node, output, from_instancer=True)
    ob.parent = host


def sheared(x):
    parent = link(bpy.data.objects.new("parent", None))
    parent.location.x, parent.scale = x, (0.6, 1, 1)
    ob = square("sheared", 0)
    ob.parent, ob.rotation_euler.z = parent, 0.6


def flags(ob, placing):
    ob.pass_index, placing.visible_glossy, placing.lightgroup = 7, False, "group"
    bpy.context.view_layer.lightgroups.add().name = "group"
    for owner in (ob, ob.cycles):
        for name in ("shadow_terminator_offset", "shadow_terminator_geometry_offset", "shadow_terminator_shading_offset",
                     "shadow_terminator_normal_offset"):
            if hasattr(owner, name):
                setattr(owner, name, 0.37)


def lamp_beside(cells):
    """In the same collection as what is replaced."""
    ob, _ = instanced("lit by its neighbour", cells.new())
    lamp("neighbour", "POINT", 200, ob.users_collection[0]).location = (ob.location.x, 0, 2)


def chosen(ob, role, members):
    collection = bpy.data.collections.new("chosen")
    for member, state in members:
        collection.objects.link(member)
        collection.collection_objects[-1].light_linking.link_state = state
    setattr(ob.light_linking, role, collection)


def receiving(states):
    """Whether the sun lights an instance; `states` of the object and of what places it."""
    def build(cells):
        things = instanced("thing", cells.new())
        square("other", cells.new())
        chosen(sun(), "receiver_collection", [(thing, state) for thing, state in zip(things, states) if state])
    return build


def blocking(states):
    def build(cells):
        x = cells.new()
        square("floor", x)
        things = instanced("thing", x, lid)
        other = cells.new()
        square("other floor", other)
        lid("other", other)
        chosen(sun(), "blocker_collection", [(thing, state) for thing, state in zip(things, states) if state])
    return build


def choosing(of_instancer):
    """The sun is an instance, and it, or what places it, chooses."""
    def build(cells):
        first, _ = square("first", cells.new()), square("second", cells.new())
        collection = bpy.data.collections.new("suns")
        things = sun(collection=collection), instancer("instancer of suns", collection)
        chosen(things[of_instancer], "receiver_collection", [(first, "INCLUDE")])
    return build


def through_a_child(cells):
    """An object in a collection in the one that the sun names, and again in that itself."""
    ob = square("thing", cells.new())
    square("other", cells.new())
    lamp_of_all = sun()
    chosen(lamp_of_all, "receiver_collection", [(ob, "INCLUDE")])
    child = bpy.data.collections.new("child")
    child.objects.link(ob)
    lamp_of_all.light_linking.receiver_collection.children.link(child)


def scenes():
    yield "plain", plain
    yield "lamp beside", lamp_beside
    if HAS_LINKING:
        states = ("INCLUDE", None), (None, "INCLUDE"), ("INCLUDE", "EXCLUDE"), ("EXCLUDE", "INCLUDE")
        for pair in states:
            yield f"receiving {pair}", receiving(pair)
            yield f"blocking {pair}", blocking(pair)
        for of_instancer in (False, True):
            yield f"choosing {of_instancer}", choosing(of_instancer)
        yield "through a child", through_a_child


def new_scene(build):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, cells = bpy.context.scene, Cells()
    build(cells)
    camera = link(bpy.data.objects.new("camera", bpy.data.cameras.new("camera")))
    camera.data.type, camera.data.ortho_scale = "ORTHO", WIDTH * cells.count
    camera.location = (WIDTH * cells.count / 2, 0, 10)
    scene.camera = camera
    return cells


def picture(cells):
    """RGBA of the middle of each cell."""
    scene = bpy.context.scene
    render, cycles, settings = scene.render, scene.cycles, scene.render.image_settings
    render.engine, render.film_transparent, render.use_compositing = "CYCLES", True, False
    render.resolution_x, render.resolution_y, render.resolution_percentage = 3 * cells.count, 3, 100
    cycles.samples, cycles.max_bounces, cycles.use_denoising, cycles.use_adaptive_sampling = 4, 0, False, False
    cycles.pixel_filter_type = "BOX"
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    with tempfile.TemporaryDirectory() as folder:
        render.filepath = os.path.join(folder, "picture.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(render.filepath)
        pixels = list(image.pixels)
    bpy.data.images.remove(image)
    return [pixels[4 * (3 * cells.count + 3 * cell + 1):][:4] for cell in range(cells.count)]


def realized():
    realize.realize({item.name for item in shown.collect().surfaces})


def flat():
    found = collect.Scene()
    flat_scene.rebuild(found)
    stand_ins.answer_instances(found.surfaces)
    for surface in found.surfaces:
        stand_ins.give_materials(surface.object, surface.materials)


def describe(name):
    """Flags of the one that shows there."""
    ob = next(ob for ob in bpy.context.scene.objects if name in ob.name and not ob.hide_render)
    terminators = [round(getattr(owner, flag), 3) for owner in (ob, ob.cycles) for flag in dir(owner)
                   if flag.startswith("shadow_terminator")]
    return (ob.pass_index, ob.visible_glossy, ob.visible_diffuse, ob.lightgroup, terminators)


def compare(name, wanted, found, faults):
    for cell, (one, other) in enumerate(zip(wanted, found)):
        if max(abs(a - b) for a, b in zip(one, other)) > 1e-3:
            faults.append(f"{name}, cell {cell}: {[round(value, 4) for value in one]} became {[round(value, 4) for value in other]}")


faults = []
for scene_name, maker in scenes():
    as_it_is = picture(new_scene(maker))
    if scene_name == "plain":
        source = bpy.data.objects["flags"]
        terminator = [round(getattr(owner, flag), 3) for owner in (source, source.cycles) for flag in dir(owner)
                      if flag.startswith("shadow_terminator")]
        assert 0.37 in terminator
    for way, replace in (("realized", realized), ("flat", flat)):
        scene_cells = new_scene(maker)
        replace()
        compare(f"{scene_name}, {way}", as_it_is, picture(scene_cells), faults)
        if scene_name == "plain" and describe("/flags") != (7, False, True, "group", terminator):
            faults.append(f"{way}: flags {describe('/flags')}")
if faults:
    sys.exit("\n".join(faults))
