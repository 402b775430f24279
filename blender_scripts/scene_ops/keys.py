"""Names for everything that a render shows: the same in every launch, since the order of a depsgraph is."""


class Keys:
    def __init__(self):
        self._given = set()

    def new(self, instance):
        """The object's name; instancer/name#n for instances, and wherever a library repeats a name."""
        original = instance.object.original
        instancer = instancer_of(instance)
        key = f"{instancer}/{original.name_full}" if instancer else original.name
        if instancer or key in self._given:
            number = 0
            while f"{key}#{number}" in self._given:
                number += 1
            key = f"{key}#{number}"
        self._given.add(key)
        return key


def instancer_of(instance):
    return instance.parent.original.name_full if instance.is_instance and instance.parent else ""
