"""A flat scene: one plain object for each thing that a render shows, under the name that it had."""
import bpy

from objects import stand_ins
from scene_ops import light_linking

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
    for ob in [*shown.kept, *([camera] if camera else [])]:
        scene.collection.objects.link(ob)
    for item in everything:
        stand_ins.hang(stand_ins.make(item, stand_ins.free_name(item.name)), item.matrix)
    for surface in shown.surfaces:
        stand_ins.keep_key(surface.object, surface.name, surface.plain_name)
    _link_lights(everything)


def _empty(collection):
    for child in list(collection.children):
        collection.children.unlink(child)
    for ob in list(collection.objects):
        collection.objects.unlink(ob)


def _link_lights(everything):
    """By collections of their own: those of the scene list the originals. One that includes anything goes on to leave out
    all else, whatever of it is still shown."""
    own, nothing = {}, bpy.data.objects.new("rnmbake nothing", None)

    def counterpart(collection):
        if collection not in own:
            own[collection] = bpy.data.collections.new(collection.name)
            if light_linking.leaves_out(collection):
                light_linking.join(nothing, own[collection], "INCLUDE")
        return own[collection]
    stand_ins.link_lights(everything, counterpart)


def drop_originals(shown):
    """Nothing unlinked is saved; what a driver or a parent refers to must be."""
    originals = {item.original for item in shown.surfaces + shown.lights}
    waiting = {user for user in _dependants(originals)}
    for ob in waiting:
        ob.use_fake_user = True


def _dependants(originals):
    """Originals that other data, or a kept original, refers to."""
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
