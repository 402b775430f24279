"""True displacement: Cycles moves a surface's vertices as it loads a scene, where no survey sees them.

So Cycles is asked where they go, by a bake of positions at the vertices, and the object gets that shape for good.
"""
from array import array
from contextlib import contextmanager

import bpy
from mathutils import Vector

from core.task import Refusal
from scene_ops import texture_space
from scene_ops.bench import bench
from scene_ops.describe_nodes import active_output
from scene_ops.keys import shown_surfaces
from scene_ops.render_depsgraph import with_render_depsgraph

ATTRIBUTE = "rnmbake displaced"


def settle():
    """Call before anything is surveyed or baked. Returns what the user should be told, a line each."""
    displacing = {material for material in bpy.data.materials if method(material) != "BUMP"}
    if not displacing:
        return []
    found = {}
    with_render_depsgraph(lambda depsgraph: _find(depsgraph, displacing, found))
    with bench() as stand:
        for ob, (mesh, _) in found.items():
            _reshape(ob, mesh, _displaced(stand, ob, mesh))
    told = [_told(ob, materials) for ob, (_, materials) in found.items()]
    for material in {material for _, materials in found.values() for material in materials}:
        _disconnect(material)
    return told


def method(material):
    """BUMP, DISPLACEMENT or BOTH: what Cycles does with the material."""
    owner = material if hasattr(material, "displacement_method") else material.cycles  # before 4.1
    output = active_output(material)
    return owner.displacement_method if output and output.inputs["Displacement"].is_linked else "BUMP"


def _find(depsgraph, displacing, found):
    """Fill `found`: an object's mesh as it is evaluated, and the materials that displace it."""
    makers = {other.parent.original for other in depsgraph.object_instances if other.is_instance and other.parent}
    for instance in shown_surfaces(depsgraph):
        ob = instance.object
        materials = [slot.material.original for slot in ob.material_slots if slot.material]
        materials = [material for material in materials if material in displacing]
        if not materials or ob.original in found:
            continue
        _refuse_what_cannot_be_reshaped(ob.original, materials[0], makers)
        mesh = bpy.data.meshes.new_from_object(ob, preserve_all_data_layers=True, depsgraph=depsgraph)
        texture_space.keep(mesh, ob.original.data)
        found[ob.original] = mesh, materials


def _refuse_what_cannot_be_reshaped(ob, material, makers):
    reasons = {"it is no mesh": ob.type != "MESH", "it comes from a linked file": ob.library or material.library,
               "instances or particles hang on it": ob in makers or ob.particle_systems}
    why = next((reason for reason, holds in reasons.items() if holds), None)
    if why:
        raise Refusal(f"object '{ob.name}': material '{material.name}' displaces it as it renders, which is not "
                      f"followed since {why}; give it that shape by a Displace modifier, or set the material's "
                      "Settings > Surface > Displacement to Bump Only", object_name=ob.name)


def _displaced(stand, ob, mesh):
    """Positions of the vertices as displaced by Cycles, object space."""
    colors = mesh.color_attributes.new(ATTRIBUTE, "FLOAT_COLOR", "CORNER")
    mesh.color_attributes.active_color = colors
    stand.scene.cycles.samples = 1  # Cycles adds positions up
    with _bare(ob, mesh), stand.holding(ob):
        outcome = bpy.ops.object.bake(type="POSITION", target="VERTEX_COLORS", save_mode="INTERNAL")
        if outcome != {"FINISHED"}:
            raise Refusal(f"Blender cancelled the bake of the displaced shape of '{ob.name}'", object_name=ob.name)
        to_local = ob.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.inverted()
    colors = mesh.color_attributes[ATTRIBUTE]
    world = array("f", bytes(16 * len(mesh.loops)))
    colors.data.foreach_get("color", world)
    mesh.color_attributes.remove(colors)
    places = array("f", bytes(12 * len(mesh.vertices)))
    mesh.vertices.foreach_get("co", places)  # of vertices without faces
    corners = array("i", bytes(4 * len(mesh.loops)))
    mesh.loops.foreach_get("vertex_index", corners)
    for corner, vertex in enumerate(corners):
        places[3 * vertex:3 * vertex + 3] = array("f", to_local @ Vector(world[4 * corner:4 * corner + 3]))
    return places


@contextmanager
def _bare(ob, mesh):
    """The object with the evaluated mesh and no modifiers, shown to the camera."""
    shown = {"visible_camera": True, "is_holdout": False, "is_shadow_catcher": False, "hide_render": False}
    before = {name: getattr(ob, name) for name in shown}
    ob.modifiers.clear()
    ob.data = mesh
    for name, value in shown.items():
        setattr(ob, name, value)
    yield
    for name, value in before.items():
        setattr(ob, name, value)


def _reshape(ob, mesh, places):
    """Move the vertices by a shape key, which keeps generated texture coordinates."""
    ob.shape_key_add(name="rnmbake as modelled", from_mix=False)
    key = ob.shape_key_add(name="rnmbake displaced", from_mix=False)
    key.data.foreach_set("co", places)
    key.value, ob.show_only_shape_key = 1, False
    mesh.update()


def _disconnect(material):
    socket = active_output(material).inputs["Displacement"]
    for link in list(socket.links):
        material.node_tree.links.remove(link)


def _told(ob, materials):
    rest = ", without the bump that is left of it" if any(method(material) == "BOTH" for material in materials) else ""
    return f"object '{ob.name}': material '{materials[0].name}' displaces it as it renders; it is baked in that shape" \
           f"{rest}, which your engine's mesh needs, too"
