"""What recipe gather must know of a scene (src/pipeline/gather): what mirrors would not see as receivers do, and what rays
may meet that the survey does not hold.

A mirror's ray is a glossy one, a receiver's a diffuse one; all that comes after is the same.
"""
from scene_ops.describe_nodes import reachable_nodes
from scene_ops.see_through import has_transparency, surface_nodes

# Light Path outputs that are the same for a mirror's ray and a receiver's.
SAME = {"Is Camera Ray", "Is Shadow Ray", "Is Transmission Ray", "Is Volume Scatter Ray", "Ray Length", "Ray Depth",
        "Transparent Depth", "Transmission Depth", "Portal Depth"}
CAUSTICS = {"glossy", "metallic", "glass", "transmission", "coat"}  # what Cycles' switches for caustics are about
BEYOND = {"CURVES", "POINTCLOUD", "VOLUME", "HAIR"}  # objects that the survey has no shapes of


def is_even(material, info):
    """Whether what the material reflects is the same to all who see one side of it, and nothing shines through. `info`: of
    describe_material()."""
    if info["outside_model"] or info["normal_mapped"] or has_transparency(material):
        return False
    return not any(node.type == "LIGHT_PATH" for node in surface_nodes(material))


class GatherNotes:
    def __init__(self):
        self._refused, self._unshared = {}, {}  # reason -> names of those that it is about

    def visit(self, depsgraph):
        for instance in depsgraph.object_instances:
            if instance.show_self:
                self._look_at(instance.object)

    def _look_at(self, ob):
        name = ob.original.name
        if ob.type in BEYOND:
            self._note(self._unshared, "hair, curves, points or volumes", name)
        if any(system.settings.type == "HAIR" and system.settings.render_type == "PATH"
               for system in getattr(ob, "particle_systems", ())):
            self._note(self._unshared, "hair", name)
        if ob.type not in {"MESH", "CURVE", "SURFACE", "FONT", "META"}:
            return
        if ob.visible_diffuse != ob.visible_glossy:
            self._note(self._refused, "Ray Visibility of diffuse and of glossy rays differs, and mirrors send glossy ones", name)
        if ob.is_holdout or ob.is_shadow_catcher:
            self._note(self._unshared, "holdout or shadow catcher", name)

    def finish(self, scene, infos):
        """`infos`: material -> describe_material(), of all that are shown."""
        for material, info in infos.items():
            if "volume" in info["outside_model"]:
                self._note(self._unshared, "a volume", material.name)
            self._look_at_nodes(material.name, surface_nodes(material), SAME)
        world = scene.world
        if world and world.use_nodes and world.node_tree:
            output = world.node_tree.get_output_node("CYCLES")
            if output and output.inputs["Volume"].is_linked:
                self._note(self._unshared, "a volume", world.name)
            self._look_at_nodes(world.name, reachable_nodes(output.inputs["Surface"]) if output else (),
                                SAME | {"Is Diffuse Ray", "Is Glossy Ray", "Is Singular Ray", "Is Reflection Ray"})
        cycles = scene.cycles
        if not (cycles.caustics_reflective and cycles.caustics_refractive):
            for material, info in infos.items():
                if CAUSTICS.intersection(info["outside_model"]):
                    self._note(self._refused, "caustics are off, which mirrors would not know", material.name)
        return {"refused": list(_lines(self._refused)), "unshared": list(_lines(self._unshared))}

    def _look_at_nodes(self, name, nodes, same):
        for node in nodes:
            if node.type == "LIGHT_PATH" and any(out.is_linked and out.name not in same for out in node.outputs):
                self._note(self._refused, "its nodes ask for the kind of a ray (Light Path)", name)

    @staticmethod
    def _note(where, reason, name):
        names = where.setdefault(reason, [])
        if name not in names:
            names.append(name)


def _lines(notes):
    for reason, names in notes.items():
        more = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
        yield f"'{names[0]}'{more}: {reason}"
