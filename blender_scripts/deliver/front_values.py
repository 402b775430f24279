"""What nodes compute for the camera in front of a surface, where that is the same everywhere on it."""
import math

OPERATIONS = {
    "ADD": lambda a, b, c: a + b,
    "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: a / b if b else 0.0,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: math.pow(a, b) if a > 0 else 0.0,
    "MINIMUM": lambda a, b, c: min(a, b),
    "MAXIMUM": lambda a, b, c: max(a, b),
    "LESS_THAN": lambda a, b, c: float(a < b),
    "GREATER_THAN": lambda a, b, c: float(a > b),
    "ABSOLUTE": lambda a, b, c: abs(a),
}


def front_value(socket):
    """Of an input socket: a number, a tuple for a colour, or None where it differs or cannot be told."""
    if not socket.is_linked:
        value = socket.default_value
        return float(value) if isinstance(value, (int, float)) else tuple(float(v) for v in value[:3])
    link = socket.links[0]
    return value_of(link.from_node, link.from_socket) if link.is_valid and not link.is_muted else None


def value_of(node, output):
    if node.mute:
        return None
    if node.type == "REROUTE":
        return front_value(node.inputs[0])
    if node.type in ("VALUE", "RGB"):
        value = node.outputs[0].default_value
        return float(value) if node.type == "VALUE" else tuple(float(v) for v in value[:3])
    if node.type == "NEW_GEOMETRY" and output.name == "Backfacing":
        return 0.0
    if node.type == "LIGHT_PATH" and output.name.startswith("Is "):
        return float(output.name == "Is Camera Ray")
    if node.type == "MATH" and node.operation in OPERATIONS:
        operands = [front_value(one) for one in node.inputs]
        if any(isinstance(one, tuple) or one is None for one in operands):
            return None
        value = OPERATIONS[node.operation](*(operands + [0.0, 0.0])[:3])
        return min(max(value, 0.0), 1.0) if node.use_clamp else value
    return None
