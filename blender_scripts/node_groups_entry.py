"""Save a .blend of node groups that decode lightmaps (nodes/decoders.py), to link or to append.

Request: "encodings": names of those whose groups are wanted, "save_as": the file.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from nodes.decoders import DECODERS  # noqa: E402
from scene_ops import saving  # noqa: E402


def main(task):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    encodings = task.request["encodings"]
    groups = {}
    for number, encoding in enumerate(encodings):
        task.progress("build", encoding, number, len(encodings), number + 1)
        groups[encoding] = DECODERS[encoding]()
    task.progress("save")
    saving.save_data(task.request["save_as"], set(groups.values()))
    return {"groups": {encoding: group.name for encoding, group in groups.items()}}


core_task.run(main)
