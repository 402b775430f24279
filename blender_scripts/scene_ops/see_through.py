"""Materials that let light straight through: Transparent BSDFs and Principled BSDFs whose alpha is below 1, and what
has a volume but no surface.

How much goes through is asked of Cycles itself: a copy of the material in which every such closure glows in its own
transparency, and nothing else does, is baked as emission. Mixes, groups and textures stay as they are.
"""
from scene_ops import light_paths
from scene_ops.describe_nodes import active_output, constant, is_zero, reachable_nodes


def lets_light_through(material):
    """Whether it transmits light. Materials whose transmittance depends on the kind of ray count as opaque."""
    if is_volume_alone(material):
        return True
    nodes = surface_nodes(material)
    return any(is_transparent(node) for node in nodes) and not light_paths.unsure(nodes, True)


def is_volume_alone(material):
    """Cycles lets rays through its surface as if there were none. Without a volume it would be black."""
    output = active_output(material) if material else None
    return output is not None and not surface_nodes(material) and any(reachable_nodes(output.inputs["Volume"]))


def has_transparency(material):
    """Whether it is transparent to some kind of ray."""
    return any(is_transparent(node) for node in surface_nodes(material))


def surface_nodes(material):
    output = active_output(material) if material else None
    return list(reachable_nodes(output.inputs["Surface"])) if output else []


def is_transparent(node):
    if node.type == "BSDF_TRANSPARENT":
        return not is_zero(node, "Color")
    return node.type == "BSDF_PRINCIPLED" and constant(node, "Alpha") != 1.0


def casts_opaque_shadow(material):
    """The material's own switch."""
    owner = material if hasattr(material, "use_transparent_shadow") else material.cycles  # before 4.2
    return not owner.use_transparent_shadow


def glow_where_transparent(tree):
    """Every closure of a tree emits what it lets through; groups get trees of their own."""
    for node in list(tree.nodes):
        if node.mute:
            continue
        if node.type == "GROUP" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            glow_where_transparent(node.node_tree)
        elif is_closure(node):
            replace(tree, node)


def is_closure(node):
    return node.type not in ("MIX_SHADER", "ADD_SHADER", "GROUP", "GROUP_INPUT", "REROUTE") and \
        any(output.type == "SHADER" for output in node.outputs)


def replace(tree, node):
    glow = None
    if node.type == "BSDF_TRANSPARENT":
        glow = emission(tree)
        feed(tree, node.inputs["Color"], glow.inputs["Color"])
    elif is_transparent(node):
        glow, rest = emission(tree), tree.nodes.new("ShaderNodeMath")
        rest.operation, rest.use_clamp = "SUBTRACT", True
        rest.inputs[0].default_value = 1
        feed(tree, node.inputs["Alpha"], rest.inputs[1])
        tree.links.new(rest.outputs[0], glow.inputs["Strength"])
    for output in node.outputs:
        for link in [link for link in output.links if not link.is_muted]:
            target = link.to_socket
            tree.links.remove(link)
            if glow and output.type == "SHADER":
                tree.links.new(glow.outputs[0], target)


def emission(tree):
    node = tree.nodes.new("ShaderNodeEmission")
    node.inputs["Color"].default_value, node.inputs["Strength"].default_value = (1, 1, 1, 1), 1
    return node


def feed(tree, source, target):
    """`target` gets what `source` gets."""
    if source.is_linked:
        tree.links.new(source.links[0].from_socket, target)
    else:
        target.default_value = source.default_value
