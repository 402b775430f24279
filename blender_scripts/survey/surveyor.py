"""The scene of a render as plain data: docs/survey-format.md."""
import json
import math
import sys

import bpy

from core.task import Refusal
from scene_ops.describe import describe_light, describe_material, describe_probe_place, describe_world
from scene_ops.keys import NAME_PROPERTY, Keys, instancer_of, material_name, shown_surfaces
from scene_ops.light_linking import Choices
from scene_ops.render_depsgraph import with_render_depsgraph
from survey.digest import SceneDigest
from survey.gather import GatherNotes, is_even
from survey.mesh_file import MeshFile

FORMAT = 1


FACELESS = ("VOLUME", "CURVES", "POINTCLOUD")  # objects that have no lightmap but may glow


class Surveyor:
    """Walks a render depsgraph once and keeps strings and numbers only: nothing of Blender's outlives a step."""

    def __init__(self, task):
        self.task = task
        self.meshes = MeshFile(task.path("survey.bin"))
        self.objects, self.lights, self.probe_places, self.warnings = [], [], [], []
        self.material_names = set()
        self.gather = GatherNotes()
        self._keys, self._choices = Keys(), Choices()

    def visit(self, depsgraph):
        for instance in depsgraph.object_instances:
            if not instance.show_self:
                continue
            if instance.object.type == "LIGHT":
                self.lights.append(describe_light(instance.object, instance.matrix_world))
            elif instance.object.type in FACELESS:
                self.material_names.update(slot_names(instance.object))
            elif place := describe_probe_place(instance.object, instance.matrix_world):
                self.probe_places.append(place)
        for instance in shown_surfaces(depsgraph):
            self.add_surface(instance, instance.object)
        self.gather.visit(depsgraph)

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
            "visible_to_bounces": bool(ob.visible_diffuse),
        })


def slot_names(ob):
    return [material_name(slot.material) for slot in ob.material_slots]


class DigestSurveyor(Surveyor):
    """Takes the digest of the scene as well."""

    def __init__(self, task):
        super().__init__(task)
        self.digest = SceneDigest(self.meshes)

    def visit(self, depsgraph):
        super().visit(depsgraph)
        self.digest.visit(depsgraph)


def survey_scene(task, surveyor=None):
    surveyor = surveyor or Surveyor(task)
    scene = bpy.context.scene
    with_render_depsgraph(surveyor.visit)
    surveyor.finish()
    materials = {material: describe_material(material) for material in bpy.data.materials
                 if material_name(material) in surveyor.material_names}
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
        "materials": {material_name(material): {**info, "even": is_even(material, info)}
                      for material, info in materials.items()},
        "lights": surveyor.lights,
        "probe_places": surveyor.probe_places,
        "world": describe_world(scene.world),
        "gather": surveyor.gather.finish(scene, materials),
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
