"""The user's scene with an object for every lightmap: with the very faces that were baked, its lightmap's UVs in the
second layer, and the name that it had.

What can stay as it is does. A mesh of which modifiers make other faces becomes a plain one in place: name, parent,
animation, collections and all else are kept. Instances, curves, texts and metaballs get a plain object in their place.
"""
from array import array

import bpy

from core.arrays import read_floats
from core.task import Refusal
from objects import realize, shown, stand_ins
from saved import uv_order
from saved.kept_settings import kept_settings
from scene_ops.keys import NAME_PROPERTY, instancer_of

MADE = ("modifiers[", "particle_systems[")  # how paths to what makes faces begin


class Entry:
    """An object that has lightmaps, as the request names it."""

    def __init__(self, task, request):
        self.key, self.layer, self.uv_array = request["key"], request["uv_layer"], request.get("uv_array")
        self.uv_path = task.path(self.uv_array) if self.uv_array else None
        with open(task.path(request["faces"]), "rb") as stream:
            self._faces = stream.read()
        self.object = None  # in the saved scene
        self.alone = False  # no instance

    @property
    def uvs(self):
        """Key of the UVs: entries with the same key can share a mesh."""
        return self.uv_array, self.layer

    def can_stay(self, instance):
        """Finds the entry's object; says whether that can hold the lightmap's UVs where they belong."""
        self.object, self.alone = instance.object.original, not instancer_of(instance)
        if self.object.type != "MESH":
            return False
        mesh = self.object.data
        if self.uv_array:
            return self.alone and faces_of(mesh) == self._faces
        return self.is_settled(mesh) or (self.layer in mesh.uv_layers and (self.alone or not mesh.library))

    def is_settled(self, mesh):
        return not self.uv_array and mesh.uv_layers.find(self.layer) == uv_order.LIGHTMAP_INDEX

    def settle(self, mesh):
        """Writes what was unwrapped, and moves the layer to its place."""
        layers, was_bare = mesh.uv_layers, not mesh.uv_layers
        if self.uv_array:
            layer = layers.get(self.layer) or layers.new(name=self.layer, do_init=False)
            with open(self.uv_path, "rb") as stream:
                uv_order.write(layer, read_floats(stream, 2 * len(mesh.loops)))
        uv_order.put_second(mesh, self.layer)
        if was_bare:
            layers[0].active_render = True


def faces_of(mesh):
    """As src/pipeline/scene/save_scene.cpp has them: the vertex of each corner, then the first corner of each polygon."""
    corners, starts = array("i", bytes(4 * len(mesh.loops))), array("i", bytes(4 * len(mesh.polygons)))
    mesh.loops.foreach_get("vertex_index", corners)
    mesh.polygons.foreach_get("loop_start", starts)
    return corners.tobytes() + starts.tobytes()


def settle(task):
    """Bring the open scene into that form. Returns {key: {"object", "uv_index", "plain"}}."""
    entries = {request["key"]: Entry(task, request) for request in task.request["objects"]}
    with kept_settings():
        items = list(shown.collect(lambda key, instance: key in entries and not entries[key].can_stay(instance)))
    missing = sorted(key for key, entry in entries.items() if entry.object is None)
    if missing:
        raise Refusal(f"'{missing[0]}' was there when the scene was surveyed and is gone now")
    plain = replace(items)
    for key in entries.keys() & plain.keys():
        entries[key].object, entries[key].alone = plain[key], True
    give_uvs(entries.values())
    return {key: {"object": entry.object.name, "uv_index": entry.object.data.uv_layers.find(entry.layer),
                  "plain": key in plain} for key, entry in entries.items()}


def replace(items):
    """Returns what now stands for each, by key."""
    stand_ins.answer_instances(items)
    in_place = [item for item in items if not item.is_copy and item.original.type == "MESH"]
    others = [item for item in items if item not in in_place]
    instancers = {item.owner for item in others if item.is_copy} - {item.original for item in in_place}
    objects = {item.name: become_plain(item) for item in in_place}
    for owner in map(made_local, instancers):
        owner.hide_render = owner.type != "EMPTY"  # it was not shown itself, or gives way below
        stop_making(owner)
    for item in others:
        ob = stand_ins.put(item) if item.is_copy else take_over(item)
        if item.data:
            objects[item.name] = ob
            stand_ins.keep_key(ob, item.name, item.plain_name)
    stand_ins.link_lights(others)
    return objects


def become_plain(item):
    """The object itself, with the faces that its modifiers made."""
    ob = made_local(item.original)
    stop_making(ob)
    item.data.name = ob.data.name
    ob.data = item.data
    stand_ins.give_materials(ob, item.materials)
    if ob.parent_type in ("ARMATURE", "LATTICE"):
        ob.parent_type = "OBJECT"  # these faces are deformed already
    stand_ins.keep_key(ob, item.name, item.plain_name)
    return ob


def stop_making(ob):
    """No instances, modifiers and particles any more."""
    leave_scene(realize.stop_instancing(ob))
    ob.modifiers.clear()
    drivers = ob.animation_data.drivers if ob.animation_data else []
    for driver in [driver for driver in drivers if driver.data_path.startswith(MADE)]:
        drivers.remove(driver)


def take_over(item):
    """A mesh object in the place of a curve, a text or a metaball."""
    source = made_local(item.original)
    name, places = source.name, collections_of(source)
    leaving = family(source) if source.type == "META" else [source]
    source.name = "rnmbake source"  # stays in the file only where something still needs it
    ob = stand_ins.put(item)
    ob.name = name
    for collection in places:
        if collection != bpy.context.scene.collection:
            collection.objects.link(ob)
    if places and bpy.context.scene.collection not in places:
        bpy.context.scene.collection.objects.unlink(ob)
    bpy.context.view_layer.update()
    for child in [child for child in source.children if child.parent_type == "OBJECT" and not child.library]:
        world = child.matrix_world.copy()
        child.parent = ob
        child.matrix_world = world
    leave_scene(leaving)
    return ob


def family(ball):
    """Metaballs whose names differ in their number alone melt into one surface."""
    def stem(ob):
        head, dot, number = ob.name.rpartition(".")
        return head if dot and number.isdigit() else ob.name
    return [ob for ob in bpy.context.scene.objects if ob.type == "META" and stem(ob) == stem(ball)]


def leave_scene(objects):
    for ob in objects:
        for collection in collections_of(ob):
            collection.objects.unlink(ob)


def collections_of(ob):
    """Collections of the scene that hold it and are not linked from a library."""
    scene = bpy.context.scene
    return [collection for collection in (scene.collection, *scene.collection.children_recursive)
            if not collection.library and any(held == ob for held in collection.objects)]


def made_local(ob):
    """The object, or a local one in a linked one's place: what is linked cannot be changed for good."""
    if ob.library:
        for collection in bpy.context.scene.collection.children_recursive:
            if collection.library and any(held == ob for held in collection.all_objects):
                collection.make_local()
    return ob.make_local() if ob.library or ob.override_library else ob


def give_uvs(entries):
    """Objects that share a mesh go on sharing it where their UVs are the same."""
    sharing = {}
    for entry in entries:
        sharing.setdefault(entry.object.data, {}).setdefault(entry.uvs, []).append(entry)
    for mesh, by_uvs in sharing.items():
        groups = sorted(by_uvs.values(), key=lambda group: group[0].is_settled(mesh))
        keeps_mesh = groups[-1] if not mesh.library or groups[-1][0].is_settled(mesh) else None
        for group in groups:  # the one that keeps the mesh comes last: the copies are of what it was
            settled = mesh if group is keeps_mesh else mesh.copy()
            group[0].settle(settled)
            for entry in group:
                hand(entry, settled)


def hand(entry, mesh):
    if entry.object.data == mesh:
        return
    plain_name = entry.object.get(NAME_PROPERTY, entry.object.name)
    entry.object = made_local(entry.object)
    entry.object.data = mesh
    if entry.alone:
        stand_ins.keep_key(entry.object, entry.key, plain_name)
