"""Light linking (Blender 4.0 and later): a light may name a collection of what it lights, and one of what blocks it.

An object is concerned by being in such collections, so whatever stands for it has to be in them too, in the same
way (included or excluded). For an instance they are those that hold its instancer, or else its object's.
"""
import json

import bpy

ROLES = ("receiver_collection", "blocker_collection")


class Choices:
    """Collections of light linking, with their members, as evaluated now."""

    def __init__(self):
        self._states = {role: [(collection, _states_in(collection)) for collection in _collections(role)]
                        for role in ROLES}

    def memberships(self, role, ob, owner=None):
        """[(collection, "INCLUDE" or "EXCLUDE")] that count for `ob`, which `owner` places if it is an instance."""
        def holding(held):
            return [(collection, states[held]) for collection, states in self._states[role] if held in states]
        return (owner and holding(owner)) or holding(ob)

    def light_group(self, ob, owner=None):
        """Key of the lights that are linked to an object, the same for equal sets; "" for none. join_group() reads it."""
        found = [[collection.name_full, state] for collection, state in self.memberships(ROLES[0], ob, owner)]
        return json.dumps(found) if found else ""


def _collections(role):
    linkings = [ob.light_linking for ob in bpy.data.objects if hasattr(ob, "light_linking")]
    chosen = {getattr(linking, role) for linking in linkings} - {None}
    return sorted(chosen, key=lambda collection: collection.name_full)


def _states_in(collection):
    states = {ob: entry.light_linking.link_state
              for child, entry in zip(collection.children, collection.collection_children) for ob in child.all_objects}
    states.update((ob, entry.light_linking.link_state)
                  for ob, entry in zip(collection.objects, collection.collection_objects))
    return states


def chosen_by(ob):
    """{role: collection} that a light or what glows names itself. What places an instance names nothing for it."""
    linking = getattr(ob, "light_linking", None)
    named = {role: getattr(linking, role) for role in ROLES} if linking else {}
    return {role: collection for role, collection in named.items() if collection}


def join(ob, collection, state):
    if ob.name not in collection.objects:
        collection.objects.link(ob)
        collection.collection_objects[-1].light_linking.link_state = state


def join_group(ob, light_group):
    """`light_group`: what Choices say of the one that `ob` stands for."""
    collections = {collection.name_full: collection for collection in bpy.data.collections} if light_group else {}
    for name, state in json.loads(light_group or "[]"):
        join(ob, collections[name], state)


def block(ob):
    """Have a stand-in stop light for every light, also where that chooses what blocks it."""
    for collection in _collections("blocker_collection"):
        if leaves_out(collection):
            collection.objects.link(ob)


def leaves_out(collection):
    """Whether it excludes all objects but those that it includes."""
    return any(entry.light_linking.link_state == "INCLUDE"
               for entry in [*collection.collection_objects, *collection.collection_children])
