"""The files that simulations were baked to, and that animate meshes."""
import os

import bpy


def missing_caches():
    """Missing files of baked simulations and of mesh animations. Objects without them stay in their rest pose."""
    for cache in bpy.data.cache_files:
        if cache.users and not os.path.exists(bpy.path.abspath(cache.filepath, library=cache.library)):
            yield f"cache file missing: {cache.filepath}"
    for ob in bpy.data.objects:
        for modifier in ob.modifiers:
            path = cache_path(modifier)
            if path and not ob.hide_render and not os.path.exists(bpy.path.abspath(path, library=ob.library)):
                yield f"object '{ob.name}': the cache of its modifier '{modifier.name}' is missing: {path}"


def cache_path(modifier):
    """Path of the files without which the modifier has no effect; "" for other modifiers."""
    if not modifier.show_render:
        return ""
    if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN":
        return modifier.domain_settings.cache_directory
    if modifier.type == "MESH_CACHE":
        return modifier.filepath
    if modifier.type == "OCEAN" and modifier.is_cached:
        return modifier.filepath
    cache = getattr(modifier, "point_cache", None)
    return cache.filepath if cache and cache.use_external else ""
