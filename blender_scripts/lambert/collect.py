"""All that a render of the scene shows, for a lambert scene: surfaces, lights, and what has no surface."""
from objects import shown


class Scene:
    def __init__(self):
        found = shown.collect()
        self.surfaces, self.lights, self.kept, self.warnings = found.surfaces, [], [], []
        self.outside = []  # OutsideModel of scene/diffuse_scene.h, of what has no surface
        for item in found.others:
            if item.type == "LIGHT":
                item.data = item.original.data
                self.lights.append(item)
            else:
                self._keep(item)
        for ob in dict.fromkeys(item.original for item in found.surfaces if not item.is_copy):
            self._leave_hair(ob)

    def _keep(self, item):
        ob, what = item.original, item.type.lower()
        owner = f"object '{ob.name}'"
        if not item.is_instance:
            self.kept.append(ob)
            self.outside.append({"owner": owner, "what": [what], "untraced": [what]})
            self.warnings.append(f"{ob.name}: {what} keeps its material; only surfaces become diffuse")
        elif not any(other["owner"] == owner for other in self.outside):
            self.outside.append({"owner": owner, "what": [what]})
            self.warnings.append(f"{ob.name}: instances of {what} are left out of a scene of diffuse surfaces")

    def _leave_hair(self, ob):
        if any(system.settings.type == "HAIR" and system.settings.render_type == "PATH" for system in ob.particle_systems):
            self.outside.append({"owner": f"object '{ob.name}'", "what": ["hair"]})
            self.warnings.append(f"{ob.name}: its hair is left out of a scene of diffuse surfaces")
