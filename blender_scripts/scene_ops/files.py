"""Paths of the files that data-blocks name, and fingerprints of their content."""
import hashlib
import os
import re

import bpy


def absolute(path, block):
    """`path` as `block` means it: relative ones begin at the .blend that holds the block."""
    return os.path.abspath(bpy.path.abspath(path, library=getattr(block, "library", None)))


def picture_files(image, user=None):
    """Files of an image that is not packed: all tiles, or the one that a sequence shows to `user`."""
    if image.source == "GENERATED" or image.packed_file or not image.filepath:
        return []
    if image.source == "TILED":
        return [absolute(tile_path(image.filepath, tile.number), image) for tile in image.tiles]
    if image.source == "SEQUENCE" and user is not None:
        return [absolute(numbered(image.filepath, frame_of(user, bpy.context.scene.frame_current)), image)]
    return [absolute(image.filepath, image)]


def frame_of(user, frame):
    """Number of the file that an image user shows at a frame, as Blender finds it. Blender's own answer,
    filepath_from_user(), is that of the last frame that was drawn, of which there is none here."""
    shown = frame - user.frame_start + 1
    if user.use_cyclic:
        shown = (shown - 1) % max(user.frame_duration, 1) + 1
    return min(max(shown, 1), max(user.frame_duration, 1)) + user.frame_offset


def numbered(path, number):
    """The file of that number in a sequence: the last digits of the name stand for it."""
    folder, name = os.path.split(path)
    stem, ending = os.path.splitext(name)
    digits = re.search(r"(\d+)(\D*)$", stem)
    if not digits:
        return path
    return os.path.join(folder, f"{stem[:digits.start()]}{number:0{len(digits[1])}d}{digits[2]}{ending}")


def tile_path(path, number):
    """Of a UDIM tile, whose name holds a place for its number, in one of two ways of counting."""
    u, v = (number - 1001) % 10 + 1, (number - 1001) // 10 + 1
    return path.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u}_v{v}")


def hash_file(path):
    """Fingerprint of a file's content; "missing" for one that is not there."""
    digest = hashlib.blake2b(digest_size=16)
    try:
        with open(path, "rb") as stream:
            while block := stream.read(1 << 20):
                digest.update(block)
    except OSError:
        return "missing"
    return digest.hexdigest()


def frame_files(folder, frame):
    """Files below a cache's folder that are of one frame: its number stands in their names."""
    marks = (f"_{frame:04d}.", f"_{frame:06d}_", f"_{frame:06d}.")
    for root, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            if any(mark in name for mark in marks):
                yield os.path.join(root, name)
