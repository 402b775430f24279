"""Light Path nodes, answered as by the light on its way from one diffuse surface to another.

Cycles asks a glowing surface twice, as what a ray met and as a light to be sampled, and only the first time it says that
the ray is a diffuse one. What is 0 either way is sure; what is not, no single number stands for.
"""
# Everything else that is asked is 0.
BOUNCE = {"Is Diffuse Ray": 1.0, "Is Reflection Ray": 1.0, "Ray Depth": 1.0, "Diffuse Depth": 1.0}
SURE = {"Is Camera Ray", "Is Glossy Ray", "Is Singular Ray", "Is Transmission Ray", "Is Volume Scatter Ray",
        "Glossy Depth", "Transmission Depth"}
IS_SHADOW = "Is Shadow Ray"


def unsure(nodes, transparent):
    """Whether a node reads a Light Path output whose value is not known here. `transparent`: of transmittance, for which
    shadow rays count, too, so that Is Shadow Ray is not known either."""
    sure = SURE if transparent else SURE | {IS_SHADOW}
    return any(node.type == "LIGHT_PATH" and any(out.is_linked and out.name not in sure for out in node.outputs)
               for node in nodes)


def answer(tree):
    """Put constants in place of all Light Path nodes; groups get trees of their own."""
    for node in list(tree.nodes):
        if node.type == "GROUP" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            answer(node.node_tree)
        elif node.type == "LIGHT_PATH":
            _answer_one(tree, node)


def _answer_one(tree, node):
    for output in node.outputs:
        value = tree.nodes.new("ShaderNodeValue")
        value.outputs[0].default_value = BOUNCE.get(output.name, 0.0)
        for link in list(output.links):
            tree.links.new(value.outputs[0], link.to_socket)
