"""Every file that the open scene reads, so that somebody can tell whether one of them is newer than what was baked.

Rather one too many than one too few: files of other scenes in the same .blend are listed, too.
"""
import glob
import os

import bpy

from opening.caches import cache_path
from scene_ops.files import absolute, frame_files, picture_files


def scene_inputs():
    """[{"kind", "path", "there"}], a path once, the scene itself not among them."""
    found = {}
    for list_files in (_libraries, _pictures, _volumes, _fonts, _caches, _named_by_nodes):
        for kind, path in list_files():
            found.setdefault(path, kind)
    return [entry(kind, path) for path, kind in found.items()]


def entry(kind, path):
    name = os.fsencode(path).decode("utf-8", "replace")  # JSON knows no other bytes
    return {"kind": kind, "path": name, "there": os.path.exists(path)}


def _libraries():
    for library in bpy.data.libraries:
        if not library.packed_file:
            path = bpy.path.abspath(library.filepath, library=library.parent)
            yield "library", os.path.abspath(path)


def _pictures():
    users = _image_users()
    for image in bpy.data.images:
        for user in users.get(image, [None]) if image.users else []:
            for path in picture_files(image, user):
                yield "picture", path


def _image_users():
    """{image: what says which frame of it is shown}."""
    users = {}
    owners = [node for tree in _trees() for node in tree.nodes] + list(bpy.data.textures)
    for owner in owners:
        image, user = getattr(owner, "image", None), getattr(owner, "image_user", None)
        if image and user:
            users.setdefault(image, []).append(user)
    return users


def _trees():
    yield from bpy.data.node_groups
    for kind in (bpy.data.materials, bpy.data.worlds, bpy.data.lights, bpy.data.textures):
        yield from (block.node_tree for block in kind if block.node_tree)


def _volumes():
    for volume in bpy.data.volumes:
        if volume.filepath and not volume.packed_file and volume.users:
            if volume.is_sequence:
                volume.grids.load()
            yield "volume", absolute(volume.grids.frame_filepath or volume.filepath, volume)


def _fonts():
    for font in bpy.data.fonts:
        if font.users and not font.packed_file and font.filepath != "<builtin>":
            yield "font", absolute(font.filepath, font)


def _caches():
    frame = bpy.context.scene.frame_current
    for cache in bpy.data.cache_files:
        if cache.users:
            yield "cache", absolute(cache.filepath, cache)
    for ob in bpy.data.objects:
        for modifier in ob.modifiers:
            path = cache_path(modifier)
            path = path and absolute(path, ob)
            if path and os.path.isdir(path):
                yield from (("cache", file) for file in frame_files(path, frame))
            elif path:
                yield "cache", path
    beside = os.path.splitext(bpy.data.filepath)[0]  # where Blender keeps disk caches of points
    folder = os.path.join(os.path.dirname(beside), "blendcache_" + os.path.basename(beside))
    for path in sorted(glob.glob(os.path.join(glob.escape(folder), f"*_{frame:06d}_*.bphys"))):
        yield "cache", path


def _named_by_nodes():
    """Profiles of lamps, and shader programs."""
    kinds = {"TEX_IES": "light profile", "SCRIPT": "script"}
    for tree in _trees():
        for node in tree.nodes:
            if node.type in kinds and node.mode == "EXTERNAL" and node.filepath:
                yield kinds[node.type], absolute(node.filepath, tree)
