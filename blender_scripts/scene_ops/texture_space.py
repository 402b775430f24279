"""The box that generated coordinates count in."""


def keep(mesh, source):
    """What stands for `source` has the box of that, whatever its own shape."""
    mesh.use_auto_texspace = False
    mesh.texspace_location, mesh.texspace_size = source.texspace_location, source.texspace_size
