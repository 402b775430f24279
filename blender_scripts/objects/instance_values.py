"""Values of objects and instances that materials may read, as custom properties of stand-ins.

Cycles looks up attributes of objects and instancers there; an instance's random number and its coordinates get names of
ours. The number of other objects comes from their name, which stays.
"""
import bpy

from scene_ops.keys import instancer_of
from scene_ops.render_depsgraph import with_render_depsgraph

# What nodes ask of an instance, by the output that says it.
RANDOM, GENERATED, UV = "rnmbake random", "rnmbake instancer generated", "rnmbake instancer uv"


class InstanceValues:
    """Values of all instances of the scene as evaluated now."""

    def __init__(self):
        self._by_host = attributes_by_host()
        self._with_coordinates = any(getattr(node, "from_instancer", False) for tree in node_trees() for node in tree.nodes)

    def of(self, instance):
        """{name: number or list}"""
        ob = instance.object
        values = {**plain_properties(ob.original.data), **plain_properties(ob.original)}
        if instance.is_instance and instance.parent:
            values = {**plain_properties(instance.parent.original), **values}
            if instancer_of(instance):
                own = self._by_host.get(instance.parent.original.name_full, [])
                number = instance.persistent_id[0]
                values.update(own[number] if number < len(own) else {})
            values[RANDOM] = (instance.random_id & 0xffffffff) / 0xffffffff  # Python has it with a sign
            if self._with_coordinates:
                values[GENERATED], values[UV] = [0.5 * at - 0.5 for at in instance.orco], [*instance.uv, 0.0]
        return values


def plain_properties(block):
    found = {}
    for name, value in block.items() if block else ():
        value = value.to_list() if hasattr(value, "to_list") else value
        if all(isinstance(one, (bool, int, float)) for one in (value if isinstance(value, list) else [value])):
            found[name] = value
    return found


def asked_by(node):
    """(output, property) of what the node asks of an instance."""
    if node.type == "OBJECT_INFO":
        answers = {"Random": RANDOM}
    else:
        answers = {"Generated": GENERATED, "UV": UV} if getattr(node, "from_instancer", False) else {}
    return [(node.outputs[name], value) for name, value in answers.items()
            if name in node.outputs and node.outputs[name].is_linked]


def asks(tree):
    return any(asked_by(node) or (node.type == "GROUP" and node.node_tree and asks(node.node_tree)) for node in tree.nodes)


def answer(tree):
    """Make a tree's nodes read the instance's values from its stand-in's properties. Groups get trees of their own."""
    for node in list(tree.nodes):
        if node.type == "GROUP" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            answer(node.node_tree)
        for output, name in asked_by(node):
            attribute = tree.nodes.new("ShaderNodeAttribute")
            attribute.attribute_type, attribute.attribute_name = "OBJECT", name
            for link in list(output.links):
                tree.links.new(attribute.outputs["Fac" if name == RANDOM else "Vector"], link.to_socket)


# ---- attributes that geometry nodes give to instances: Python sees them on points alone -------------------


def attributes_by_host():
    """{name of the instancing object: [{attribute: value}] by the instance's number}."""
    if not any(asks_instancers(tree) for tree in node_trees()):
        return {}
    scene, group = bpy.context.scene, instances_to_vertices()
    probes = {}
    for host in list(scene.objects):
        if any(modifier.type == "NODES" and modifier.show_render for modifier in host.modifiers):
            probe = host.copy()
            probe.modifiers.new("rnmbake", "NODES").node_group = group
            scene.collection.objects.link(probe)
            probes[probe.name_full] = host.name_full
    found = {}
    if probes:
        with_render_depsgraph(lambda depsgraph: read_probes(depsgraph, probes, found))
    for name in probes:
        bpy.data.objects.remove(bpy.data.objects[name])
    bpy.data.node_groups.remove(group)
    return found


def node_trees():
    yield from bpy.data.node_groups
    yield from (material.node_tree for material in bpy.data.materials if material.node_tree)


def asks_instancers(tree):
    return any(node.type == "ATTRIBUTE" and node.attribute_type == "INSTANCER" for node in tree.nodes)


def instances_to_vertices():
    group = bpy.data.node_groups.new("rnmbake instances", "GeometryNodeTree")
    if hasattr(group, "interface"):  # from 4.0 on
        for direction in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    chain = [group.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeInstancesToPoints",
                                                "GeometryNodePointsToVertices", "NodeGroupOutput")]
    for one, other in zip(chain, chain[1:]):
        group.links.new(one.outputs[0], other.inputs[0])
    return group


def read_probes(depsgraph, probes, found):
    for instance in depsgraph.object_instances:
        ob = instance.object
        if instance.is_instance or ob.original.name_full not in probes or not isinstance(ob.data, bpy.types.Mesh):
            continue
        values = [{} for _ in ob.data.vertices]
        for attribute in ob.data.attributes:
            if attribute.domain == "POINT" and attribute.name != "position":
                for number, entry in enumerate(attribute.data):
                    value = next((getattr(entry, name) for name in ("value", "vector", "color")
                                  if hasattr(entry, name)), None)
                    if isinstance(value, (bool, int, float)):
                        values[number][attribute.name] = value
                    elif value is not None and not isinstance(value, (str, bytes)):
                        values[number][attribute.name] = list(value)
        found[probes[ob.original.name_full]] = values
