"""Blender runs this, without a scene, to make a .blend of a glTF or OBJ file: what all later launches open."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from core.task import run  # noqa: E402
from importing.import_scene import import_scene  # noqa: E402


def main(task):
    return import_scene(task)


run(main)
