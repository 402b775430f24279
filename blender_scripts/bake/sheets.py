"""Sheets: one picture each, with the receivers over it, baked pass by pass."""
import bpy

from core.stopwatch import Stopwatch
from bake import mirrors, receivers
from scene_ops import cycles


class Sheet:
    """Receivers are built once for all passes, and again only where some are left out of the next one."""

    def __init__(self, task, scene, request):
        self._task, self._scene, self._request = task, scene, request
        self._material, self._image, self._meshes, self._left_out = None, None, None, frozenset()
        self.clock, self.prepare_seconds, self.bake_seconds, self.save_seconds = Stopwatch(), 0, 0, 0

    @property
    def texels(self):
        return self._request["covered_texels"]

    def bake(self, part, file, left_out, tell):
        """One pass into `file`. `tell`: told of each step with the share of the pass that lies before it and after."""
        self.clock.lap()
        self._begin(frozenset(left_out))
        pixels = self._pixels(part, tell)
        cycles.write_pixels(pixels, self._task.path(file))
        self.save_seconds += self.clock.lap()

    def _pixels(self, part, tell):
        return self._bake_groups(cycles.bake_diffuse, part, tell)

    def _bake_groups(self, bake, part, tell):
        """RGBA of all receivers, a group after the other."""
        groups = len(self._meshes)
        samples = cycles.samples_of_picture(self._scene, *self._size, part["count"])
        for number, (mesh, light_group) in enumerate(self._meshes):
            mesh.materials.clear()
            pair = receivers.make_receiver(self._scene, mesh, self._material, light_group)
            self.prepare_seconds += self.clock.lap()
            tell("bake", number / groups, (number + 1) / groups, samples)
            bake(self._scene, pair[0], clear=number == 0)
            self.bake_seconds += self.clock.lap()
            receivers.take_away(pair)
        return cycles.read_pixels(self._image)

    def timings(self):
        return {"prepare_seconds": self.prepare_seconds, "bake_seconds": self.bake_seconds,
                "save_seconds": self.save_seconds}

    _new_material = staticmethod(receivers.make_material)

    @property
    def _size(self):
        return self._request["width"], self._request["height"]

    def _begin(self, left_out):
        if self._image is None:
            self._image = cycles.new_float_image("rnmbake atlas", *self._size)
            self._material = self._new_material(self._image)
        if self._meshes is None or left_out != self._left_out:
            self._build(left_out)

    def _build(self, left_out):
        for mesh, _ in self._meshes or []:
            bpy.data.meshes.remove(mesh)
        self._meshes, self._left_out = [], left_out
        with open(self._task.path(self._request["arrays"]), "rb") as stream:
            for group in self._request["groups"]:
                parts = [(corners, rect not in left_out) for rect, corners in group["parts"]]
                mesh = receivers.build_mesh("rnmbake receiver", stream, parts)
                if mesh.loops:
                    self._meshes.append((mesh, group["light_group"]))


class MirrorSheet(Sheet):
    """Mirrors show what arrives along a ray, less what it meets at once: that is all they show where nothing bounces."""

    _new_material = staticmethod(mirrors.make_material)

    def _pixels(self, part, tell):
        everything = self._bake_groups(cycles.bake_glossy, part, tell)
        rects = {rect for group in self._request["groups"] for rect, _ in group["parts"]}
        lit = rects & set(self._task.request["meets_light"])
        if not lit:
            return everything
        if lit != rects:
            self._build(self._left_out | (rects - lit))
        settings = self._scene.cycles
        bounces = settings.max_bounces
        cycles.set_bounces(settings, 0)
        met_at_once = self._bake_groups(cycles.bake_glossy, part, lambda *event: None)
        cycles.set_bounces(settings, bounces)
        return mirrors.take_off(everything, met_at_once)
