"""Names of instances, without Blender: scene_ops/keys.py against the plain rule, and its cost.

    python3 tests/scripts/keys_check.py
"""
import pathlib
import sys
import types
import unittest

sys.modules["bpy"] = types.SimpleNamespace(types=types.SimpleNamespace(Mesh=object))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "blender_scripts"))
from scene_ops.keys import Keys  # noqa: E402


class Thing(dict):
    def __init__(self, name, type="MESH"):
        super().__init__()
        self.name = self.name_full = name
        self.type = type
        self.original = self


def placed(name, by=None):
    return types.SimpleNamespace(object=Thing(name), is_instance=by is not None, persistent_id=(0, 0),
                                 parent=types.SimpleNamespace(original=Thing(by)) if by else None)


def plain_rule(key, is_instance, given):
    if not is_instance and key not in given:
        return key
    number = 0
    while f"{key}#{number}" in given:
        number += 1
    return f"{key}#{number}"


class Counted(set):
    looks = 0

    def __contains__(self, key):
        self.looks += 1
        return super().__contains__(key)


class KeysTest(unittest.TestCase):
    def test_are_those_of_the_plain_rule(self):
        things = [("a", None), ("a#1", None), ("a", None), ("a", None), ("b", "host"), ("b", "host"), ("host/b#2", None),
                  ("b", "host"), ("b", "other"), ("a", None), ("b", "host")]
        keys, given = Keys(), set()
        for name, by in things:
            expected = plain_rule(f"{by}/{name}" if by else name, by is not None, given)
            given.add(expected)
            self.assertEqual(keys.new(placed(name, by)), expected)

    def test_cost_grows_with_the_number_of_instances(self):
        keys = Keys()
        keys._given = Counted()
        for _ in range(1000):
            keys.new(placed("leaf", "lawn"))
        self.assertLess(keys._given.looks, 3000)  # counting from 0: half a million


if __name__ == "__main__":
    unittest.main()
