"""Stops what a .blend that nobody vouched for would do beside its scripts, which Blender itself blocks.

Opening a file evaluates it, and an unbaked simulation then writes its cache, to any path that the file names, or removes
the one that is there. So it is switched off between the reading of the file and its evaluation, and refused in words
where it renders.
"""
import bpy
from bpy.app.handlers import persistent

from core.task import Refusal
from scene_ops.see_through import surface_nodes

stopped = []  # (object, what it would have written), of what renders


def watch():
    bpy.app.handlers.load_post.append(_stop_writers)


@persistent
def _stop_writers(*_):
    stopped.clear()
    for ob in bpy.data.objects:
        for modifier in ob.modifiers:
            what = _written_by(modifier)
            if not what:
                continue
            if modifier.show_render and not ob.hide_render:
                stopped.append((ob.name, what))
            modifier.show_viewport = modifier.show_render = False
    for scene in bpy.data.scenes:
        world = scene.rigidbody_world
        if world and world.enabled and _is_open(world.point_cache):
            stopped.extend((ob.name, "rigid bodies") for ob in getattr(world.collection, "objects", []))
            world.enabled = False


def _written_by(modifier):
    """In a word; "" for a modifier that writes nothing."""
    if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN":
        return "fluid" if _is_replayed(modifier.domain_settings) else ""
    if modifier.type == "DYNAMIC_PAINT" and modifier.canvas_settings:
        caches = [surface.point_cache for surface in modifier.canvas_settings.canvas_surfaces]
    elif modifier.type == "PARTICLE_SYSTEM":
        caches = [modifier.particle_system.point_cache]
    else:
        caches = [cache for cache in [getattr(modifier, "point_cache", None)] if cache]
    return modifier.type.lower().replace("_", " ") if any(map(_is_open, caches)) else ""


def _is_open(cache):
    return cache.use_disk_cache and not cache.is_baked and not cache.use_external


def _is_replayed(domain):
    """Not baked in full: evaluating it simulates."""
    baked = domain.has_cache_baked_any and not domain.is_cache_baking_any
    return domain.cache_type == "REPLAY" or not baked


def refuse_stopped():
    for name, what in stopped:
        raise Refusal(f"object '{name}': its {what} simulation is not baked and keeps a cache on disk, which opening "
                      "the file would write; bake it in Blender (fluids: Type All or Modular), or pass --allow-scripts if "
                      "you trust the file", object_name=name)


def settle_programs(task, scene):
    """Script nodes are programs that come with the file; without them Cycles needs no OSL."""
    if not scene.cycles.shading_system:
        return
    programs = [material.name for material in bpy.data.materials
                if any(node.type == "SCRIPT" for node in surface_nodes(material))]
    scene.cycles.shading_system = bool(programs)
    if programs and not task.request.get("allow_scripts"):
        raise Refusal(f"material '{programs[0]}' runs a program of the file's own (a script node, OSL), which is "
                      "blocked; pass --allow-scripts if you trust the file")
