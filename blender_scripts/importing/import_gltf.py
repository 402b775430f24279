"""glTF by Blender's own importer, which gets a checked and rewritten JSON, and what it made put right."""
import json
import os
import sys

import bpy

from core.gltf_check import DEEPEST
from core.gltf_file import BrokenGltf
from core.gltf_open import open_gltf
from core.task import ENVIRONMENT, Refusal
from importing import gltf_lamps, gltf_materials
from importing.importers import run_importer
from opening.inputs import entry

PREPARED = "prepared.gltf"


def import_gltf(task):
    """Returns what the user should be warned of, and the files that the glTF names."""
    path = task.request["scene"]
    mend_numpy()
    if not hasattr(bpy.types, "IMPORT_SCENE_OT_gltf"):
        raise Refusal(f"{path}: this Blender has no glTF importer (add-on io_scene_gltf2); install it, or "
                      "save the scene as .blend", ENVIRONMENT)
    try:
        gltf, notes = open_gltf(path, importer_knows)
    except BrokenGltf as error:
        raise Refusal(f"{path}: {error}", error.code) from error
    files = [entry(kind, file) for kind, file in gltf.files()]
    with open(task.path(PREPARED), "w", encoding="utf-8") as stream:
        json.dump(gltf.json, stream)
    sys.setrecursionlimit(max(sys.getrecursionlimit(), 4 * DEEPEST))  # it calls itself for every level of nodes
    run_importer("glTF", path, lambda: bpy.ops.import_scene.gltf(filepath=task.path(PREPARED)))
    return notes + gltf_lamps.put_right(gltf) + gltf_materials.put_right(gltf), files


def importer_knows(extension):
    """Whether the importer's source names the extension."""
    if extension == "KHR_draco_mesh_compression":
        return has_draco()
    import io_scene_gltf2
    root = os.path.dirname(io_scene_gltf2.__file__)
    folders = [os.path.join(root, folder) for folder in ("blender/imp", "io/imp")]
    return any(extension in code for folder in folders for code in sources(folder))


def sources(folder):
    for name in sorted(os.listdir(folder)):
        if name.endswith(".py"):
            with open(os.path.join(folder, name), encoding="utf-8") as stream:
                yield stream.read()


def has_draco():
    """Its library is a file of its own, which Linux distributions leave out."""
    try:
        from io_scene_gltf2.io.com import gltf2_io_draco_compression_extension as draco
        return draco.dll_exists(quiet=True)
    except ImportError:
        return False


def mend_numpy():
    """The importer of Blender 3.x uses numpy.bool and its kin, which numpy 1.24 took away."""
    try:
        import numpy
    except ImportError as error:
        raise Refusal("the glTF importer needs numpy, which this Blender's Python does not have; install it "
                      "(Debian: python3-numpy), or save the scene as .blend", ENVIRONMENT) from error
    for name, builtin in (("bool", bool), ("int", int), ("float", float), ("object", object), ("str", str)):
        if name not in numpy.__dict__:
            setattr(numpy, name, builtin)
