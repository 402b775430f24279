"""Links between nodes."""


def source(socket):
    """The node behind a socket; reroutes are passed."""
    while socket.is_linked:
        node = socket.links[0].from_node
        if node.type != "REROUTE":
            return node
        socket = node.inputs[0]
    return None


def hand_over(tree, given, taken):
    if given.is_linked:
        tree.links.new(given.links[0].from_socket, taken)
    elif hasattr(given, "default_value") and given.name != "Normal":
        taken.default_value = given.default_value
