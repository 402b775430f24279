"""Uniform and emissive materials, and the plain ones that take their place."""
import bpy

from lambert.notes import MaterialNotes
from objects import instance_values
from scene_ops import light_paths
from scene_ops.describe import describe_material
from scene_ops.describe_nodes import active_output
from scene_ops.keys import LABEL_PROPERTY
from scene_ops.plain_material import NO_MATERIAL, empty_tree, make_clear, make_diffuse
from scene_ops.see_through import glow_where_transparent, is_volume_alone, lets_light_through, surface_nodes

# Nodes whose result is one value for a whole surface that is looked at head-on, as a bake does.
UNIFORM = {
    "RGB", "VALUE", "MATH", "VECT_MATH", "MIX", "MIX_RGB", "INVERT", "GAMMA", "BRIGHTCONTRAST", "HUE_SAT",
    "CURVE_RGB", "CURVE_VEC", "CURVE_FLOAT", "VALTORGB", "RGBTOBW", "COMBINE_COLOR", "SEPARATE_COLOR", "COMBRGB",
    "SEPRGB", "COMBHSV", "SEPHSV", "COMBXYZ", "SEPXYZ", "BLACKBODY", "WAVELENGTH", "CLAMP", "MAP_RANGE", "FRESNEL",
    "LAYER_WEIGHT", "LIGHT_PATH", "MIX_SHADER", "ADD_SHADER", "EMISSION", "SUBSURFACE_SCATTERING", "HOLDOUT",
}
# Nodes that vary over a surface, but not from one object to the next with the same mesh.
MESH_BOUND = {
    "UVMAP", "MAPPING", "TEX_IMAGE", "TEX_CHECKER", "TEX_NOISE", "TEX_VORONOI", "TEX_WAVE", "TEX_MAGIC", "TEX_BRICK",
    "TEX_GRADIENT", "TEX_MUSGRAVE", "TEX_WHITE_NOISE", "TEX_GABOR", "VERTEX_COLOR", "NORMAL_MAP", "BUMP",
}
BLACK = (0, 0, 0)
OPAQUE_NOW = ("transparent", "glass", "transmission", "holdout", "ray portal")
UV_ATTRIBUTE = "rnmbake albedo"


class Source:
    """A material of the scene, or None for an empty slot; what it becomes where it is uniform.

    `on_copies`: on instances, which are answered otherwise than their stand-ins would be.
    """

    def __init__(self, material, on_copies):
        self._on_copies = on_copies
        self.material = material
        nodes = surface_nodes(material)
        self.uniform = all(is_uniform(node) for node in nodes)
        self.mesh_bound = all(is_uniform(node) or is_mesh_bound(node) for node in nodes)
        about = describe_material(material) if material else {"emissive": False, "outside_model": []}
        self.emissive = about["emissive"]
        self.see_through = lets_light_through(material)
        self.opaque_now = [what for what in about["outside_model"] if what in OPAQUE_NOW]
        self.notes = MaterialNotes(material)
        self.bakeable, self._texture = make_bakeable(material, on_copies)
        self._window = self._window_texture = None
        self.plain = None

    def lost(self):
        """Losses against the user's material, for a warning; "" for none."""
        if self.opaque_now:
            return f"is {', '.join(self.opaque_now)}; as a diffuse surface it is opaque"
        return "has a volume, which a scene of diffuse surfaces leaves out" if "volume" in self.notes.outside else ""

    @property
    def name(self):
        return self.material.name_full if self.material else ""

    @property
    def window(self):
        """A copy that emits what the material lets through."""
        if self._window is None:
            self._window, self._window_texture = make_bakeable(self.material, self._on_copies)
            glow_where_transparent(self._window.node_tree)
        return self._window

    def write_to(self, image):
        self._texture.image = image
        if self._window:
            self._window_texture.image = image

    def remove_copies(self):
        for copy in filter(None, (self.bakeable, self._window)):
            bpy.data.materials.remove(copy)


def is_uniform(node):
    return node.type in UNIFORM or node.type.startswith("BSDF_")


def is_mesh_bound(node):
    if getattr(node, "from_instancer", False):
        return False
    if node.type == "TEX_COORD":
        return not any(out.is_linked for out in node.outputs if out.name not in ("UV", "Generated"))
    if node.type == "ATTRIBUTE":
        return node.attribute_type == "GEOMETRY"
    return node.type in MESH_BOUND


def make_bakeable(material, on_copies):
    """A copy that Cycles shades alike, and the image node in it that tells a bake where to write."""
    copy = material.copy() if material else bpy.data.materials.new("rnmbake empty slot")
    if material is None or not material.use_nodes or material.node_tree is None:
        make_diffuse(copy, material.diffuse_color[:3] if material else NO_MATERIAL)  # what Cycles shows
    elif is_volume_alone(material):
        make_clear(copy)
    else:
        answer_what_a_bake_cannot(copy, on_copies)
    nodes = copy.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    for node in nodes:
        node.select = node == texture
    nodes.active = texture
    return copy, texture


def answer_what_a_bake_cannot(copy, on_copies):
    """It would be answered as a camera is, on an object that is no instance."""
    nodes = surface_nodes(copy)
    if any(node.type == "LIGHT_PATH" for node in nodes):
        light_paths.answer(copy.node_tree)
    if on_copies and instance_values.asks(copy.node_tree):
        instance_values.answer(copy.node_tree)


def make_lambert(material, color, emission, transmittance=BLACK, peak=1.0):
    """Diffuse BSDF of roughness 0, emission and what goes straight through, added up.

    Each of the three is a colour, or an output socket's maker. An emission's maker gives at most 1 of the `peak`: Cycles
    chooses among lights by what a number says of them, and does not look into pictures.
    """
    tree = empty_tree(material)
    nodes, links = tree.nodes, tree.links
    output, shader = nodes.new("ShaderNodeOutputMaterial"), nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Roughness"].default_value = 0
    _feed(nodes, links, shader.inputs["Color"], color)
    for kind, value in (("Emission", emission), ("BsdfTransparent", transmittance)):
        if not callable(value) and not any(value):
            continue
        other, both = nodes.new("ShaderNode" + kind), nodes.new("ShaderNodeAddShader")
        _feed(nodes, links, other.inputs["Color"], value)
        if kind == "Emission" and callable(value):
            other.inputs["Strength"].default_value = peak
        links.new(shader.outputs[0], both.inputs[0])
        links.new(other.outputs[0], both.inputs[1])
        shader = both
    links.new(shader.outputs[0], output.inputs["Surface"])


def _feed(nodes, links, socket, value):
    if callable(value):
        links.new(value(nodes, links), socket)
    elif min(value) < 0:  # no colour can be; a vector that is taken for one can
        vector = nodes.new("ShaderNodeCombineXYZ")
        for component, number in zip(vector.inputs, value):
            component.default_value = number
        links.new(vector.outputs[0], socket)
    else:
        socket.default_value = (*value, 1)


def picture(image, uv_layer, at_most_one=False, peak=1.0):
    """Makes the output of an image texture, as shares of `peak`, read through a UV layer or, where that is None, UV_ATTRIBUTE."""
    def make(nodes, links):
        texture = nodes.new("ShaderNodeTexImage")
        texture.image, texture.interpolation, texture.extension = image, "Linear", "EXTEND"
        if uv_layer:
            place = nodes.new("ShaderNodeUVMap")
            place.uv_map = uv_layer
            links.new(place.outputs["UV"], texture.inputs["Vector"])
        else:
            place = nodes.new("ShaderNodeAttribute")
            place.attribute_name = UV_ATTRIBUTE
            links.new(place.outputs["Vector"], texture.inputs["Vector"])
        if not at_most_one and peak == 1:
            return texture.outputs["Color"]
        change = nodes.new("ShaderNodeVectorMath")
        change.operation = "MINIMUM" if at_most_one else "MULTIPLY"
        links.new(texture.outputs["Color"], change.inputs[0])
        change.inputs[1].default_value = [1 / peak] * 3
        return change.outputs["Vector"]
    return make


def stand_in(source, color, emission, transmittance=BLACK, peak=1.0):
    """The lambert material for a source, which keeps its name for those who ask (--split material)."""
    material = bpy.data.materials.new(source.name or "rnmbake empty slot")
    material[LABEL_PROPERTY] = source.name
    source.notes.write_to(material)
    make_lambert(material, color, emission, transmittance, peak)
    return material


def shaders_of(material):
    """The one to three that make_lambert adds up."""
    shaders, work = [], [active_output(material).inputs["Surface"]]
    while work:
        source = work.pop().links[0].from_node
        if source.type == "ADD_SHADER":
            work += source.inputs
        else:
            shaders.append(source)
    return shaders
