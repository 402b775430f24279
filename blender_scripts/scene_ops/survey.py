"""What Blender would render, as plain data: docs/survey-format.md.

Render visibility, render levels of modifiers and the instances of a final render exist only in the
dependency graph that Blender builds for a render engine. So the survey is a render engine: one tiny render
in which every object is read and not a pixel drawn.
"""
import json
import math
import sys

import bpy

from core.task import Refusal
from scene_ops.describe import describe_light, describe_material, describe_world
from scene_ops.keys import LABEL_PROPERTY, NAME_PROPERTY, Keys, instancer_of, shown_surfaces
from scene_ops.light_linking import Choices
from scene_ops.survey_mesh import MeshFile

FORMAT = 1


class SurveyEngine(bpy.types.RenderEngine):
    bl_idname = "RNMBAKE_SURVEY"
    bl_label = "rnmbake survey"
    bl_use_preview = False
    visit = None
    visited = False
    error = None

    def render(self, depsgraph):
        cls = SurveyEngine
        if cls.visited:
            return
        cls.visited = True
        try:
            cls.visit(depsgraph)
        except BaseException as error:  # Blender prints what is raised in here and goes on
            cls.error = error


def with_render_depsgraph(visit):
    """Call visit(depsgraph) with the graph of a final render of the current view layer."""
    SurveyEngine.visit, SurveyEngine.visited, SurveyEngine.error = staticmethod(visit), False, None
    if not SurveyEngine.is_registered:
        bpy.utils.register_class(SurveyEngine)
    prepare_render(bpy.context.scene)
    bpy.ops.render.render()
    if SurveyEngine.error:
        raise SurveyEngine.error
    if not SurveyEngine.visited:
        raise RuntimeError("Blender rendered without calling the survey engine")


def prepare_render(scene):
    """The smallest render that reaches the engine, of the view layer that a bake would use."""
    render = scene.render
    render.engine = SurveyEngine.bl_idname
    render.resolution_x = render.resolution_y = 8
    render.resolution_percentage = 100
    for name in ("use_compositing", "use_sequencer", "use_border", "use_freestyle", "use_multiview",
                 "use_motion_blur", "use_persistent_data", "use_simplify", "use_single_layer"):
        if hasattr(render, name):
            setattr(render, name, False)
    for layer in scene.view_layers:
        layer.use = layer.name == bpy.context.view_layer.name
    if scene.camera is None:
        camera = bpy.data.objects.new("rnmbake survey", bpy.data.cameras.new("rnmbake survey"))
        scene.collection.objects.link(camera)
        scene.camera = camera


FACELESS = ("VOLUME", "CURVES", "POINTCLOUD")  # objects that have no lightmap but may glow


class Surveyor:
    """Walks a render depsgraph once and keeps strings and numbers only: nothing of Blender's outlives a step."""

    def __init__(self, task):
        self.task = task
        self.meshes = MeshFile(task.path("survey.bin"))
        self.objects, self.lights, self.warnings = [], [], []
        self.material_names = set()
        self._keys, self._choices = Keys(), Choices()

    def visit(self, depsgraph):
        for instance in depsgraph.object_instances:
            if not instance.show_self:
                continue
            if instance.object.type == "LIGHT":
                self.lights.append(describe_light(instance.object, instance.matrix_world))
            elif instance.object.type in FACELESS:
                self.material_names.update(slot_names(instance.object))
        for instance in shown_surfaces(depsgraph):
            self.add_surface(instance, instance.object)

    def finish(self):
        """After the visit; the file is complete then."""
        self.meshes.close()

    def add_surface(self, instance, ob):
        original = ob.original
        self.task.progress("evaluate", original.name, len(self.objects))
        slots = slot_names(ob)
        self.material_names.update(name for name in slots if name)
        matrix = [value for row in instance.matrix_world for value in row]
        if not all(map(math.isfinite, matrix)):
            raise Refusal(f"object {original.name!r}: its place, rotation or scale is not a number; reset its "
                          "transform in Blender", object_name=original.name)
        self.objects.append({
            "key": self._keys.new(instance),
            "name": original.get(NAME_PROPERTY, original.name),
            "instancer": instancer_of(instance),
            "type": original.type,
            "mesh": self.meshes.add(ob.data),
            "matrix": matrix,
            "slots": slots,
            "light_group": self._choices.light_group(original, instance.parent and instance.parent.original),
            "visible_to_camera": bool(ob.visible_camera),
        })


def slot_names(ob):
    return [material_name(slot.material) for slot in ob.material_slots]


def material_name(material):
    """Unique among the file's materials: the plain name, with the library's file for a linked one.

    A lambert material goes by the name of the one that it stands for.
    """
    return material.original.get(LABEL_PROPERTY, material.original.name_full) if material else ""


def survey_scene(task, surveyor=None):
    surveyor = surveyor or Surveyor(task)
    scene = bpy.context.scene
    with_render_depsgraph(surveyor.visit)
    surveyor.finish()
    wanted = [material for material in bpy.data.materials if material_name(material) in surveyor.material_names]
    return {
        "format": FORMAT,
        "byte_order": sys.byteorder,
        "scene_file": task.request["scene"],
        "scene_name": scene.name,
        "view_layer": bpy.context.view_layer.name,
        "blender_version": bpy.app.version_string,
        "data": "survey.bin",
        "data_bytes": surveyor.meshes.bytes_written,
        "meshes": surveyor.meshes.entries,
        "objects": surveyor.objects,
        "materials": {material_name(material): describe_material(material) for material in wanted},
        "lights": surveyor.lights,
        "world": describe_world(scene.world),
        "warnings": surveyor.warnings,
    }


def volume_warnings(survey):
    """One line for each material with a volume: Cycles' bakes begin outside of every object. Clouds have no key."""
    for name, about in survey["materials"].items():
        if "volume" in about["outside_model"]:
            owner = next((f"{entry['key']}: " for entry in survey["objects"] if name in entry["slots"]), "")
            yield f"{owner}material '{name}' has a volume; what lies inside is baked as if it lay outside, its first light " \
                  "undimmed; a medium around everything is better given to the world"


def write_survey(task, survey):
    with open(task.path("survey.json"), "w", encoding="utf-8") as stream:
        json.dump(survey, stream, ensure_ascii=True)
    return "survey.json"
