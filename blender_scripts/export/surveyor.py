"""A survey of a lambert scene with all that a tracer needs beside it: the key "exchange" of survey.json."""
import json

import bpy

from export.looks import Looks, outside_of
from export.world import describe as describe_world
from lambert.notes import OUTSIDE, remembered_camera, remembered_probe_places
from survey.surveyor import Surveyor


def gives_no_light(ob):
    """Whether a lamp lights no diffuse surface. A portal guides the sampling of the world, and emits nothing."""
    return not ob.visible_diffuse or getattr(getattr(ob.data, "cycles", None), "is_portal", False)


class ExportSurveyor(Surveyor):
    def __init__(self, task):
        super().__init__(task)
        self.looks = Looks(self.meshes)
        self.object_looks, self.unlit, self.outside = [], [], []
        self._lights_off = []

    def visit(self, depsgraph):
        for instance in depsgraph.object_instances:
            if instance.show_self and instance.object.type == "LIGHT":
                self._lights_off.append(gives_no_light(instance.object))
        super().visit(depsgraph)

    def add_surface(self, instance, ob):
        super().add_surface(instance, ob)
        entry = self.objects[-1]
        materials = [slot.material.original for slot in ob.material_slots]
        self.object_looks.append([self.looks.add(material, ob.data, entry["mesh"]) for material in materials])
        what = {word for material in materials for word in outside_of(material)}
        what.update(word for flag, word in (("is_holdout", "holdout"), ("is_shadow_catcher", "shadow catcher"))
                    if getattr(ob, flag, False))
        untraced = {"light linking"} if entry["light_group"] else set()
        if not ob.visible_diffuse and not ob.visible_shadow:
            self.unlit.append(len(self.objects) - 1)
        elif not ob.visible_diffuse:
            untraced.add("hidden from diffuse rays")
        elif not ob.visible_shadow:
            untraced.add("casts no shadow")
        self.tell(f"object '{entry['key']}'", what, untraced)

    def tell(self, owner, what, untraced):
        """OutsideModel of scene/diffuse_scene.h. `untraced`: what the lambert scene shows, too."""
        if what or untraced:
            self.outside.append({"owner": owner, "what": sorted({*what, *untraced}), "untraced": sorted(untraced)})

    def finish(self):
        """Complete the file by steps that would change the survey's own renders."""
        scene = bpy.context.scene
        self.lights = [light for light, off in zip(self.lights, self._lights_off) if not off]
        for light in self.lights:
            self.tell(f"light '{light['name']}'", (), light["outside_model"])
        pictures = self.looks.write_pictures()
        world, picture, what = describe_world(self.task, scene, self.meshes)
        if picture:
            world["picture"] = len(pictures)
            pictures.append(picture)
        self.tell("world", (), what)
        self.outside += json.loads(scene.get(OUTSIDE, "[]"))
        self.probe_places = remembered_probe_places(scene)
        camera, note = remembered_camera(scene)
        self.warnings += [note] if note else []
        self.exchange = {
            "pictures": pictures, "picture_uvs": self.looks.picture_uvs, "normal_maps": self.looks.normal_maps,
            "looks": self.looks.looks, "object_looks": self.object_looks, "unlit": self.unlit, "world": world,
            "camera": camera, "outside": self.outside,
        }
        super().finish()
