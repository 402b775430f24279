"""The scene's render settings, put back after steps that need their own."""
from contextlib import contextmanager

import bpy

PLAIN = ("BOOLEAN", "INT", "FLOAT", "ENUM", "STRING", "POINTER")


@contextmanager
def kept_settings():
    """For as long as this lasts settings and camera may be changed; what was added to see through is removed."""
    scene, camera = bpy.context.scene, bpy.context.scene.camera
    owners = [scene.render, *scene.view_layers]
    before = [_values(owner) for owner in owners]
    yield
    for owner, values in zip(owners, before):
        for name, value in values.items():
            if getattr(owner, name) != value:
                setattr(owner, name, value)
    if scene.camera != camera:
        added, scene.camera = scene.camera, camera
        data = added.data
        bpy.data.objects.remove(added)
        bpy.data.cameras.remove(data)


def _values(owner):
    return {prop.identifier: getattr(owner, prop.identifier) for prop in owner.bl_rna.properties
            if prop.type in PLAIN and not prop.is_readonly and not getattr(prop, "is_array", False)}
