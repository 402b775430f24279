"""Pixels of the pictures that a lambert scene is made of."""
from array import array
from operator import add

import bpy


def read_pixels(image):
    pixels = array("f", bytes(16 * image.size[0] * image.size[1]))
    image.pixels.foreach_get(pixels)
    return pixels


def brightness(pixels):
    return max(max(pixels[channel::4]) for channel in range(3))


def farthest_from_black(pixels):
    return max(max(max(pixels[channel::4]), -min(pixels[channel::4])) for channel in range(3))


def keep_if_bright(image):
    """The image; None, and it is gone, where it is black everywhere. Light may be negative."""
    if image and farthest_from_black(read_pixels(image)) == 0:
        bpy.data.images.remove(image)
        return None
    return image


def left_beside(transmittance, albedo):
    """No surface gives away more than it gets."""
    return max(0.0, min(transmittance, 1 - albedo))


def cut(transmittance, albedo):
    """Leaves of an image what is within 0 and 1 together with the albedo's pixels."""
    through = read_pixels(transmittance)
    if all(min(through[channel::4]) >= 0 and max(map(add, through[channel::4], albedo[channel::4])) <= 1.00001
           for channel in range(3)):
        return
    for channel in range(3):
        through[channel::4] = array("f", map(left_beside, through[channel::4], albedo[channel::4]))
    transmittance.pixels.foreach_set(through)
