"""blender -b --factory-startup --python digest_check.py -- FOLDER: what changes the scene digest, by what name, and what
does not. Each line of the tables is done to the scene of digest_scene.py, opened anew. Raises where one is wrong."""
import os
import shutil
import sys

import bpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "..", "blender_scripts")]

import digest_scene as base  # noqa: E402
from scene_ops.neutral import neutralise  # noqa: E402
from survey.surveyor import DigestSurveyor, survey_scene  # noqa: E402

FOLDER = sys.argv[sys.argv.index("--") + 1]
SCENE = os.path.join(FOLDER, "scene.blend")


class Task:
    request = {"scene": SCENE}

    def path(self, name):
        return os.path.join(FOLDER, name)

    def progress(self, *_):
        pass


def take_digest():
    task = Task()
    neutralise(bpy.context.scene)
    surveyor = DigestSurveyor(task)
    survey_scene(task, surveyor)
    return {entry["what"]: entry["hash"] for entry in surveyor.digest.entries()}


def differences(before, after):
    names = {name: "changed" for name in before if name in after and before[name] != after[name]}
    names.update({name: "gone" for name in before if name not in after})
    names.update({name: "new" for name in after if name not in before})
    return names


def ob(name):
    return bpy.data.objects[name]


def node(material, name):
    return bpy.data.materials[material].node_tree.nodes[name]


def put(path, value):
    """A change: of "objects['Wall'].location.x", seen from bpy.data."""
    def change():
        owner, _, name = path.rpartition(".")
        setattr(eval("bpy.data." + owner, {"bpy": bpy}), name, value)
    return change


def move_vertex():
    bpy.data.meshes["Wall"].vertices[0].co.z = .25


def move_uv():
    bpy.data.meshes["Wall"].uv_layers[0].data[1].uv = (.75, 0)


def color_vertex():
    bpy.data.meshes["Wall"].color_attributes["tint"].data[2].color = (1, 0, 0, 1)


def smooth():
    bpy.data.meshes["Row"].polygons[0].use_smooth = not bpy.data.meshes["Row"].polygons[0].use_smooth
    bpy.data.meshes["Row"].update()


def unlink():
    tree = bpy.data.materials["Brick"].node_tree
    tree.links.remove(tree.links[-1])


def picture(name, shade):
    """Other pixels in a file."""
    return lambda: base.write_picture(os.path.join(FOLDER, "textures", name), shade)


def library():
    here = bpy.data.filepath
    base.write_library(os.path.join(FOLDER, "furniture.blend"), 2.0)
    bpy.ops.wm.open_mainfile(filepath=here)


def move_part_alone():
    base.square("Second", (0, 3, 0), bpy.data.collections["Parts"])


def next_frame():
    bpy.context.scene.frame_set(2)


def animate_lamp():
    lamp = bpy.data.lights["Lamp"]
    for frame, energy in ((1, 100), (2, 200)):
        lamp.energy = energy
        lamp.keyframe_insert("energy", frame=frame)
    lamp.energy = 777  # the curve decides
    bpy.context.scene.frame_set(1)


def paint(color):
    def change():
        node("Brick", "Principled BSDF").inputs["Roughness"].default_value = color
    return change


def ask_camera():
    tree = bpy.data.materials["Paint"].node_tree
    tree.links.new(tree.nodes["Place"].outputs["Camera"], tree.nodes["Ramp"].inputs[0])


PRINCIPLED = "materials['Brick'].node_tree.nodes['Principled BSDF']"
CHANGED = [
    ("a vertex", move_vertex, {"mesh 'Wall'": "changed"}),
    ("a UV", move_uv, {"mesh 'Wall'": "changed"}),
    ("a colour of a vertex", color_vertex, {"mesh 'Wall'": "changed"}),
    ("smooth faces", smooth, {"mesh 'Row'": "changed"}),
    ("a value of a material", paint(.1), {"material 'Brick'": "changed"}),
    ("a link", unlink, {"material 'Brick'": "changed"}),
    ("a muted node", put("materials['Brick'].node_tree.nodes['Picture'].mute", True), {"material 'Brick'": "changed"}),
    ("a ramp", put("materials['Paint'].node_tree.nodes['Ramp'].color_ramp.elements[0].position", .25),
     {"material 'Paint'": "changed"}),
    ("a node of a group", put("node_groups['Dirt'].nodes['Amount'].outputs[0].default_value", .5),
     {"node group 'Dirt'": "changed"}),
    ("coordinates of an object", put("objects['Origin'].location", (1, 0, 0)), {"object 'Origin'": "changed"}),
    ("a picture's file", picture("wall.png", .9), {"picture 'wall.png'": "changed"}),
    ("a tile's file", picture("tiles.1002.png", .9), {"picture 'tiles.1001.png'": "changed"}),
    ("a frame's file", picture("film_0001.png", .9), {"picture 'film_0001.png'": "changed"}),
    ("a colour space", put("images['wall.png'].colorspace_settings.name", "Non-Color"),
     {"picture 'wall.png'": "changed"}),
    ("a light's strength", put("lights['Lamp'].energy", 12), {"light 'Lamp'": "changed"}),
    ("a light's size", put("lights['Lamp'].shadow_soft_size", .7), {"light 'Lamp'": "changed"}),
    ("a sun's direction", put("objects['Sun'].rotation_euler", (.5, 0, 0)), {"object 'Sun'": "changed"}),
    ("the sky", lambda: exec("bpy.data.worlds['World'].node_tree.nodes['Background'].inputs[0].default_value[0] = .9"),
     {"world 'World'": "changed"}),
    ("hidden from renders", put("objects['Sun'].hide_render", True), {"object 'Sun'": "gone", "light 'Sun'": "gone"}),
    ("shown in renders", put("objects['Hidden'].hide_render", False), {"object 'Hidden'": "new", "mesh 'Hidden'": "new"}),
    ("a modifier", put("objects['Row'].modifiers['Array'].count", 3), {"mesh 'Row'": "changed"}),
    ("a shape key", lambda: exec("bpy.data.shape_keys[0].key_blocks['Up'].value = .5"), {"mesh 'Bent'": "changed"}),
    ("ray visibility", put("objects['Wall'].visible_shadow", False), {"object 'Wall'": "changed"}),
    ("a pass index", put("objects['Wall'].pass_index", 3), {"object 'Wall'": "changed"}),
    ("another material", lambda: exec("bpy.data.meshes['Wall'].materials[0] = bpy.data.materials['Paint']"),
     {"object 'Wall'": "changed", "material 'Brick'": "gone", "picture 'wall.png'": "gone"}),
    ("an instancer", put("objects['Placer0'].location", (0, 9, 0)),
     {"object 'Placer0'": "changed", "instances of 'Placer0'": "changed"}),
    ("what is instanced", move_part_alone,
     {"instances of 'Placer0'": "changed", "instances of 'Placer1'": "changed", "object 'Second'": "new",
      "mesh 'Second'": "new"}),
    ("strands", put("particles['Strands'].hair_length", 2), {"object 'Fur'": "changed", "particles 'Strands'": "changed"}),
    ("a value of geometry nodes", lambda: exec("bpy.data.node_groups['Scatter'].nodes['Points'].inputs['Radius']"
                                               ".default_value = .3"),
     {"node group 'Scatter'": "changed", "mesh 'Dots'": "changed"}),
    ("what geometry nodes read", lambda: exec("bpy.data.meshes['Dots'].vertices[0].co.z = .3"),
     {"object 'Dots'": "changed", "mesh 'Dots'": "changed"}),
    ("caustics", lambda: exec("bpy.context.scene.cycles.caustics_refractive = False"), {"scene settings": "changed"}),
    ("steps in volumes", lambda: exec("bpy.context.scene.cycles.volume_max_steps = 7"), {"scene settings": "changed"}),
    ("a library", library, {"object 'Chair [furniture.blend]'": "changed"}),
    ("an animated lamp", animate_lamp, {"light 'Lamp'": "changed"}),
    ("a film's frame", next_frame, {"picture 'film_0001.png'": "changed"}),
    ("a custom property", lambda: ob("Wall").__setitem__("wetness", .5), {"object 'Wall'": "changed"}),
]


def link_light():
    lit = bpy.data.collections.new("Lit")
    lit.objects.link(ob("Wall"))
    ob("Lamp").light_linking.receiver_collection = lit


if "light_linking" in bpy.types.Object.bl_rna.properties:  # from 4.0 on
    CHANGED.append(("what a light lights", link_light, {"object 'Lamp'": "changed", "collection 'Lit'": "new"}))


def select():
    for other in bpy.context.view_layer.objects:
        other.select_set(True)
    bpy.context.view_layer.objects.active = ob("Lamp")
    for vertex in bpy.data.meshes["Wall"].vertices:
        vertex.select = not vertex.select
    for tree in (bpy.data.materials["Paint"].node_tree, bpy.data.worlds["World"].node_tree):
        for one in tree.nodes:
            one.select = not one.select
        tree.nodes.active = tree.nodes[0]
    bpy.data.meshes["Wall"].uv_layers.active_index = 0


def tidy_nodes():
    for one in bpy.data.materials["Paint"].node_tree.nodes:
        one.location, one.width, one.hide, one.label = (77, 7), 333, True, "tidy"
        one.use_custom_color, one.color, one.show_preview = True, (1, 0, 0), True
    bpy.data.materials["Paint"].node_tree.nodes.new("NodeFrame")


def show_otherwise():
    """What only a viewport shows."""
    wall = ob("Wall")
    wall.display_type, wall.show_name, wall.hide_viewport, wall.show_wire = "WIRE", True, True, True
    bpy.data.materials["Brick"].diffuse_color = (1, 0, 0, 1)
    bpy.data.lights["Lamp"].cutoff_distance = 3
    bpy.context.scene.cursor.location = (1, 2, 3)
    ob("Row").modifiers["Array"].show_expanded = False
    ob("Row").modifiers["Array"].show_viewport = False
    ob("Lamp").hide_set(True)


def other_output():
    scene = bpy.context.scene
    scene.render.filepath, scene.render.resolution_x, scene.render.use_stamp = "/tmp/elsewhere", 333, True
    scene.frame_start, scene.frame_end, scene.frame_step = 5, 55, 5
    scene.view_settings.exposure, scene.render.film_transparent = 2, True
    scene.cycles.samples, scene.cycles.seed, scene.cycles.max_bounces = 7, 7, 7
    scene.cycles.sample_clamp_indirect, scene.render.use_simplify = 1, True
    scene.tool_settings.use_snap = not scene.tool_settings.use_snap
    ob("Camera").location = (5, 5, 5)


def what_is_not_shown():
    nodes = base.nodes_of(bpy.data.materials["Unused"])
    nodes["Principled BSDF"].inputs["Roughness"].default_value = .9
    bpy.data.meshes["Hidden"].vertices[0].co.z = 5
    bpy.data.meshes.new("Unlinked")
    bpy.context.scene.render.engine = "CYCLES"


def other_frame_of_nothing_animated():
    ob("Screen").hide_render = True


def save_again():
    bpy.ops.wm.save_as_mainfile(filepath=SCENE)
    bpy.ops.wm.open_mainfile(filepath=SCENE)


def change_windows():
    screens = bpy.data.screens
    if screens:
        screens[0].show_statusbar = not screens[0].show_statusbar
    for workspace in bpy.data.workspaces:
        workspace.object_mode = "OBJECT"
    bpy.data.workspaces[-1].name = "Elsewhere"


def move_folder():
    there = FOLDER + "_moved"
    shutil.rmtree(there, ignore_errors=True)
    shutil.copytree(FOLDER, there)
    os.rename(os.path.join(there, "scene.blend"), os.path.join(there, "other name.blend"))
    bpy.ops.wm.open_mainfile(filepath=os.path.join(there, "other name.blend"))


def pack_nothing_but_touch():
    os.utime(os.path.join(FOLDER, "textures", "wall.png"))


def mark_as_asset():
    bpy.data.materials["Brick"].asset_mark()
    bpy.data.materials["Brick"].use_fake_user = True


def move_material():
    ob("Wall").active_material_index = 0
    bpy.data.materials["Brick"].preview_render_type = "CUBE"


SAME = [("nothing", lambda: None), ("selection", select), ("nodes' places", tidy_nodes), ("viewport", show_otherwise),
        ("output", other_output), ("what is not shown", what_is_not_shown), ("saved again", save_again),
        ("windows", change_windows), ("moved and renamed", move_folder), ("touched", pack_nothing_but_touch),
        ("assets", mark_as_asset), ("previews", move_material),
        ("the other frame's file", picture("film_0002.png", .9))]


def fresh():
    """The scene and its files, as built."""
    shutil.rmtree(FOLDER)
    shutil.copytree(FOLDER + "_built", FOLDER)
    bpy.ops.wm.open_mainfile(filepath=SCENE)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    base.build(FOLDER)
    shutil.rmtree(FOLDER + "_built", ignore_errors=True)
    shutil.copytree(FOLDER, FOLDER + "_built")
    fresh()
    before = take_digest()
    wrong = []
    for name, change, expected in [*CHANGED, *[(name, change, {}) for name, change in SAME]]:
        fresh()
        change()
        found = differences(before, take_digest())
        if found != expected:
            wrong.append(f"{name}: {found}, not {expected}")
    fresh()
    ask_camera()
    asked = take_digest()
    fresh()
    ask_camera()
    ob("Camera").location = (5, 5, 5)
    found = differences(asked, take_digest())
    if found != {"scene settings": "changed"}:
        wrong.append(f"a camera that a material asks for: {found}")
    fresh()  # for the launches that follow
    base.write_imports(FOLDER)
    print(len(before), "parts;", len(CHANGED), "changes,", len(SAME), "that are none")
    if wrong:
        raise SystemError("\n".join(wrong))


main()
