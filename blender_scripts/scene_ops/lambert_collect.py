"""All that a render of the scene shows, taken out of the dependency graph: meshes, materials, places, lights."""
import bpy

from scene_ops.instance_values import attributes_by_host, values_of
from scene_ops.keys import Keys, instancer_of, shown_surfaces
from scene_ops.survey import with_render_depsgraph

# What Cycles reads of an object beside its geometry; owners and names differ between versions.
FLAGS = ("is_shadow_catcher", "is_holdout", "pass_index", "color",
         "shadow_terminator_normal_offset", "shadow_terminator_geometry_offset",
         "shadow_terminator_shading_offset")
CYCLES_FLAGS = ("shadow_terminator_offset", "shadow_terminator_geometry_offset", "is_caustics_caster",
                "is_caustics_receiver")
KEPT_TYPES = {"VOLUME", "POINTCLOUD", "CURVES", "HAIR"}  # no surfaces that could be baked


class Shown:
    """One thing that a render shows, as an object of its own would have to be."""

    def __init__(self, instance, name):
        ob, owner = instance.object, instance.parent if instance.is_instance else None
        self.name = name
        self.plain_name = ob.original.name
        self.original = ob.original
        self.owner = owner.original if owner else ob.original
        self.is_copy = bool(instancer_of(instance))
        self.matrix = instance.matrix_world.copy()
        self.visible = ray_visibility(ob, owner)
        self.flags = {flag: plain(getattr(ob, flag)) for flag in FLAGS if hasattr(ob, flag)}
        self._ask_collections()
        self.cycles_flags = {flag: getattr(ob.cycles, flag) for flag in CYCLES_FLAGS if hasattr(ob.cycles, flag)}
        self.linking = light_linking(self.owner) or light_linking(self.original)
        self.values = {}  # scene_ops/instance_values.py
        self.data = None  # a mesh or a light
        self.materials = []
        self.object = None  # what stands for it in the new scene

    def _ask_collections(self):
        """The view layer's own flags on collections, which the new scene does not have."""
        layer = bpy.context.view_layer
        if self.owner.indirect_only_get(view_layer=layer):
            self.visible["visible_camera"] = False
        if self.owner.holdout_get(view_layer=layer):
            self.flags["is_holdout"] = True


class Scene:
    def __init__(self):
        self.surfaces, self.lights, self.kept, self.warnings = [], [], [], []
        self.outside = []  # OutsideModel of scene/exchange.h, of what has no surface


def plain(value):
    return value if isinstance(value, (bool, int, float)) else tuple(value)


def ray_visibility(ob, owner):
    """Cycles shows an instance to the rays that both it and what places it are visible to."""
    names = [name for name in dir(ob) if name.startswith("visible_") and isinstance(getattr(ob, name), bool)]
    return {name: getattr(ob, name) and (owner is None or getattr(owner, name)) for name in names}


def light_linking(ob):
    """The light-linking collections of an object by role; Blender has them from 4.0 on."""
    linking = getattr(ob, "light_linking", None)
    if linking is None:
        return {}
    roles = {role: getattr(linking, role) for role in ("receiver_collection", "blocker_collection")}
    return {role: collection for role, collection in roles.items() if collection}


def collect():
    scene, by_host = Scene(), attributes_by_host()
    with_render_depsgraph(lambda depsgraph: _visit(depsgraph, scene, by_host))
    return scene


def _visit(depsgraph, scene, by_host):
    names, meshes = Keys(), {}
    for instance in shown_surfaces(depsgraph):
        surface = Shown(instance, names.new(instance))
        evaluated = instance.object
        shared = evaluated.data.as_pointer()
        if shared not in meshes:
            meshes[shared] = copy_mesh(evaluated)
        surface.data = meshes[shared]
        surface.values = values_of(instance, by_host)
        surface.materials = [_original(slot.material) for slot in evaluated.material_slots]
        scene.surfaces.append(surface)
    for instance in depsgraph.object_instances:
        if instance.show_self:
            _add_other(instance, scene)


def copy_mesh(ob):
    mesh = bpy.data.meshes.new_from_object(ob)
    if ob.original.type == "META":  # their normals are the field's own and get lost in a copy
        if hasattr(mesh, "use_auto_smooth"):  # <= 4.0
            mesh.use_auto_smooth = True
            ob.data.calc_normals_split()
            normals = [tuple(loop.normal) for loop in ob.data.loops]
        else:
            normals = [tuple(corner.vector) for corner in ob.data.corner_normals]
        mesh.normals_split_custom_set(normals)
    return mesh


def _add_other(instance, scene):
    ob = instance.object
    if ob.type == "LIGHT":
        light = Shown(instance, ob.original.name)
        light.data = ob.original.data
        scene.lights.append(light)
    elif ob.type in KEPT_TYPES:
        _add_kept(instance, scene)
    if not instance.is_instance and any(system.settings.type == "HAIR" and system.settings.render_type == "PATH"
                                        for system in ob.particle_systems):
        scene.outside.append({"owner": f"object '{ob.original.name}'", "what": ["hair"]})
        scene.warnings.append(f"{ob.original.name}: its hair is left out with --materials lambert")


def _add_kept(instance, scene):
    ob, what = instance.object.original, instance.object.type.lower()
    owner = f"object '{ob.name}'"
    if not instance.is_instance:
        scene.kept.append(ob)
        scene.outside.append({"owner": owner, "what": [what], "untraced": [what]})
        scene.warnings.append(f"{ob.name}: {what} keeps its material; only surfaces become lambert")
    elif not any(other["owner"] == owner for other in scene.outside):
        scene.outside.append({"owner": owner, "what": [what]})
        scene.warnings.append(f"{ob.name}: instances of {what} are left out with --materials lambert")


def _original(material):
    return material.original if material else None
