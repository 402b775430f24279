"""Rewrites a glTF so that Blender's importer, which passes over much, makes of it what it means.

The result refers to the same buffers and pictures. Lights and materials are tagged, so that what only Blender's own
data can express is put right after the import.
"""
import os
from urllib.parse import quote

from core import gltf_extensions
from core.gltf_instances import place_instances
from core.gltf_lights import complete_lights

TAG = "rnmbake gltf"  # in extras: the number of a light or material
CONTENT = ("mesh", "camera", "skin", "weights")
LIGHT, INSTANCES, VISIBILITY = "KHR_lights_punctual", "EXT_mesh_gpu_instancing", "KHR_node_visibility"


def prepare(gltf, importer_knows):
    """Change gltf.json in place; returns what the user should be warned of. `importer_knows`: an extension."""
    notes = gltf_extensions.notes_of(gltf, importer_knows)
    notes += leave_animations(gltf)
    notes += keep_one_scene(gltf)
    notes += complete_lights(gltf)
    notes += place_instances(gltf)
    notes += choose_pictures(gltf)
    notes += tell_of_plain_meshes(gltf)
    if not importer_knows("KHR_draco_mesh_compression"):
        take_uncompressed(gltf)
    gltf.json.pop("extensionsRequired", None)
    refer_from_elsewhere(gltf)
    for kind in (gltf.lights(), gltf.items("materials")):
        for number, entry in enumerate(kind):
            extras = entry.get("extras")
            entry["extras"] = {**(extras if isinstance(extras, dict) else {}), TAG: number}
    return notes


def leave_animations(gltf):
    animations = gltf.json.pop("animations", [])
    if not animations:
        return []
    return [f"glTF animations are not followed ({len(animations)}): the scene is baked as its nodes stand"]


def keep_one_scene(gltf):
    """Empty every node that is hidden, or not in the default scene: the importer shows them all."""
    nodes, scenes = gltf.items("nodes"), gltf.items("scenes")
    chosen = gltf.json.get("scene", 0)
    if scenes:
        work = list(scenes[chosen].get("nodes", ()))
    else:
        below = {child for node in nodes for child in node.get("children", ())}
        work = [number for number in range(len(nodes)) if number not in below]
    shown = set()
    while work:
        number = work.pop()
        if nodes[number].get("extensions", {}).get(VISIBILITY, {}).get("visible", True) is False:
            continue
        shown.add(number)
        work += nodes[number].get("children", ())
    left = sum(empty(node) for number, node in enumerate(nodes) if number not in shown)
    notes = []
    if len(scenes) > 1:
        notes.append(f"it holds {len(scenes)} scenes: {gltf_extensions.owner_of('scenes', chosen, scenes[chosen])} is "
                     "baked")
    if left:
        notes.append(f"nodes that are hidden or not in the scene are left out ({left})")
    return notes


def empty(node):
    """Remove a node's contents; returns whether it had any."""
    there = [key for key in CONTENT if key in node]
    for key in there:
        del node[key]
    extensions = node.get("extensions", {})
    lost = [name for name in (LIGHT, INSTANCES) if name in extensions]
    for name in lost:
        del extensions[name]
    return bool(there or lost)


def choose_pictures(gltf):
    """Pictures of kinds that Blender reads by itself stand in for those that only an extension names."""
    notes = []
    for number, texture in enumerate(gltf.items("textures")):
        extensions = texture.get("extensions", {})
        for name in ("EXT_texture_webp", "MSFT_texture_dds"):
            source = extensions.pop(name, {}).get("source")
            if source is not None:
                texture.setdefault("source", source)
        if "source" not in texture:
            owner = gltf_extensions.owner_of("textures", number, texture)
            notes.append(f"picture unreadable: glTF {owner} has none that Blender reads"
                         f"{gltf_extensions.listed(extensions)}; export it as PNG or JPEG")
    return notes


def tell_of_plain_meshes(gltf):
    shown = {node["mesh"] for node in gltf.items("nodes") if "mesh" in node}
    plain = [gltf_extensions.owner_of("meshes", number, mesh) for number, mesh in enumerate(gltf.items("meshes"))
             if number in shown and any("material" not in primitive for primitive in mesh["primitives"])]
    return [f"without a material and so Blender's grey (0.8): {gltf_extensions.listed(plain)[2:-1]}"] if plain else []


def take_uncompressed(gltf):
    """Where Draco is not required, primitives hold their data a second time, as it is."""
    for mesh in gltf.items("meshes"):
        for primitive in mesh["primitives"]:
            primitive.get("extensions", {}).pop("KHR_draco_mesh_compression", None)


def refer_from_elsewhere(gltf):
    """Absolute paths, so that the JSON may lie in another folder; the buffer of a .glb is a part of that file."""
    buffers = gltf.items("buffers")
    if gltf.binary and buffers and "uri" not in buffers[0]:
        for view in gltf.items("bufferViews"):
            if view["buffer"] == 0:
                view["byteOffset"] = view.get("byteOffset", 0) + gltf.binary[0]
        buffers[0].update(uri=quote(os.path.abspath(gltf.path)), byteLength=sum(gltf.binary))
    for kind in ("buffers", "images"):
        for number, entry in enumerate(gltf.items(kind)):
            uri = entry.get("uri")
            if uri and not uri.startswith("data:") and not os.path.isabs(uri):
                entry["uri"] = quote(gltf.resolve(uri, f"{kind[:-1]} {number}"))
