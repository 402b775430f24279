"""Objects and instances of a render, with keys: the same in every launch, as the order of a depsgraph is."""
import bpy

NO_ID = 0x7fffffff  # Blender's padding of persistent_id

# On objects that stand for a surface of the user's scene (stand_ins.py): its key and name there.
KEY_PROPERTY, NAME_PROPERTY = "rnmbake key", "rnmbake name"
LABEL_PROPERTY = "rnmbake material"  # on materials, likewise
CAMERA_PROPERTY = "rnmbake camera"  # on lambert scenes: what the camera of the user's scene sees


def shown_surfaces(depsgraph):
    """Every instance with faces that a render depsgraph shows, as Cycles picks them.

    Curves, texts and metaballs appear twice: as themselves, and as an instance that holds their mesh.
    An instance is valid until the next one is asked for.
    """
    for instance in depsgraph.object_instances:
        if instance.show_self and isinstance(instance.object.data, bpy.types.Mesh):
            yield instance


class Keys:
    def __init__(self):
        self._given = set()
        self._next = {}  # number to try first for each key: counting up from 0 each time would take for ever

    def new(self, instance):
        """The object's name; instancer/name#n for instances, and wherever a library repeats a name."""
        original = instance.object.original
        instancer = instancer_of(instance)
        own = original.get(KEY_PROPERTY, original.name)  # a copy that the user made of such an object has it, too
        key = f"{instancer}/{original.name_full}" if instancer else own
        if instancer or key in self._given:
            number = self._next.get(key, 0)
            while f"{key}#{number}" in self._given:
                number += 1
            self._next[key] = number + 1
            key = f"{key}#{number}"
        self._given.add(key)
        return key


def instancer_of(instance):
    """The object that places this one; "" for one that stands for itself, or is the mesh of a curve or text."""
    if not instance.is_instance or instance.parent is None:
        return ""
    original = instance.object.original
    own_mesh = instance.parent.original == original and instance.persistent_id[1] == NO_ID
    return "" if own_mesh and original.type != "MESH" else instance.parent.original.name_full


def material_name(material):
    """Unique among the file's materials: the plain name, with the library's file for a linked one.

    A lambert material goes by the name of the one that it stands for.
    """
    return material.original.get(LABEL_PROPERTY, material.original.name_full) if material else ""
