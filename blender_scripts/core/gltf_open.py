"""A glTF file, read, checked and made ready for Blender's importer."""
from core.gltf_check import check
from core.gltf_file import BrokenGltf, read_gltf
from core.gltf_prepare import prepare


def open_gltf(path, importer_knows):
    """The Gltf, and what the user should be warned of. Raises BrokenGltf. `importer_knows`: an extension."""
    gltf = read_gltf(path)
    try:
        check(gltf, importer_knows)
        return gltf, prepare(gltf, importer_knows)
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:  # one of a million ways to be wrong
        raise BrokenGltf(f"its JSON is not what glTF wants ({error!r}); export it again") from error
