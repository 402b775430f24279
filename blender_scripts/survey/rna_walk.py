"""What a data-block holds, as one fingerprint: a walk over its properties, but for those that are denied."""
import hashlib

import bpy

from scene_ops.files import absolute, hash_file
from survey.denied import denied

DEEPEST = 16
PATHS = ("FILE_PATH", "DIR_PATH")


class Feed:
    """Collects names with values. Numbers go in by their shortest exact spelling."""

    def __init__(self):
        self._hash = hashlib.blake2b(digest_size=16)

    def add(self, *values):
        self._hash.update("\0".join(map(repr, values)).encode("utf-8", "surrogatepass") + b"\n")

    def add_array(self, name, values):
        self.add(name, len(values))
        self._hash.update(memoryview(values).cast("B"))

    def hexdigest(self):
        return self._hash.hexdigest()


class Walker:
    """`refer(block)`: called with each data-block that another one points to; returns its name among the entries.
    `look(node)`: called with each shader node."""

    def __init__(self, refer, look):
        self._refer, self._look = refer, look
        self._plans = {}

    def walk(self, struct, feed, owner, path="", depth=0):
        """Feed all that counts of a struct and of those that belong to it. `owner`: the data-block around."""
        for name, kind, is_path in self._plan(struct.bl_rna):
            try:
                value = getattr(struct, name)
            except (AttributeError, RuntimeError, ValueError):
                continue
            if kind == "POINTER":
                self._follow(value, feed, owner, f"{path}.{name}", depth)
            elif kind == "COLLECTION":
                for number, item in enumerate(value):
                    self._follow(item, feed, owner, f"{path}.{name}[{number}]", depth)
            elif is_path:
                feed.add(path, name, hash_file(absolute(value, owner)) if value else "")
            else:
                feed.add(path, name, plain(value))
        self.own_properties(struct, feed, path)

    def own_properties(self, struct, feed, path=""):
        """Custom properties, which nodes may ask for, and inputs of geometry nodes."""
        if not isinstance(struct, (bpy.types.ID, bpy.types.Modifier, bpy.types.ViewLayer)):
            return
        try:
            keys = sorted(struct.keys())
        except TypeError:
            return
        registered = struct.bl_rna.properties
        for key in keys:
            if key != "_RNA_UI" and key not in registered:
                self._own(struct[key], feed, f"{path}[{key}]")

    def _own(self, value, feed, path):
        if isinstance(value, bpy.types.ID):
            feed.add(path, self._refer(value))
        elif hasattr(value, "to_dict"):
            for key in sorted(value.keys()):
                self._own(value[key], feed, f"{path}[{key}]")
        else:
            feed.add(path, plain(value))

    def _follow(self, value, feed, owner, path, depth):
        if value is None:
            return
        if isinstance(value, bpy.types.NodeTree) and value.is_embedded_data:
            self.walk_tree(value, feed)
        elif isinstance(value, bpy.types.ID):
            feed.add(path, self._refer(value))
        elif depth < DEEPEST:
            feed.add(path, value.bl_rna.identifier)
            self.walk(value, feed, owner, path, depth + 1)

    def walk_tree(self, tree, feed):
        """Nodes by their names, for their order follows the selection."""
        self.walk(tree, feed, tree)
        for node in sorted(tree.nodes, key=lambda node: node.name):
            if node.type == "FRAME":
                continue
            self._look(node)
            feed.add("node", node.name, node.bl_idname)
            self.walk(node, feed, tree, node.name)
            for side, sockets in (("in", node.inputs), ("out", node.outputs)):
                for socket in sockets:
                    feed.add(side, socket.identifier, socket.bl_idname)
                    self.walk(socket, feed, tree)
        for link in sorted((link.to_node.name, link.to_socket.identifier, link.from_node.name,
                            link.from_socket.identifier, link.is_muted) for link in tree.links):
            feed.add("link", *link)

    def _plan(self, rna):
        """[(name, kind, whether it is a path)] of what counts."""
        if rna.identifier not in self._plans:
            leave_out = denied(rna)
            self._plans[rna.identifier] = [
                (prop.identifier, prop.type, prop.type == "STRING" and prop.subtype in PATHS)
                for prop in sorted(rna.properties, key=lambda prop: prop.identifier)
                if prop.identifier not in leave_out
                and not (prop.is_readonly and prop.type not in ("POINTER", "COLLECTION"))]
        return self._plans[rna.identifier]


def plain(value):
    """As numbers, texts and tuples of them."""
    if isinstance(value, (bool, int, float, str, bytes)):
        return value
    if isinstance(value, (set, frozenset)):
        return sorted(value)
    try:
        return tuple(plain(part) for part in value)
    except TypeError:
        return str(type(value))
