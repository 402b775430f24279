"""A node group from arithmetic on sockets: each call makes a node, links what goes in and returns what comes out.

Works in shaders of every version from 3.4 on. What goes in is a socket or a constant: a number, or three.
"""
import bpy

COLUMN, GAP = 240, 30  # of the layout, in the units of the node editor
KINDS = {"colour": "NodeSocketColor", "vector": "NodeSocketVector", "number": "NodeSocketFloat"}


class GroupBuilder:
    def __init__(self, name, about):
        self.tree = bpy.data.node_groups.new(name, "ShaderNodeTree")
        self.tree.use_fake_user = True
        if hasattr(self.tree, "description"):  # from 4.2 on
            self.tree.description = about
        self._entry = self.tree.nodes.new("NodeGroupInput")
        self._exit = self.tree.nodes.new("NodeGroupOutput")

    def input(self, kind, name, about, default=None, is_share=False):
        """`is_share`: a number from 0 to 1, with a slider."""
        interface = self._new_socket("INPUT", kind, name, about, is_share)
        if default is not None:
            interface.default_value = default
        if is_share:
            interface.min_value, interface.max_value = 0, 1
        return self._entry.outputs[name]

    def output(self, kind, name, about, value):
        self._new_socket("OUTPUT", kind, name, about)
        self._give(self._exit.inputs[name], value)

    def math(self, operation, *values, label=""):
        node = self._node("ShaderNodeMath", label, operation=operation)
        for socket, value in zip(node.inputs, values):
            self._give(socket, value)
        return node.outputs["Value"]

    def vector(self, operation, *values, label=""):
        """Vector Math; of colours, each channel for itself. A dot product and a length are numbers."""
        node = self._node("ShaderNodeVectorMath", label, operation=operation)
        sockets = [node.inputs[0], node.inputs["Scale"]] if operation == "SCALE" else node.inputs
        for socket, value in zip(sockets, values):
            self._give(socket, value)
        return node.outputs["Value" if operation in ("DOT_PRODUCT", "LENGTH") else "Vector"]

    def split(self, vector, label=""):
        """X, Y and Z of a vector, or red, green and blue of a colour."""
        node = self._node("ShaderNodeSeparateXYZ", label)
        self._give(node.inputs["Vector"], vector)
        return [node.outputs[name] for name in "XYZ"]

    def join(self, x, y, z, label=""):
        node = self._node("ShaderNodeCombineXYZ", label)
        for name, value in zip("XYZ", (x, y, z)):
            self._give(node.inputs[name], value)
        return node.outputs["Vector"]

    def group(self, tree, label="", **values):
        """Another group as a node; its only output."""
        node = self._node("ShaderNodeGroup", label, node_tree=tree)
        for name, value in values.items():
            self._give(node.inputs[name.replace("_", " ")], value)
        return node.outputs[0]

    def finish(self):
        """Lay out the nodes; returns the group."""
        columns = {}
        for node in self._in_order():
            columns.setdefault(self._depth[node.name], []).append(node)
        for depth, nodes in sorted(columns.items()):
            stack(nodes, depth * COLUMN, self._sources)
        return self.tree

    def _new_socket(self, in_out, kind, name, about, is_share=False):
        if hasattr(self.tree, "interface"):  # from 4.0 on
            socket = self.tree.interface.new_socket(name, description=about, in_out=in_out, socket_type=KINDS[kind])
            if is_share:
                socket.subtype = "FACTOR"
            return socket
        sockets = self.tree.inputs if in_out == "INPUT" else self.tree.outputs
        socket = sockets.new(KINDS[kind] + ("Factor" if is_share else ""), name)
        socket.description = about
        return socket

    def _node(self, kind, label, **settings):
        node = self.tree.nodes.new(kind)
        node.label = label
        for name, value in settings.items():
            setattr(node, name, value)
        return node

    def _give(self, socket, value):
        if isinstance(value, bpy.types.NodeSocket):
            self.tree.links.new(value, socket)
        else:
            socket.default_value = value

    def _in_order(self):
        """All nodes, those that feed others first; notes how far each stands from the group's inputs."""
        self._depth, order = {}, []
        links = [(link.from_node, link.to_node) for link in self.tree.links]
        self._sources = {node.name: [a for a, b in links if b == node] for node in self.tree.nodes}

        def visit(node):
            if node.name not in self._depth:
                before = [visit(source) for source in self._sources[node.name]]
                self._depth[node.name] = 1 + max(before, default=-1)
                order.append(node)
            return self._depth[node.name]

        for node in self.tree.nodes:
            visit(node)
        return order


def stack(nodes, x, sources):
    """One column, each node as near as can be to the height of what feeds it."""
    def wanted(node):
        heights = [source.location.y for source in sources[node.name]]
        return sum(heights) / len(heights) if heights else 0

    nodes.sort(key=wanted, reverse=True)
    top = sum(height_of(node) + GAP for node in nodes) / 2
    for node in nodes:
        node.location = (x, top)
        top -= height_of(node) + GAP


def height_of(node):
    """About what the editor draws; it knows no sizes before it has drawn."""
    unlinked_vectors = sum(socket.type == "VECTOR" and not socket.is_linked for socket in node.inputs if socket.enabled)
    sockets = sum(socket.enabled for socket in (*node.inputs, *node.outputs))
    return 90 + 22 * sockets + 66 * unlinked_vectors
