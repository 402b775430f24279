"""Pictures that a scene uses and that cannot be had: Cycles shows them in magenta."""
import os

import bpy


def picture_faults():
    """One line for each picture that is missing, or that this Blender cannot read."""
    for image in bpy.data.images:
        if image.source not in ("FILE", "TILED") or not image.users:
            continue
        path = bpy.path.abspath(image.filepath, library=image.library)
        if not image.packed_file and not image.filepath:
            continue
        if image.source == "FILE" and not image.packed_file and not os.path.exists(path):
            yield f"picture missing: {path}"
        elif not is_readable(image):
            where = "" if image.packed_file else f" ({path})"
            yield f"picture unreadable: {image.name!r}{where}; export it as PNG, or see whether the file is damaged"


def is_readable(image):
    """Whether Blender can decode it; frees the decoded pixels."""
    was_loaded = image.has_data
    readable = 0 not in image.size[:]
    if not was_loaded:
        image.buffers_free()
    return readable
