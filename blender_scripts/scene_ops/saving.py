"""Copies of the scene on a disk."""
import os
import shutil

import bpy

from core.task import IO, Refusal


def save_copy(path, **options):
    """The present scene as a .blend. Blender does not say why it could not write one, and takes away what it had of
    it; in a folder that can be written to it is for want of room."""
    try:
        bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, **options)
    except RuntimeError as error:
        raise not_saved(path) from error
    if not os.path.exists(path):
        raise not_saved(path)


def save_data(path, blocks):
    """These data blocks, and what they use, as a .blend without a scene: a library to link to or to append from."""
    try:
        bpy.data.libraries.write(path, blocks, fake_user=True, compress=True)
    except (RuntimeError, OSError) as error:
        raise not_saved(path) from error
    if not os.path.exists(path):
        raise not_saved(path)


def not_saved(path):
    folder = os.path.dirname(path)
    free = shutil.disk_usage(folder).free >> 20
    return Refusal(f"cannot save {path}: the disk is full, or the folder must not be written to ({free} MiB are free); "
                   "free some space, or use another disk (TMPDIR for temporary files)", IO)
