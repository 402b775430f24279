"""Fingerprints of what is too large for a walk over properties: arrays of geometry, pixels, volumes."""
import hashlib
from array import array

from scene_ops.files import absolute, hash_file, picture_files

# data_type of an attribute: the property that holds it, kind of number, numbers for each element
ATTRIBUTES = {"FLOAT": ("value", "f", 1), "INT": ("value", "i", 1), "INT8": ("value", "i", 1), "BOOLEAN": ("value", "b", 1),
              "FLOAT_VECTOR": ("vector", "f", 3), "FLOAT2": ("vector", "f", 2), "FLOAT_COLOR": ("color", "f", 4),
              "BYTE_COLOR": ("color", "f", 4), "QUATERNION": ("value", "f", 4), "FLOAT4X4": ("value", "f", 16),
              "INT32_2D": ("value", "i", 2), "INT16_2D": ("value", "i", 2)}
# What editors keep in attributes, and what a mesh's own arrays say already.
PASSED_OVER = {"position", "material_index", ".corner_vert", ".corner_edge", ".edge_verts", "sharp_face", "sharp_edge",
               "custom_normal", ".select_vert", ".select_edge", ".select_poly", ".hide_vert", ".hide_edge", ".hide_poly",
               ".uv_select_vert", ".uv_select_edge", ".uv_select_face", ".sculpt_face_set", ".sculpt_mask",
               "active_shape_key", ".selection", "selection"}
EDITORS = (".vs.", ".es.", ".pn.", ".select", ".hide", ".uv_select", ".sculpt")


def read(collection, name, kind, components=1):
    values = array(kind, bytes(len(collection) * components * array(kind).itemsize))
    if values:
        collection.foreach_get(name, values)
    return values


def feed_mesh(mesh, arrays, feed):
    """`arrays`: fingerprint of what a survey has read of it already (MeshFile)."""
    feed.add("arrays", arrays)
    feed.add("uv", [layer.name for layer in mesh.uv_layers], [layer.active_render for layer in mesh.uv_layers])
    feed.add_array("smooth", read(mesh.polygons, "use_smooth", "b"))
    feed.add("texture space", tuple(mesh.texspace_location), tuple(mesh.texspace_size))
    colors = getattr(mesh, "color_attributes", None)
    feed.add("color", getattr(colors, "render_color_index", -1))
    feed_attributes(mesh, feed, {layer.name for layer in mesh.uv_layers})


def feed_source(mesh, feed):
    """A mesh that nodes or modifiers read and no render shows as it is."""
    feed.add_array("positions", read(mesh.vertices, "co", "f", 3))
    feed.add_array("corners", read(mesh.loops, "vertex_index", "i"))
    feed_attributes(mesh, feed)


def feed_attributes(data, feed, read_already=frozenset()):
    for attribute in sorted(data.attributes, key=lambda attribute: attribute.name):
        name, domain, kind = attribute.name, attribute.domain, attribute.data_type
        if name in PASSED_OVER and hasattr(data, "polygons") or name in read_already or name.startswith(EDITORS):
            continue
        feed.add("attribute", name, domain, kind, len(attribute.data))
        if kind in ATTRIBUTES:
            feed.add_array(name, read(attribute.data, *ATTRIBUTES[kind]))
        else:
            feed.add([getattr(element, "value", None) for element in attribute.data])


def feed_curves(curves, feed):
    """Hair curves; of legacy ones a mesh is made."""
    feed.add_array("offsets", read(curves.curves, "first_point_index", "i"))
    feed_attributes(curves, feed)


def feed_image(image, users, feed):
    """Pixels by the files that hold them, wherever they lie. `users`: what says which frame of it is shown."""
    feed.add(image.source)
    if image.source == "GENERATED":
        feed.add(image.generated_type, tuple(image.generated_color), image.generated_width, image.generated_height,
                 image.use_generated_float)
    if image.source == "TILED":
        feed.add([tile.number for tile in image.tiles])
    for part in image.packed_files:
        feed.add("packed", hash_bytes(part.packed_file.data))
    paths = {path: None for user in users or [None] for path in picture_files(image, user)}
    feed.add([hash_file(path) for path in paths])
    feed.add(image.colorspace_settings.name)


def hash_bytes(data):
    return hashlib.blake2b(data, digest_size=16).hexdigest()


def feed_volume(volume, feed):
    if volume.packed_file:
        feed.add(hash_bytes(volume.packed_file.data))
    elif volume.filepath:
        if volume.is_sequence:
            volume.grids.load()
        feed.add(hash_file(absolute(volume.grids.frame_filepath or volume.filepath, volume)))


def feed_hair(system, ob, feed):
    """Particles and strands of a system; what they grow on is in the mesh, how they look in the settings."""
    particles = system.particles
    feed.add("particles", len(particles), len(system.child_particles))
    for name, components in (("location", 3), ("rotation", 4), ("size", 1), ("velocity", 3)):
        feed.add_array(name, read(particles, name, "f", components))
    if system.settings.type != "HAIR":
        return
    for particle in particles:
        feed.add_array("keys", read(particle.hair_keys, "co_local", "f", 3))
    if system.use_hair_dynamics:
        steps = range(2 ** system.settings.render_step + 1)
        for number in range(len(particles)):
            feed.add([tuple(system.co_hair(object=ob, particle_no=number, step=step)) for step in steps])
