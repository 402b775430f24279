"""A flat scene: one plain object for each thing that a render shows, under the name that it had."""
import bpy

from scene_ops.keys import KEY_PROPERTY, NAME_PROPERTY
from scene_ops.names import fitting

# These use objects without depending on where they are.
CONTAINERS = (bpy.types.Collection, bpy.types.Scene, bpy.types.Screen, bpy.types.WorkSpace, bpy.types.WindowManager)


def rebuild(shown):
    """Link a plain object for every surface and light, and nothing else but camera, volumes and hair."""
    scene, everything = bpy.context.scene, shown.surfaces + shown.lights
    scene.background_set = None  # its surfaces and lights are among the others
    for ob in {item.original for item in everything}:
        if not ob.library:
            ob.name = "rnmbake original"
    camera = scene.camera
    _empty(scene.collection)
    pivot = bpy.data.objects.new("rnmbake pivot", None)
    for ob in [pivot, *shown.kept, *([camera] if camera else [])]:
        scene.collection.objects.link(ob)
    for item in everything:
        item.object = _make_object(item, pivot)
        scene.collection.objects.link(item.object)
    for surface in shown.surfaces:
        _keep_key(surface)
    _relink_lights(everything)


def _empty(collection):
    for child in list(collection.children):
        collection.children.unlink(child)
    for ob in list(collection.objects):
        collection.objects.unlink(ob)


def _make_object(item, pivot):
    """Its place is the inverse of a parent's: unlike location, rotation and scale it can hold any matrix."""
    ob = bpy.data.objects.new(free_name(item.name), item.data)
    ob.parent = pivot
    ob.matrix_parent_inverse = item.matrix
    for name, value in {**item.visible, **item.flags}.items():
        setattr(ob, name, value)
    for name, value in item.cycles_flags.items():
        setattr(ob.cycles, name, value)
    for name, value in item.values.items():
        ob[name] = value
    return ob


def free_name(name):
    """The name itself, or with a hash where it is longer than names can be. What else has it gives way."""
    name = fitting(name)
    other = next((ob for ob in bpy.data.objects if ob.name == name and not ob.library), None) \
        if name in bpy.data.objects else None
    if other is not None:
        other.name = "rnmbake other"
    return name


def _keep_key(surface):
    """Lightmaps are named, and objects chosen, as in the user's own scene."""
    surface.object[KEY_PROPERTY] = surface.name
    if not surface.linking:  # those with light linking are looked up by name when they are baked
        surface.object[NAME_PROPERTY] = surface.plain_name


def _relink_lights(everything):
    """Light-linking collections list the originals; these list what stands for them."""
    standing, made = {}, {}
    for item in everything:
        for ob in {item.original, item.owner}:
            standing.setdefault(ob, []).append(item.object)
    for item in everything:
        for role, collection in item.linking.items():
            if collection not in made:
                made[collection] = _stand_in(collection, standing)
            setattr(item.object.light_linking, role, made[collection])


def _stand_in(collection, standing):
    copy = bpy.data.collections.new(collection.name)
    states = {ob: entry.light_linking.link_state
              for child, entry in zip(collection.children, collection.collection_children)
              for ob in child.all_objects}
    states.update({ob: entry.light_linking.link_state
                   for ob, entry in zip(collection.objects, collection.collection_objects)})
    for original, state in states.items():
        for ob in standing.get(original, []):
            if ob.name not in copy.objects:
                copy.objects.link(ob)
                copy.collection_objects[-1].light_linking.link_state = state
    return copy


def drop_originals(shown):
    """Nothing unlinked is saved; what a driver or a parent refers to must be."""
    originals = {item.original for item in shown.surfaces + shown.lights}
    waiting = {user for user in _dependants(originals)}
    for ob in waiting:
        ob.use_fake_user = True


def _dependants(originals):
    """Those of the originals that something beyond them, or one that is kept, refers to."""
    users = bpy.data.user_map(subset=originals)
    kept, grown = set(), True
    while grown:
        grown = False
        for ob in originals - kept:
            if any(user in kept or not (user in originals or isinstance(user, CONTAINERS))
                   for user in users.get(ob, ())):
                kept.add(ob)
                grown = True
    return kept
