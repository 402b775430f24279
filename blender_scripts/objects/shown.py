"""Surfaces and lights of a render, out of the dependency graph: meshes, materials, matrices, properties for Cycles."""
import bpy

from objects.instance_values import InstanceValues
from objects.mesh_copy import copy_mesh
from scene_ops import light_linking
from scene_ops.keys import NAME_PROPERTY, Keys, instancer_of, shown_surfaces
from scene_ops.render_depsgraph import with_render_depsgraph

# What Cycles reads of an object beside its geometry; owners and names differ between versions.
FLAGS = ("pass_index", "color", "shadow_terminator_normal_offset", "shadow_terminator_geometry_offset",
         "shadow_terminator_shading_offset")
CYCLES_FLAGS = ("shadow_terminator_offset", "shadow_terminator_geometry_offset", "is_caustics_caster",
                "is_caustics_receiver", "use_camera_cull", "use_distance_cull", "ao_distance")
FACELESS = ("LIGHT", "VOLUME", "POINTCLOUD", "CURVES", "HAIR")


class Shown:
    """An object or instance of a render, with the properties of an equal plain object. Of an instance Cycles reads some
    from the object, some from its instancer (`owner`), some from both."""

    def __init__(self, instance, name, choices):
        ob, owner = instance.object, (instance.parent if instance.is_instance else None) or instance.object
        self.name, self.type = name, ob.type
        self.original, self.owner = ob.original, owner.original
        self.plain_name = self.original.get(NAME_PROPERTY, self.original.name)
        self.is_instance, self.is_copy = instance.is_instance, bool(instancer_of(instance))
        self.matrix = instance.matrix_world.copy()
        self.flags = {flag: _plain(getattr(ob, flag)) for flag in FLAGS if hasattr(ob, flag)}
        self.flags.update(_seen_by(ob, owner))
        self.flags["is_shadow_catcher"] = ob.is_shadow_catcher or owner.is_shadow_catcher
        self.flags["lightgroup"] = ob.lightgroup or owner.lightgroup
        self.cycles_flags = {flag: getattr(ob.cycles, flag) for flag in CYCLES_FLAGS if hasattr(ob.cycles, flag)}
        self.chosen = light_linking.chosen_by(self.original)
        self.memberships = {membership for role in light_linking.ROLES
                            for membership in choices.memberships(role, self.original, self.owner)}
        self.values = {}  # objects/instance_values.py
        self.data = None  # a mesh or a light; None for a copy of the original
        self.materials = []
        self.object = None  # its stand-in


def _plain(value):
    return value if isinstance(value, (bool, int, float)) else tuple(value)


def _seen_by(ob, owner):
    """Ray visibility and holdout. The view layer's flags on collections count for the instancer."""
    names = [name for name in dir(ob) if name.startswith("visible_") and isinstance(getattr(ob, name), bool)]
    seen = {name: getattr(ob, name) and getattr(owner, name) for name in names}
    layer, placing = bpy.context.view_layer, owner.original
    seen["is_holdout"] = placing.holdout_get(view_layer=layer)
    if not seen["is_holdout"] and placing.indirect_only_get(view_layer=layer):
        seen["visible_camera"] = False
    return seen


class Found:
    def __init__(self):
        self.surfaces, self.others = [], []  # Shown

    def __iter__(self):
        yield from self.surfaces
        yield from self.others


def collect(is_wanted=None):
    """A Shown for all that a render shows: surfaces, with meshes as evaluated, and others (FACELESS), without data.

    Or for the surfaces that is_wanted(key, instance) and all else that their objects make. Objects that share evaluated
    data share the mesh.
    """
    found, values, choices = Found(), InstanceValues(), light_linking.Choices()

    def visit(depsgraph):
        owners = is_wanted and _owners(depsgraph, is_wanted)
        found.surfaces = list(_surfaces(depsgraph, owners, values, choices))
        found.others = list(_others(depsgraph, owners, choices))
    with_render_depsgraph(visit)
    return found


def _owners(depsgraph, is_wanted):
    names, owners = Keys(), set()
    for instance in shown_surfaces(depsgraph):
        if is_wanted(names.new(instance), instance):
            owners.add(owner_of(instance))
    return owners


def _surfaces(depsgraph, owners, values, choices):
    names, meshes = Keys(), {}
    for instance in shown_surfaces(depsgraph):
        key, evaluated = names.new(instance), instance.object
        if owners is not None and owner_of(instance) not in owners:
            continue
        shared = evaluated.data.as_pointer()
        if shared not in meshes:
            meshes[shared] = copy_mesh(evaluated)
        item = Shown(instance, key, choices)
        item.data, item.values = meshes[shared], values.of(instance)
        item.materials = [slot.material.original if slot.material else None for slot in evaluated.material_slots]
        yield item


def _others(depsgraph, owners, choices):
    for instance in depsgraph.object_instances:
        if instance.show_self and instance.object.type in FACELESS and (owners is None or owner_of(instance) in owners):
            yield Shown(instance, instance.object.original.name, choices)


def owner_of(instance):
    """The object that would have to go with it: what makes the instance, or the object itself."""
    return (instance.parent if instancer_of(instance) else instance.object).original
