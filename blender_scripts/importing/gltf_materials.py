"""Materials as glTF has them, where Blender's importer builds something else."""
import bpy

from core.gltf_extensions import listed, owner_of
from core.gltf_prepare import TAG
from scene_ops.describe_nodes import active_output, find_input
from scene_ops.see_through import feed

# An object's visibility to diffuse rays, shadow rays and the like.
SEEN_BY_LIGHT = ("visible_diffuse", "visible_glossy", "visible_transmission", "visible_volume_scatter",
                 "visible_shadow")


def put_right(gltf):
    """Returns what the user should be warned of."""
    unlit = set()
    for material in [material for material in bpy.data.materials if TAG in material]:
        number = material[TAG]
        entry = gltf.items("materials")[number]
        del material[TAG]
        link_mixed_colors(material.node_tree)
        if entry.get("alphaMode") == "MASK":
            cut_off(material, entry.get("alphaCutoff", 0.5))
        extensions = entry.get("extensions", {})
        if is_thin_glass(extensions):
            let_light_through(material.node_tree)
        if "KHR_materials_unlit" in extensions:
            unlit.add(material)
    for image in bpy.data.images:
        image.alpha_mode = "CHANNEL_PACKED"  # alpha is no part of the colour, and may be of no account
    return leave_unlit(unlit)


def link_mixed_colors(tree):
    """The importer of 3.4 takes a factor's picture from the mix node's first output, which is for numbers only."""
    for node in tree.nodes:
        if node.type == "MIX" and node.data_type == "RGBA":
            for link in list(node.outputs[0].links):
                tree.links.new(node.outputs[2], link.to_socket)


def cut_off(material, cutoff):
    """Alpha becomes 1 from the cutoff on, 0 below."""
    socket, tree = alpha_socket(material), material.node_tree
    if socket is None:
        return
    if not socket.is_linked:
        socket.default_value = float(socket.default_value >= cutoff)
        return
    below, rest = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeMath")
    below.operation, rest.operation = "LESS_THAN", "SUBTRACT"
    tree.links.new(socket.links[0].from_socket, below.inputs[0])
    below.inputs[1].default_value = cutoff
    rest.inputs[0].default_value = 1
    tree.links.new(below.outputs[0], rest.inputs[1])
    tree.links.new(rest.outputs[0], socket)


def alpha_socket(material):
    """Socket of the alpha: of the Principled BSDF, else of the final mix with a Transparent BSDF."""
    for node in material.node_tree.nodes:
        if node.type == "BSDF_PRINCIPLED":
            return node.inputs["Alpha"]
    links = active_output(material).inputs["Surface"].links
    return links[0].from_node.inputs[0] if links and links[0].from_node.type == "MIX_SHADER" else None


def is_thin_glass(extensions):
    """Transmission without a volume is that of a thin wall: nothing is refracted."""
    return extensions.get("KHR_materials_transmission", {}).get("transmissionFactor", 0) > 0 and \
        extensions.get("KHR_materials_volume", {}).get("thicknessFactor", 0) == 0


def let_light_through(tree):
    """Transmission, tinted by the base colour, goes straight on: through Cycles' solid glass no lamp shines."""
    for node in [node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"]:
        share = find_input(node, "Transmission", "Transmission Weight")
        mix, clear = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfTransparent")
        for link in list(node.outputs[0].links):
            tree.links.new(mix.outputs[0], link.to_socket)
        feed(tree, share, mix.inputs[0])
        feed(tree, node.inputs["Base Color"], clear.inputs["Color"])
        for link in list(share.links):
            tree.links.remove(link)
        share.default_value = 0
        tree.links.new(node.outputs[0], mix.inputs[1])
        tree.links.new(clear.outputs[0], mix.inputs[2])


def leave_unlit(unlit):
    """Unlit materials show their colour to cameras alone; objects that have no other stay out of the light's way."""
    if not unlit:
        return []
    for ob in bpy.data.objects:
        slots = {slot.material for slot in ob.material_slots}
        if slots and slots <= unlit:
            for name in SEEN_BY_LIGHT:
                setattr(ob, name, False)
    names = [owner_of("materials", 0, {"name": material.name}) for material in unlit]
    return [f"unlit{listed(names)}: light neither comes from these materials, nor is blocked by them"]
