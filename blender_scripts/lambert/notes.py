"""What the lambert step takes away and an export has to know of: notes in the .blend that it makes.

On materials: what of the original was beyond diffuse and emission, and its normal map. On the scene: the camera, and
what has no surface. An export reads them from there; a bake does not look at them.
"""
import json
import math

import bpy

from scene_ops.describe import bends_normals, describe_material, describe_probe_place
from scene_ops.describe_nodes import active_output, constant, reachable_nodes
from scene_ops.keys import CAMERA_PROPERTY

OUTSIDE, NORMAL_IMAGE, NORMAL_UV, NORMAL_STRENGTH = (
    "rnmbake outside", "rnmbake normal map", "rnmbake normal uv", "rnmbake normal strength")
PROBE_PLACES = "rnmbake probe places"
RENDER_LAYER = ""  # of NormalMap::uv_layer in scene/diffuse_scene.h


class NotCarried(Exception):
    """Normals that no single picture holds; says why in a few words."""


class MaterialNotes:
    """Notes on a material as the user made it; None for an empty slot."""

    def __init__(self, material):
        self.outside = set(describe_material(material)["outside_model"]) if material else set()
        self.normal_map = None
        try:
            self.normal_map = find_normal_map(material) if material else None
        except NotCarried as reason:
            self.outside.add(str(reason))

    def write_to(self, stand_in):
        stand_in[OUTSIDE] = json.dumps(sorted(self.outside))
        if self.normal_map:
            stand_in[NORMAL_IMAGE], stand_in[NORMAL_UV], stand_in[NORMAL_STRENGTH] = self.normal_map


def find_normal_map(material):
    """(image, UV layer, strength) that all closures of a material share; None where none bends its normals."""
    output = active_output(material)
    shaders = [node for node in reachable_nodes(output.inputs["Surface"]) if bends_normals(node)] if output else []
    found = [normal_map_of(shader.inputs["Normal"]) for shader in shaders]
    if any(one != found[0] for one in found):
        raise NotCarried("several normal maps")
    return found[0] if found else None


def normal_map_of(socket):
    node = first_node(socket)
    if node is None or node.type != "NORMAL_MAP":
        raise NotCarried("bump" if node is not None and node.type == "BUMP" else "normals from nodes")
    strength, texture = constant(node, "Strength"), first_node(node.inputs["Color"])
    if node.space != "TANGENT" or strength is None or texture is None or texture.type != "TEX_IMAGE":
        raise NotCarried("normals from nodes")
    if texture.projection != "FLAT" or not texture.image or texture.image.source not in ("FILE", "GENERATED"):
        raise NotCarried("normals from nodes")
    if 0 in texture.image.size:
        raise NotCarried("normal map without picture")
    return texture.image, uv_layer_of(texture.inputs["Vector"]), strength


def uv_layer_of(socket):
    """The layer that a texture is read through."""
    node = first_node(socket)
    if node is not None and node.type == "MAPPING" and maps_to_itself(node):
        socket = node.inputs["Vector"]
        node = first_node(socket)
    if node is None:
        return RENDER_LAYER
    if node.type == "UVMAP" and not node.from_instancer:
        return node.uv_map
    if node.type == "TEX_COORD" and any(link.from_socket.name == "UV" for link in socket.links):
        return RENDER_LAYER
    raise NotCarried("normal map not placed by UVs alone")


def maps_to_itself(node):
    values = [constant(node, name) for name in ("Location", "Rotation", "Scale")]
    return values == [(0, 0, 0), (0, 0, 0), (1, 1, 1)]


def first_node(socket):
    return next(reachable_nodes(socket), None)


def remember_camera(scene):
    """Note the camera, before surveys change the resolution and with it the field of view."""
    ob = scene.camera if is_plain_camera(scene.camera) else next(filter(is_plain_camera, scene.objects), None)
    why = "no camera is the active one" if scene.camera is None else f"the active one, '{scene.camera.name}', is no plain one"
    note = f"camera '{ob.name}': views look through it, since {why}" if ob != scene.camera and ob else ""
    scene[CAMERA_PROPERTY] = json.dumps({"camera": describe_camera(scene, ob) if ob else None, "note": note})


def remembered_camera(scene):
    """(Camera of scene/diffuse_scene.h, None for a scene without a plain one; what to say of the choice, or "")."""
    known = json.loads(scene.get(CAMERA_PROPERTY, '{"camera": null, "note": ""}'))
    return known["camera"], known["note"]


def remember_probe_places(scene):
    """Note empties and volumes of light probes, which are no part of the lambert scene."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    shown = (ob.evaluated_get(depsgraph) for ob in bpy.context.view_layer.objects if not ob.hide_render)
    places = (describe_probe_place(ob, ob.matrix_world) for ob in shown)
    scene[PROBE_PLACES] = json.dumps([place for place in places if place])


def remembered_probe_places(scene):
    return json.loads(scene.get(PROBE_PLACES, "[]"))


def is_plain_camera(ob):
    return ob is not None and ob.type == "CAMERA" and ob.data.type != "PANO"


def describe_camera(scene, ob):
    ob = ob.evaluated_get(bpy.context.evaluated_depsgraph_get())
    corners = ob.data.view_frame(scene=scene)
    left, right = min(c.x for c in corners), max(c.x for c in corners)
    bottom, top = min(c.y for c in corners), max(c.y for c in corners)
    width, height, depth = right - left, top - bottom, abs(corners[0].z)
    orthographic = ob.data.type == "ORTHO"
    share = scene.render.resolution_percentage / 100
    return {
        "name": ob.name,
        "matrix": [value for row in ob.matrix_world.normalized() for value in row],
        "orthographic": orthographic,
        "angle_x": 1.0 if orthographic else full_angle(width, depth),
        "angle_y": 1.0 if orthographic else full_angle(height, depth),
        "width": width if orthographic else 0.0,
        "shift_x": (left + right) / 2 / width,
        "shift_y": (bottom + top) / 2 / width,
        "resolution_x": max(1, round(scene.render.resolution_x * share)),
        "resolution_y": max(1, round(scene.render.resolution_y * share)),
    }


def full_angle(width, depth):
    return 2 * math.atan(width / 2 / depth)
