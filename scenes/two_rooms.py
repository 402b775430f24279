"""Two rooms with a door between them: a bright one under a glowing ceiling, and one that has what comes through the door.

What leaks through the wall between light probes shows in the dark room; `wall` is how thick that is.
"""

import kit

DEPTH, HEIGHT = 4.0, 3.0
WIDTH = 4.0              # of each room
DOOR, HEAD = 1.3, 2.2    # width and height of the opening, in the middle of the wall


def _room(name, left, plaster):
    """Four walls and a ceiling that face inwards, and without the one towards the other room."""
    builder = kit.Builder()
    skip = "zX" if left == 0 else "zx"
    builder.box((left, 0, 0), (left + WIDTH, DEPTH, HEIGHT), inward=True, skip=skip)
    builder.object(name, [plaster])


def _wall(wall, plaster):
    """The wall between: both faces, and the reveals of the door."""
    low, high = (DEPTH - DOOR) / 2, (DEPTH + DOOR) / 2
    left, right = WIDTH, WIDTH + wall
    builder = kit.Builder()
    builder.box((left, 0, 0), (right, low, HEIGHT), skip="yzZ")
    builder.box((left, high, 0), (right, DEPTH, HEIGHT), skip="YzZ")
    builder.box((left, low, HEAD), (right, high, HEIGHT), skip="yYZ")
    builder.object("wall_between", [plaster])


def build(wall=0.1):
    kit.start(look="Medium High Contrast")
    left, right = 0.0, WIDTH + wall
    floor = kit.Builder()
    floor.quad((0, 0, 0), (right + WIDTH, 0, 0), (0, DEPTH, 0), cells=(8, 4))
    floor.object("floor", [kit.diffuse("boards", (0.42, 0.27, 0.15))])
    _room("room_bright", left, kit.diffuse("cream", (0.78, 0.74, 0.64)))
    _room("room_dark", right, kit.diffuse("slate", (0.34, 0.46, 0.6)))
    _wall(wall, kit.diffuse("plaster", (0.75, 0.75, 0.75)))
    block = kit.Builder()
    block.box((0.35, 0.35, 0), (1.05, 1.05, 0.75), turn=20, skip="z")
    block.object("block", [kit.diffuse("terracotta", (0.6, 0.2, 0.1))])
    panel = kit.Builder()
    panel.quad((1.25, 2.75, HEIGHT - 0.02), (1.5, 0, 0), (0, -1.5, 0))
    panel.object("panel", [kit.emitter("panel", (1.0, 0.93, 0.8), 12.0)])
    kit.camera((7.7, 0.5, 1.6), (3.2, 2.4, 1.2), lens=20)
