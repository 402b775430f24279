"""Walks a node tree backwards from a socket, through reroutes, groups and muted nodes."""


def active_output(material):
    """The output node that Cycles renders; None for a material without nodes."""
    if not material.use_nodes or material.node_tree is None:
        return None
    return material.node_tree.get_output_node("CYCLES")


def tree_source(tree, output_type):
    """The node that feeds the surface of the active output of a world's or light's tree."""
    outputs = [node for node in tree.nodes if node.type == output_type]
    outputs.sort(key=lambda node: not node.is_active_output)
    if not outputs or not outputs[0].inputs["Surface"].is_linked:
        return None
    return outputs[0].inputs["Surface"].links[0].from_node


def reachable_nodes(socket):
    """Every node that the value of an input socket depends on, each once for each group it is used in."""
    seen = set()
    work = [(socket, ())]
    while work:
        current, groups = work.pop()
        for link in current.links:
            if link.is_muted or not link.is_valid:
                continue
            key = (tuple(group.name for group in groups), link.from_node.name, link.from_socket.identifier)
            if key in seen:
                continue
            seen.add(key)
            node = link.from_node
            if node.type not in ("GROUP", "GROUP_INPUT", "REROUTE") and not node.mute:
                yield node
            work.extend(upstream(node, link.from_socket, groups))


def upstream(node, output, groups):
    """The (socket, enclosing groups) pairs that an output of a node depends on."""
    if node.mute:
        return [(link.from_socket, groups) for link in node.internal_links if link.to_socket == output]
    if node.type == "GROUP" and node.node_tree:
        return [(socket, groups + (node,)) for inner in node.node_tree.nodes
                if inner.type == "GROUP_OUTPUT" and inner.is_active_output
                for socket in inner.inputs if socket.identifier == output.identifier]
    if node.type == "GROUP_INPUT" and groups:
        return [(socket, groups[:-1]) for socket in groups[-1].inputs if socket.identifier == output.identifier]
    if node.type == "MIX_SHADER" and constant(node, "Fac", "Factor") in (0.0, 1.0):
        return [(node.inputs[1 + int(constant(node, "Fac", "Factor"))], groups)]  # the other side is not seen
    return [(socket, groups) for socket in node.inputs if socket.enabled]


def find_input(node, *names):
    return next((node.inputs[name] for name in names if node.inputs.get(name) is not None), None)


def constant(node, *names):
    """The value of the first input that exists under one of the names: a number, or a tuple for a colour.

    None where the value comes from another node, or where the node has no such input.
    """
    socket = find_input(node, *names)
    if socket is None or socket.is_linked:
        return None
    value = socket.default_value
    return float(value) if isinstance(value, (int, float)) else tuple(float(v) for v in value[:3])


def is_zero(node, *names):
    """Whether an input is missing, or is a constant 0 or black."""
    if find_input(node, *names) is None:
        return True
    value = constant(node, *names)
    return value is not None and not any(value if isinstance(value, tuple) else (value,))
