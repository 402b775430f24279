"""Times what blender_scripts/ does with the arrays of a real launch, step by step.

    blender -b --python receiver_arrays.py -- LAUNCH_FOLDER ANSWER.json
"""
import json
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../blender_scripts"))
sys.dont_write_bytecode = True

from bake import receivers  # noqa: E402


def timed(function, spent):
    def wrapper(*arguments):
        start = time.process_time()
        try:
            return function(*arguments)
        finally:
            spent.append(time.process_time() - start)
    return wrapper


def main(folder, answer):
    normals = []
    receivers._set_normals = timed(receivers._set_normals, normals)
    with open(os.path.join(folder, "request.json"), encoding="utf-8") as stream:
        request = json.load(stream)
    corners, whole = 0, 0
    for atlas in request["atlases"]:
        with open(os.path.join(folder, atlas["arrays"]), "rb") as stream:
            for group in atlas["groups"]:
                start = time.process_time()
                receivers.build_mesh("receiver", stream, [(group["corners"], True)])
                whole += time.process_time() - start
                corners += group["corners"]
    steps = {"build": whole - sum(normals), "normals": sum(normals)}
    with open(answer, "w", encoding="utf-8") as stream:
        json.dump({"steps": steps, "triangles": corners // 3}, stream)


main(*sys.argv[-2:])
