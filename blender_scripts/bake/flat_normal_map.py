"""The published recipe, to the letter: each object keeps its place and its materials, and for each basis
its own materials get that vector as a flat tangent-space normal map. Nothing is corrected.
"""
import bpy

from core.arrays import read_floats
from core.stopwatch import Stopwatch
from core.task import Refusal
from bake import parts
from objects import realize
from scene_ops import cycles
from scene_ops.plain_material import NO_MATERIAL, make_diffuse, new_diffuse


def bake_targets(task, scene):
    targets = task.request["targets"]
    wholes = realize.targets_as_objects(targets)
    cycles.apply_settings(scene, task.request["cycles"])  # after realize, which renders with its own
    total = sum(len(target["bakes"]) for target in targets)
    timings, done = [], 0
    for target, whole in zip(targets, wholes):
        timings.append(bake_target(task, scene, target, whole, done, total))
        done += len(target["bakes"])
    return {"targets": timings}


def bake_target(task, scene, target, whole, done, total):
    """`done` of `total` bakes came before this target's."""
    clock = Stopwatch()
    prepare_uv(task, target, whole)
    with parts.as_object(task, target, whole) as ob:
        image = cycles.new_float_image("rnmbake bake", target["width"], target["height"])
        materials = give_normal_map(ob, image, target["tangent_layer"], task.request["correct_bump"])
        prepare = clock.lap()
        for number, request in enumerate(target["bakes"]):
            task.progress("bake", f"{target['label']} {request['basis']}", done + number, total, done + number + 1,
                          cycles.samples_of_picture(scene, target["width"], target["height"]))
            for material in materials:
                material.show_vector(request["direction"])
            cycles.bake_diffuse(scene, ob)
            cycles.save_pixels(image, task.path(request["pixels"]))
        for material in materials:
            material.restore()
        bpy.data.images.remove(image)
    return {"prepare_seconds": prepare, "bake_seconds": clock.lap()}


def prepare_uv(task, target, ob):
    """The bake writes through the ACTIVE layer; textures keep reading through the active-render one."""
    layers = ob.data.uv_layers
    if "uv_array" in target:
        layer = layers.get("Lightmap") or layers.new(name="Lightmap", do_init=False)
        with open(task.path(target["uv_array"]), "rb") as stream:
            uv = read_floats(stream, 2 * len(ob.data.loops))
        layer.data.foreach_set("uv", uv)
        layers.active = layer
        return
    layer = layers.get(target["uv_layer"])
    if layer is None:
        raise Refusal(f"object '{ob.name}' has no UV layer '{target['uv_layer']}' of its own: a modifier makes it;"
                      " apply that modifier, or bake with --recipe receiver", object_name=ob.name)
    layers.active = layer


class NormalMapped:
    """A material of the target whose shading normal is one vector for the time of a bake."""

    def __init__(self, slot, image, tangent_layer, correct_bump):
        self._slot = slot
        self._original = slot.material
        self.material = slot.material.copy() if slot.material else new_diffuse("rnmbake default", NO_MATERIAL)
        slot.material = self.material
        if not self.material.use_nodes:  # Cycles shows its colour
            make_diffuse(self.material, self.material.diffuse_color[:3])
        if correct_bump:
            _turn_correction_off(self.material)
        self._maps = [_connect(tree, tangent_layer) for tree in _trees_with_normals(self.material.node_tree)]
        nodes = self.material.node_tree.nodes
        texture = nodes.new("ShaderNodeTexImage")
        texture.image = image
        nodes.active = texture

    def show_vector(self, direction):
        color = [0.5 * c + 0.5 for c in direction] + [1]
        for normal_map in self._maps:
            normal_map.inputs["Color"].default_value = color

    def restore(self):
        self._slot.material = self._original
        bpy.data.materials.remove(self.material)


def give_normal_map(ob, image, tangent_layer, correct_bump):
    if not ob.material_slots:
        ob.data.materials.append(None)
    for slot in ob.material_slots:  # other objects may share the mesh and its materials
        material, slot.link = slot.material, "OBJECT"
        slot.material = material
    return [NormalMapped(slot, image, tangent_layer, correct_bump) for slot in ob.material_slots]


def _turn_correction_off(material):
    """Bump shadowing can be turned off from 4.2 on."""
    for owner in (material, material.cycles):
        if hasattr(owner, "use_bump_map_correction"):
            owner.use_bump_map_correction = False


def _trees_with_normals(tree):
    """The tree itself and private copies of the groups in it, if a shader in them takes a normal."""
    trees = []
    for node in tree.nodes:
        if node.type == "GROUP" and node.node_tree:
            node.node_tree = node.node_tree.copy()
            trees += _trees_with_normals(node.node_tree)
    if any(_takes_normal(node) for node in tree.nodes):
        trees.append(tree)
    return trees


def _takes_normal(node):
    return "Normal" in node.inputs and any(out.type == "SHADER" for out in node.outputs)


def _connect(tree, tangent_layer):
    """Feed one Normal Map node to every shader of the tree, in place of what fed their normals."""
    normal_map = tree.nodes.new("ShaderNodeNormalMap")
    normal_map.space = "TANGENT"
    normal_map.uv_map = tangent_layer
    normal_map.inputs["Strength"].default_value = 1
    for node in tree.nodes:
        if _takes_normal(node):
            tree.links.new(normal_map.outputs["Normal"], node.inputs["Normal"])
    return normal_map
