"""Paths of the files that data-blocks name, and fingerprints of their content."""
import hashlib
import os

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
    if image.source == "SEQUENCE" and user is not None and hasattr(image, "filepath_from_user"):
        return [absolute(image.filepath_from_user(image_user=user), image)]
    return [absolute(image.filepath, image)]


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
