"""Light linking (Blender 4.0 and later): a light may name a collection of what it lights.

An object is concerned by being in such collections, so whatever stands for it has to be in them too, in the same
way (included or excluded).
"""
import bpy


def block(ob):
    """Have a stand-in stop light for every light, also where that chooses what blocks it."""
    for collection in _collections("blocker_collection"):
        if any(entry.light_linking.link_state == "INCLUDE"
               for entry in [*collection.collection_objects, *collection.collection_children]):
            collection.objects.link(ob)


def memberships(ob):
    """[(collection, "INCLUDE" or "EXCLUDE")] of the collections by which lights choose, for those that hold `ob`."""
    found = []
    for collection in _collections("receiver_collection"):
        entries = [*zip(collection.children, collection.collection_children),
                   *zip(collection.objects, collection.collection_objects)]
        for held, entry in entries:
            if held == ob or (isinstance(held, bpy.types.Collection) and ob.name in held.all_objects):
                found.append((collection, entry.light_linking.link_state))
    return found


def _collections(kind):
    """By which lights choose: what they light ("receiver_collection") or what blocks them."""
    linkings = [ob.light_linking for ob in bpy.data.objects if hasattr(ob, "light_linking")]
    chosen = {getattr(linking, kind) for linking in linkings} - {None}
    return sorted(chosen, key=lambda collection: collection.name_full)


def light_group(ob):
    """The same text for objects that the same lights light by choice; "" where no light chooses."""
    return "|".join(f"{collection.name_full}:{state}" for collection, state in memberships(ob))


def follow(stand_in, original):
    """Put a stand-in into the collections that hold the original."""
    for collection, state in memberships(original):
        collection.objects.link(stand_in)
        collection.collection_objects[-1].light_linking.link_state = state
