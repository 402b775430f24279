"""Keeps light from coming to an object's receivers through the object itself.

Cycles looks for lamps above the horizon of a closure's normal, also where they stand under the face, and leaves it to
the surface below the receiver to block them. A see-through one does not, nor does an object that casts no shadows. So
the first has a front that is opaque for shadow rays that start right above it, as no other rays do; the second gets a
lid, a copy of itself that has nothing but such a front.
"""
import bpy
from mathutils import Vector

from scene_ops.describe_nodes import active_output
from scene_ops.plain_material import empty_tree
from scene_ops.see_through import has_transparency

# At least a receiver's height over its face (src/scene/surface.cpp), for faces of up to 10 units, less in scenes of
# less than 5; its share of the distance from the origin; and how many of them count as right above it: light that comes
# from less than 0.1 degrees under the face gets through.
LEAST, SHARE, REACH = 1e-5, 1e-6, 500


def block_light_from_below(scene):
    least = min(LEAST, 2e-6 * _diagonal(scene))
    for material in bpy.data.materials:
        if not material.library and has_transparency(material):
            _wrap(material.node_tree, active_output(material).inputs["Surface"], least)
    shadowless = [ob for ob in bpy.data.objects
                  if ob.type in {"MESH", "CURVE", "SURFACE", "FONT"} and not ob.visible_shadow and not ob.library]
    if shadowless:
        lid = _lid_material(least)
        for ob in shadowless:
            _put_lid_on(ob, lid)


def _diagonal(scene):
    corners = [ob.matrix_world @ Vector(corner) for ob in scene.objects if ob.type == "MESH" for corner in ob.bound_box]
    if not corners:
        return 1
    return max(max(axis) - min(axis) for axis in zip(*corners))


def _put_lid_on(ob, material):
    lid = ob.copy()
    for collection in ob.users_collection:
        collection.objects.link(lid)
    if not lid.material_slots:
        lid.data = lid.data.copy()
        lid.data.materials.append(None)
    for slot in lid.material_slots:
        slot.link = "OBJECT"
        slot.material = material
    lid.visible_shadow = True
    for ray in ("camera", "diffuse", "glossy", "transmission", "volume_scatter"):
        setattr(lid, "visible_" + ray, False)


def _lid_material(least):
    material = bpy.data.materials.new("rnmbake lid")
    tree = empty_tree(material)
    clear, output = tree.nodes.new("ShaderNodeBsdfTransparent"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(clear.outputs[0], output.inputs["Surface"])
    _wrap(tree, output.inputs["Surface"], least)
    return material


def _wrap(tree, surface, least):
    nodes, links = tree.nodes, tree.links
    mix, black = nodes.new("ShaderNodeMixShader"), nodes.new("ShaderNodeBsdfDiffuse")
    black.inputs["Color"].default_value = (0, 0, 0, 1)
    links.new(_from_own_receiver(tree, least), mix.inputs[0])
    links.new(surface.links[0].from_socket, mix.inputs[1])
    links.new(black.outputs[0], mix.inputs[2])
    links.new(mix.outputs[0], surface)


def _from_own_receiver(tree, least):
    """1 for a short shadow ray that meets the front."""
    nodes, links = tree.nodes, tree.links
    ray, place, distance = (nodes.new(kind) for kind in
                            ("ShaderNodeLightPath", "ShaderNodeNewGeometry", "ShaderNodeVectorMath"))
    distance.operation = "LENGTH"
    links.new(place.outputs["Position"], distance.inputs[0])

    def math(operation, one, other):
        node = nodes.new("ShaderNodeMath")
        node.operation = operation
        for socket, value in zip(node.inputs, (one, other)):
            if isinstance(value, bpy.types.NodeSocket):
                links.new(value, socket)
            else:
                socket.default_value = value
        return node.outputs[0]

    height = math("MAXIMUM", least, math("MULTIPLY", SHARE, distance.outputs["Value"]))
    is_near = math("LESS_THAN", ray.outputs["Ray Length"], math("MULTIPLY", REACH, height))
    is_front = math("SUBTRACT", 1, place.outputs["Backfacing"])
    return math("MULTIPLY", ray.outputs["Is Shadow Ray"], math("MULTIPLY", is_near, is_front))
