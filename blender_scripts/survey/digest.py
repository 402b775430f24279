"""The scene digest: fingerprints of all that Cycles could see, a name for each part (docs/survey-format.md).

What a render shows is hashed as it is evaluated. From there a walk follows whatever is pointed to: materials, their
pictures, objects that give coordinates. Each data-block is looked at once.
"""
import bpy

from scene_ops.cycles import FOLLOWED
from scene_ops.files import frame_files, hash_file, absolute
from scene_ops.keys import instancer_of
from survey import content
from survey.rna_walk import Feed, Walker

SHOWN = ("MESH", "CURVE", "SURFACE", "FONT", "META", "LIGHT", "VOLUME", "CURVES", "POINTCLOUD", "HAIR")
KINDS = {"TextCurve": "text", "SurfaceCurve": "surface", "MetaBall": "metaball", "Image": "picture", "NodeTree": "node group",
         "ParticleSettings": "particles", "Curves": "hair curves", "PointCloud": "point cloud", "CacheFile": "cache"}
# Modifiers whose result is more than can be read of it: values of instances, hair, smoke. So what they say counts.
UNREADABLE = ("NODES", "PARTICLE_SYSTEM", "FLUID", "MESH_TO_VOLUME", "VOLUME_DISPLACE")


class SceneDigest:
    def __init__(self, meshes):
        self._meshes = meshes  # MeshFile, which has read every surface
        self._found = {}  # what: fingerprints of all that goes by the name
        self._uses, self._user = {}, None  # what: names of the parts that it points to
        self._seen, self._waiting = set(), []
        self._shown = set()  # names of objects
        self._image_users = {}
        self._asks_camera = self._asks_layer = False
        self._walker = Walker(self._refer, self._look)

    def visit(self, depsgraph):
        """After the MeshFile has got the surfaces that the depsgraph shows."""
        instances = {}
        for instance in depsgraph.object_instances:
            if instance.object.type in SHOWN and (instance.show_self or instance.show_particles):
                self._add_instance(instance, instances, depsgraph)
        for what, placed in instances.items():
            feed = Feed()
            for line in sorted(placed):
                feed.add(line)
            self._put(what, feed)
        scene = depsgraph.scene_eval
        if scene.world:
            self._refer(scene.world)
        self._settle()
        self._add_settings(scene, depsgraph.view_layer_eval)
        self._settle()

    def entries(self):
        joined = []
        for what, hashes in sorted(self._found.items()):
            feed = Feed()
            feed.add(*sorted(hashes))
            joined.append({"what": what, "hash": feed.hexdigest() if len(hashes) > 1 else hashes[0],
                           "uses": sorted(self._uses.get(what, ()))})
        return joined

    def _note_use(self, user, what):
        if user != what:
            self._uses.setdefault(user, set()).add(what)

    def _put(self, what, feed):
        self._found.setdefault(what, []).append(feed.hexdigest())

    def _add_instance(self, instance, instances, depsgraph):
        """An instance's object is Blender's only until the next one is asked for; what it was made from stays."""
        ob = instance.object
        self._user = None
        if instancer := instancer_of(instance):
            self._user = f"instances of '{instancer}'"
            values = [repr(name_of(ob)), instance.persistent_id[0], instance.random_id, *numbers(instance.matrix_world),
                      *instance.orco, *instance.uv, instance.show_self, instance.show_particles]
            instances.setdefault(f"instances of '{instancer}'", []).append(" ".join(map(str, values)))
            self._refer(instance.parent.original.evaluated_get(depsgraph))
        self._refer(ob.original.evaluated_get(depsgraph))
        self._user = None
        self._shown.add(name_of(ob))
        if instance.show_self and isinstance(ob.data, bpy.types.Mesh):
            self._add_mesh(ob)
        elif instance.show_self and ob.type in ("CURVES", "POINTCLOUD"):
            self._add_points(ob)
        self._user = None

    def _refer(self, block):
        """Name of a data-block among the entries; it is looked at later, as evaluated."""
        what = name_of(block)
        if self._user:
            self._note_use(self._user, what)
        key = block.original.as_pointer() if block.original else block.as_pointer()
        if key not in self._seen:
            self._seen.add(key)
            self._waiting.append((what, block))
        return what

    def _settle(self):
        while self._waiting:
            self._user, block = self._waiting.pop()
            feed = Feed()
            self._feed(block, feed)
            self._put(self._user, feed)
        self._user = None

    def _feed(self, block, feed):
        if isinstance(block, bpy.types.NodeTree):
            return self._walker.walk_tree(block, feed)
        if isinstance(block, bpy.types.Object):
            return self._feed_object(block, feed)
        if isinstance(block, bpy.types.Collection):
            return self._feed_collection(block, feed)
        return self._feed_content(block, feed)

    def _feed_content(self, block, feed):
        self._walker.walk(block, feed, block)
        if isinstance(block, bpy.types.Image):
            content.feed_image(block, self._image_users.get(name_of(block)), feed)
        elif isinstance(block, bpy.types.Volume):
            content.feed_volume(block, feed)
        elif isinstance(block, bpy.types.PointCloud):
            content.feed_attributes(block, feed)
        elif isinstance(block, bpy.types.Text):
            feed.add(block.as_string())
        elif hasattr(bpy.types, "Curves") and isinstance(block, bpy.types.Curves):
            content.feed_curves(block, feed)

    def _feed_object(self, ob, feed):
        self._walker.walk(ob, feed, ob)
        feed.add(ob.type, numbers(ob.matrix_world))
        placing, layer = ob.original, bpy.context.view_layer
        feed.add(placing.holdout_get(view_layer=layer), placing.indirect_only_get(view_layer=layer))
        for slot in ob.material_slots if ob.data else ():  # Blender 3.4 crashes over those of an empty
            feed.add("slot", slot.material and self._refer(slot.material))
        linking = getattr(placing, "light_linking", None)
        for role in ("receiver_collection", "blocker_collection"):
            chosen = getattr(linking, role, None)
            feed.add(role, chosen and self._refer(chosen))
        if ob.type in ("LIGHT", "VOLUME") and ob.data:
            feed.add(self._refer(ob.data))
        nodes = any(modifier.type == "NODES" for modifier in ob.modifiers)
        if isinstance(placing.data, bpy.types.Mesh) and (nodes or name_of(ob) not in self._shown):
            content.feed_source(placing.data, feed)
        self._feed_modifiers(ob, feed)
        for system in ob.particle_systems:
            feed.add("particle system", self._refer(system.settings))
            self._walker.walk(system, feed, ob)
            content.feed_hair(system, ob, feed)

    def _feed_modifiers(self, ob, feed):
        for modifier in ob.modifiers:
            if not modifier.show_render or modifier.type not in UNREADABLE and ob.type != "VOLUME":
                continue
            feed.add("modifier", modifier.type)
            self._walker.walk(modifier, feed, ob)
            self._walker.own_properties(modifier, feed)
            if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN":
                folder = absolute(modifier.domain_settings.cache_directory, ob.original)
                feed.add([hash_file(path) for path in frame_files(folder, bpy.context.scene.frame_current)])

    def _feed_collection(self, collection, feed):
        """Which objects are concerned, of one that lights are linked to."""
        for held, about in ((collection.objects, "collection_objects"), (collection.children, "collection_children")):
            states = [entry.light_linking.link_state for entry in getattr(collection, about, [])] or [""] * len(held)
            for name, state in sorted((name_of(block), state) for block, state in zip(held, states)):
                feed.add(name, state)
        for child in collection.children:
            self._refer(child)

    def _add_mesh(self, ob):
        """Evaluated, of an object; it bears the name of what it was made from."""
        mesh = ob.data
        source, key = ob.original.data, mesh.as_pointer()
        what = name_of(source or mesh)
        self._note_use(name_of(ob), what)
        if key in self._seen:
            return
        self._seen.add(key)
        feed, self._user = Feed(), what
        content.feed_mesh(mesh, self._meshes.hash_of(mesh), feed)
        self._walker.walk(mesh, feed, mesh)
        if isinstance(source, bpy.types.Mesh) and (ob.modifiers or source.shape_keys):
            feed.add_array("undeformed", content.read(mesh.vertices, "undeformed_co", "f", 3))
        materials = list(mesh.materials)
        if materials != [slot.material for slot in ob.material_slots]:  # nodes gave it others
            feed.add([material and self._refer(material) for material in materials])
        self._put(what, feed)

    def _add_points(self, ob):
        """Hair curves or a cloud of points, also those that geometry nodes make of a mesh."""
        what, key = name_of(ob.original.data or ob.data), ob.data.as_pointer()
        self._note_use(name_of(ob), what)
        if key in self._seen:
            return
        self._seen.add(key)
        feed, self._user = Feed(), what
        self._feed_content(ob.data, feed)
        feed.add([material and self._refer(material) for material in ob.data.materials])
        self._put(what, feed)

    def _look(self, node):
        image, user = getattr(node, "image", None), getattr(node, "image_user", None)
        if image and user:
            self._image_users.setdefault(name_of(image), []).append(user)
        if node.type in ("CAMERA", "VECT_TRANSFORM", "TEX_COORD"):
            self._asks_camera |= node.type != "TEX_COORD" or any(
                socket.is_linked for socket in node.outputs if socket.name in ("Camera", "Window"))
        self._asks_layer |= getattr(node, "attribute_type", "") == "VIEW_LAYER"

    def _add_settings(self, scene, layer):
        """Of the scene and its view layer, what a bake does not set itself (scene_ops/cycles.py, docs/scene-state.md)."""
        feed = Feed()
        for name in sorted(FOLLOWED):
            feed.add(name, getattr(scene.cycles, name, None))
        for name in ("use_sky", "use_solid", "use_strand", "use_volumes"):
            feed.add(name, getattr(layer, name, None))
        for name in ("hair_type", "hair_subdiv"):
            feed.add(name, getattr(scene.render, name, None))
        if hasattr(scene, "cycles_curves"):
            self._walker.walk(scene.cycles_curves, feed, scene)
        feed.add("space", getattr(getattr(bpy.data, "colorspace", None), "working_space", ""))
        feed.add("world", scene.world and name_of(scene.world))
        if self._asks_camera and scene.camera:
            feed.add("camera", numbers(scene.camera.matrix_world), self._refer(scene.camera.data))
        if self._asks_layer:
            for owner in (layer, scene):
                self._walker.own_properties(owner, feed)
        self._put("scene settings", feed)


def name_of(block):
    """Among the entries: what it is and its name, with the library's file for a linked one."""
    block = block.original or block
    kind = next((KINDS[cls.__name__] for cls in type(block).__mro__ if cls.__name__ in KINDS), None)
    if kind is None:
        cls = next((cls for cls in type(block).__mro__ if bpy.types.ID in cls.__bases__), type(block))
        kind = cls.__name__.lower()
    return f"{kind} '{block.name_full}'"


def numbers(matrix):
    return tuple(value for row in matrix for value in row)
