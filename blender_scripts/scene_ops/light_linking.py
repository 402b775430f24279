"""Light linking (Blender 4.0 and later): a light may name a collection of what it lights.

An object is concerned by being in such collections, so whatever stands for it has to be in them too, in the same
way (included or excluded).
"""
import bpy


def memberships(ob):
    """[(collection, "INCLUDE" or "EXCLUDE")] of the collections by which lights choose, for those that hold `ob`."""
    found = []
    for collection in _choosing_collections():
        entries = [*zip(collection.children, collection.collection_children),
                   *zip(collection.objects, collection.collection_objects)]
        for held, entry in entries:
            if held == ob or (isinstance(held, bpy.types.Collection) and ob.name in held.all_objects):
                found.append((collection, entry.light_linking.link_state))
    return found


def _choosing_collections():
    lights = [ob for ob in bpy.data.objects if hasattr(ob, "light_linking")]
    chosen = {ob.light_linking.receiver_collection for ob in lights if ob.light_linking.receiver_collection}
    return sorted(chosen, key=lambda collection: collection.name_full)


def light_group(ob):
    """The same text for objects that the same lights light by choice; "" where no light chooses."""
    return "|".join(f"{collection.name_full}:{state}" for collection, state in memberships(ob))


def follow(stand_in, original):
    """Put a stand-in into the collections that hold the original."""
    for collection, state in memberships(original):
        collection.objects.link(stand_in)
        collection.collection_objects[-1].light_linking.link_state = state
