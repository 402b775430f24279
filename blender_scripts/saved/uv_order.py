"""The lightmap's place among the UV layers of a saved scene: the second, so that every exporter numbers it alike."""
from array import array

LIGHTMAP_INDEX = 1
FIRST_LAYER = "UVMap"


def put_second(mesh, name):
    """Move the layer to its place; the others keep their order. Materials name the layers that they read, and the
    active-render layer stays the same one, so the look stays.

    Where there is no other layer, a copy of it becomes the first: what a normal map's tangents were baked along.
    """
    layers = mesh.uv_layers
    if len(layers) == 1:
        write(layers.new(name=FIRST_LAYER, do_init=False), read(layers[name]))
    order = [layer.name for layer in layers if layer.name != name]
    order.insert(LIGHTMAP_INDEX, name)
    if order != [layer.name for layer in layers]:
        _arrange(layers, order)


def _arrange(layers, order):
    """Reorder the layers: remove each and add it at the end, for Blender has no other way."""
    active, render = layers.active.name, next(layer.name for layer in layers if layer.active_render)
    for name in order:
        uv = read(layers[name])
        layers.remove(layers[name])
        write(layers.new(name=name, do_init=False), uv)
    layers.active = layers[active]
    layers[render].active_render = True


def read(layer):
    uv = array("f", bytes(8 * len(layer.data)))
    layer.data.foreach_get("uv", uv)
    return uv


def write(layer, uv):
    layer.data.foreach_set("uv", uv)
