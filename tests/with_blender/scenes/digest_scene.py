"""The scene of digest_check.py: one of each thing that the digest has to tell apart, with files around it."""
import json
import os
import struct

import bpy


def build(folder):
    """Write folder/scene.blend, with the library and the pictures that it refers to."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    write_library(os.path.join(folder, "furniture.blend"))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))
    pictures = {name: write_picture(os.path.join(folder, "textures", name), shade)
                for name, shade in (("wall.png", .2), ("tiles.1001.png", .3), ("tiles.1002.png", .4),
                                    ("film_0001.png", .5), ("film_0002.png", .6))}
    surfaces(pictures)
    scattered()
    lights()
    instances()
    with bpy.data.libraries.load(os.path.join(folder, "furniture.blend"), link=True) as (_, wanted):
        wanted.objects = ["Chair"]
    bpy.context.scene.collection.objects.link(wanted.objects[0])
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera")))
    bpy.context.scene.camera = bpy.data.objects["Camera"]
    bpy.ops.file.make_paths_relative()
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "scene.blend"))


def write_library(path, height=1.0):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    chair = square("Chair", (8, 0, height))
    chair.data.materials.append(bpy.data.materials.new("Wood"))
    bpy.ops.wm.save_as_mainfile(filepath=path)


def write_picture(path, shade):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    image = bpy.data.images.new("written", 4, 4)
    image.pixels = [shade, shade, shade, 1] * 16
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    bpy.data.images.remove(image)
    return path


def square(name, place=(0, 0, 0), collection=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="UVMap")
    ob = bpy.data.objects.new(name, mesh)
    ob.location = place
    (collection or bpy.context.scene.collection).objects.link(ob)
    return ob


def nodes_of(block):
    block.use_nodes = True
    return block.node_tree.nodes


def surfaces(pictures):
    wall = square("Wall")
    wall.data.color_attributes.new("tint", "FLOAT_COLOR", "POINT")
    wall.data.materials.append(painted("Brick", pictures["wall.png"], "FILE"))
    square("Tiled", (2, 0, 0)).data.materials.append(painted("Tile", pictures["tiles.1001.png"], "TILED"))
    square("Screen", (4, 0, 0)).data.materials.append(painted("Film", pictures["film_0001.png"], "SEQUENCE"))
    cube = square("Plain", (6, 0, 0))
    cube.data.materials.append(plain_material())
    row = square("Row", (0, 2, 0))
    row.modifiers.new("Array", "ARRAY").count = 2
    key = square("Bent", (2, 2, 0))
    key.shape_key_add(name="Basis")
    key.shape_key_add(name="Up").data[0].co.z = 1
    square("Hidden", (4, 2, 0)).hide_render = True
    fur = square("Fur", (6, 2, 0))
    system = fur.modifiers.new("Fur", "PARTICLE_SYSTEM").particle_system
    system.settings.type, system.settings.count, system.settings.name = "HAIR", 5, "Strands"


def painted(name, path, source):
    material = bpy.data.materials.new(name)
    nodes = nodes_of(material)
    image = bpy.data.images.load(path)
    image.source = source
    if source == "TILED":
        image.filepath = path.replace("1001", "<UDIM>")
        image.tiles.new(1002)
    picture = nodes.new("ShaderNodeTexImage")
    picture.image = image
    picture.image_user.frame_duration = 2
    picture.name = "Picture"
    material.node_tree.links.new(picture.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return material


def plain_material():
    """With a ramp, a group, and coordinates of an object."""
    material = bpy.data.materials.new("Paint")
    nodes, links = nodes_of(material), material.node_tree.links
    ramp, group, place = (nodes.new(kind) for kind in ("ShaderNodeValToRGB", "ShaderNodeGroup", "ShaderNodeTexCoord"))
    ramp.name, group.name, place.name = "Ramp", "Dirt", "Place"
    tree = bpy.data.node_groups.new("Dirt", "ShaderNodeTree")
    tree.nodes.new("ShaderNodeValue").name = "Amount"
    group.node_tree = tree
    place.object = bpy.data.objects.new("Origin", None)
    bpy.context.scene.collection.objects.link(place.object)
    links.new(place.outputs["Object"], ramp.inputs["Fac"])
    links.new(ramp.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    bpy.data.materials.new("Unused").use_fake_user = True
    return material


def scattered():
    """A plane whose nodes make of it a cloud of points."""
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    if hasattr(tree, "interface"):  # from 4.0 on
        for side in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    begin, points, end = (tree.nodes.new(kind) for kind in (
        "NodeGroupInput", "GeometryNodeMeshToPoints", "NodeGroupOutput"))
    points.name = "Points"
    tree.links.new(begin.outputs[0], points.inputs["Mesh"])
    tree.links.new(points.outputs[0], end.inputs[0])
    square("Dots", (12, 2, 0)).modifiers.new("Scatter", "NODES").node_group = tree


def lights():
    for name, kind in (("Lamp", "POINT"), ("Sun", "SUN")):
        ob = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
        ob.location = (0, 0, 5)
        bpy.context.scene.collection.objects.link(ob)
    world = bpy.context.scene.world = bpy.data.worlds.new("World")
    nodes_of(world)


def instances():
    parts = bpy.data.collections.new("Parts")  # seen only through its instances
    square("Part", (0, 0, 1), parts)
    for number in range(2):
        placer = bpy.data.objects.new(f"Placer{number}", None)
        placer.instance_type, placer.instance_collection = "COLLECTION", parts
        placer.location = (10 + number, 0, 0)
        bpy.context.scene.collection.objects.link(placer)


def write_imports(folder):
    """folder/room.gltf and room.obj, which name files of their own and textures/wall.png."""
    corners, uvs = ((0, 0, 0), (1, 0, 0), (0, 1, 0)), ((0, 0), (1, 0), (0, 1))
    with open(os.path.join(folder, "room.bin"), "wb") as stream:
        for rows in (corners, uvs):
            stream.write(b"".join(struct.pack("<f", value) for row in rows for value in row))
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}]
    gltf = {
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "scene": 0, "nodes": [{"mesh": 0, "name": "Wall"}],
        "buffers": [{"uri": "room.bin", "byteLength": 60}], "bufferViews": views,
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0],
                       "max": [1, 1, 0]}, {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "materials": [{"name": "Brick", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}], "images": [{"uri": "textures/wall.png"}],
    }
    with open(os.path.join(folder, "room.gltf"), "w", encoding="utf-8") as stream:
        json.dump(gltf, stream)
    with open(os.path.join(folder, "room.mtl"), "w", encoding="utf-8") as stream:
        stream.write("newmtl Brick\nKd 1 1 1\nmap_Kd textures/wall.png\n")
    lines = ["mtllib room.mtl", "o Wall"] + ["v %g %g %g" % corner for corner in corners]
    lines += ["vt %g %g" % uv for uv in uvs] + ["usemtl Brick", "f 1/1 2/2 3/3"]
    with open(os.path.join(folder, "room.obj"), "w", encoding="utf-8") as stream:
        stream.write("\n".join(lines) + "\n")
