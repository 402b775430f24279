"""Gives lambert materials the normal maps back that the lambert step noted on them."""
import bpy

from lambert.materials import shaders_of
from lambert.notes import NORMAL_IMAGE, NORMAL_STRENGTH, NORMAL_UV


def put_back():
    for material in bpy.data.materials:
        if material.get(NORMAL_IMAGE) is not None and material.use_nodes:
            _add_normal_map(material)


def _add_normal_map(material):
    nodes, links = material.node_tree.nodes, material.node_tree.links
    layer = material.get(NORMAL_UV, "")
    texture, normal = nodes.new("ShaderNodeTexImage"), nodes.new("ShaderNodeNormalMap")
    texture.image = material[NORMAL_IMAGE]
    normal.space, normal.uv_map = "TANGENT", layer
    normal.inputs["Strength"].default_value = material[NORMAL_STRENGTH]
    if layer:
        place = nodes.new("ShaderNodeUVMap")
        place.uv_map = layer
        links.new(place.outputs["UV"], texture.inputs["Vector"])
    links.new(texture.outputs["Color"], normal.inputs["Color"])
    for shader in shaders_of(material):
        if shader.type == "BSDF_DIFFUSE":
            links.new(normal.outputs["Normal"], shader.inputs["Normal"])
