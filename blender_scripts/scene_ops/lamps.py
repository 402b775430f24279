"""Lamp objects: suns, points, spots, areas."""
import bpy


def put_out():
    """No lamp object gives light any more; glowing surfaces and the world still do.

    Each gets data of no energy, its own being read by drivers, and stays in its place, since others may hang on it.
    Hiding would not do: geometry nodes and particles show objects that are hidden themselves.
    """
    dark = bpy.data.lights.new("rnmbake dark", "POINT")
    dark.energy = 0
    for ob in bpy.data.objects:
        if ob.type == "LIGHT":
            ob.data = dark
