"""Write the saved scene (saved/saved_scene.py) as a .glb with its lightmaps.

Request: "objects": [{"object", "key", "page", "scale", "offset"}], where a lightmap's UV times scale plus offset is its place on
a page (of UVs as Blender has them, v upwards); "pages": PNG files, which go into the .glb; "intensity": what their values
are to be multiplied by to be irradiance; "record": JSON that is handed on as it is (docs/deliver.md); "lights": whether the file is to
have the scene's lamps; "save_as": the file.
"""
import importlib.util
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from deliver import glb_file, materials, place_uvs  # noqa: E402
from opening import load  # noqa: E402

NODE_PROPERTY = "rnmbake_lightmap"  # on an object, in a node's extras: index into the request's objects


def main(task):
    request = task.request
    require_exporter()
    load.open_scene(task)
    for index, placed in enumerate(request["objects"]):
        ob = bpy.context.scene.objects[placed["object"]]
        place_uvs.place(ob, placed["scale"], placed["offset"])
        ob[NODE_PROPERTY] = index
    objects = [bpy.context.scene.objects[placed["object"]] for placed in request["objects"]]
    notes = materials.settle(objects)
    plain = task.path("plain.glb")
    export(plain, request, with_tangents=materials.have_normal_maps(objects))
    glb = glb_file.Glb.read(plain)
    nodes = glb_file.add_lightmaps(glb, request, NODE_PROPERTY)
    glb.write(request["save_as"])
    return {"nodes": nodes, "notes": notes}


def require_exporter():
    for module, remedy in (("io_scene_gltf2", "install Blender's add-on io_scene_gltf2"),
                           ("numpy", f"install numpy for the Python in {sys.prefix} (Debian: python3-numpy)")):
        if importlib.util.find_spec(module) is None:
            raise core_task.Refusal(f"this Blender cannot write glTF: {module} is missing; {remedy}", core_task.ENVIRONMENT)


def export(path, request, with_tangents):
    """Blender's own exporter; what it says goes to the launch's log."""
    wanted = {"filepath": path, "export_format": "GLB", "check_existing": False, "use_renderable": True,
              "use_active_scene": True, "export_apply": True, "export_cameras": True,
              "export_lights": request["lights"], "export_extras": True, "export_tangents": with_tangents, "export_animations": False,
              "convert_lighting_mode": "SPEC", "export_import_convert_lighting_mode": "SPEC"}  # before and since 3.6
    known = bpy.ops.export_scene.gltf.get_rna_type().properties.keys()
    bpy.ops.export_scene.gltf(**{name: value for name, value in wanted.items() if name in known})


core_task.run(main)
