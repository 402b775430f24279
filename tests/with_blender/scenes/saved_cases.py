"""blender -b --factory-startup --python saved_cases.py -- FOLDER: scene.blend, library.blend and textures/, for
saved_scene_check.py: whatever a copy of a scene in another folder could lose."""
import os
import sys

import bpy

FOLDER = sys.argv[sys.argv.index("--") + 1]
LONG = "Säule mit einem Namen, der länger ist als sechzig Zeichen ä"  # 63 bytes
TWIN = "Zwilling mit einem Namen, der länger ist als sechzig"  # its instances' keys are too long


def picture(name):
    image = bpy.data.images.new(name, 4, 4)
    image.generated_color = (0.8, 0.3, 0.2, 1)
    image.filepath_raw, image.file_format = os.path.join(FOLDER, "textures", name + ".png"), "PNG"
    image.save()
    bpy.data.images.remove(image)


def textured(name, file, source="FILE"):
    image = bpy.data.images.load("//textures/" + file)
    image.source = source
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    texture = material.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(texture.outputs[0], shader.inputs["Base Color"])
    return material


def cube(name, layers=(), at=(0, 0, 0), mesh=None):
    """With UVs that tell the layers apart: all of the square, moved by the layer's number over 100."""
    if mesh is None:
        mesh = bpy.data.meshes.new(name)
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        mesh.from_pydata(corners, [], [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
        for number, layer in enumerate(layers):
            uv = [(face % 3 + 0.1 + 0.8 * u) / 3 * 0.9 if k == 0 else (face // 3 + 0.1 + 0.8 * v) / 2 * 0.9
                  for face in range(6) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)) for k in range(2)]
            mesh.uv_layers.new(name=layer).data.foreach_set("uv", [value + number / 100 for value in uv])
    ob = bpy.data.objects.new(name, mesh)
    ob.location = at
    bpy.context.scene.collection.objects.link(ob)
    return ob


def library():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    picture("wood")
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "library.blend"))
    shelf = bpy.data.collections.new("shelf")
    bpy.context.scene.collection.children.link(shelf)
    for name in ("book", "crate"):
        ob = cube(name, ["UVMap"])
        bpy.context.scene.collection.objects.unlink(ob)
        shelf.objects.link(ob)
        ob.data.materials.append(textured(name, "wood.png"))
    bpy.ops.wm.save_mainfile()


def scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for name in ("brick", "tiles.1001", "tiles.1002"):
        picture(name)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(FOLDER, "scene.blend"))
    bpy.context.scene.world = bpy.data.worlds.new("sky")
    bpy.context.scene.render.engine, bpy.context.scene.render.resolution_x = "CYCLES", 123

    crate = cube("crate", ["UVMap"], (0, 0, 0))
    crate.modifiers.new("Array", "ARRAY").count = 2
    crate.data.materials.append(textured("brick", "brick.png"))
    crate["kept"] = "yes"
    crate.pass_index = 3
    lid = cube("lid", ["Tiles", "Stains"], (0, 0, 3))
    lid.parent = crate
    lid.data.uv_layers["Stains"].active_render = True
    lid.data.materials.append(textured("tiles", "tiles.1001.png", "TILED"))
    cube("bare", (), (5, 0, 0))
    cube(LONG, ["UVMap"], (10, 0, 0)).modifiers.new("Bevel", "BEVEL").width = 0.1
    cube("third", ["A", "B", "Lightmap"], (15, 0, 0)).data.uv_layers["B"].active_render = True
    cube("first", ["Lightmap", "Tiles"], (20, 0, 0)).data.uv_layers["Tiles"].active_render = True
    only = cube("only", ["Lightmap"], (25, 0, 0))
    small = cube("small", mesh=cube("large", ["UVMap"], (30, 0, 0)).data, at=(35, 0, 0))
    small.scale = (0.4, 0.4, 1)
    assert only.data.users == 1

    curve = bpy.data.curves.new("vase", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.3
    spline = curve.splines.new("POLY")
    spline.points.add(1)
    for point, x in zip(spline.points, (-1, 1)):
        point.co = (x, 0, 0, 1)
    vase = bpy.data.objects.new("vase", curve)
    vase.location = (0, 8, 0)
    bpy.context.scene.collection.objects.link(vase)
    cube("flower", ["UVMap"], (0, 0, 3)).parent = vase

    pair = bpy.data.collections.new("pair")
    for at in ((0, 0, 0), (0, 0, 3)):
        twin = cube(TWIN, ["UVMap"], at)
        bpy.context.scene.collection.objects.unlink(twin)
        pair.objects.link(twin)
    for twin in pair.objects:  # what a render reads of an instance, beside its faces
        twin.visible_glossy, twin.pass_index, twin["wear"] = False, 4, 0.5
        for owner in (twin, twin.cycles):
            for name in ("shadow_terminator_geometry_offset", "shadow_terminator_shading_offset"):
                if hasattr(owner, name):
                    setattr(owner, name, 0.25)
    for x in (5, 10):
        empty = bpy.data.objects.new("row of twins", None)
        empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", pair, (x, 8, 0)
        bpy.context.scene.collection.objects.link(empty)
        empty.visible_shadow, empty.color = x == 5, (0.1, 0.2, 0.3, 1)  # its colour is its instances'

    with bpy.data.libraries.load("//library.blend", link=True, relative=True) as (_, wanted):
        wanted.collections = ["shelf"]
    shelf = wanted.collections[0]
    bpy.context.scene.collection.children.link(shelf)

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location = (15, 4, 60)
    bpy.context.scene.collection.objects.link(camera)  # not made the active one
    bpy.ops.wm.save_mainfile()


os.makedirs(os.path.join(FOLDER, "textures"), exist_ok=True)
library()
scene()
