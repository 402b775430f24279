"""Evaluated meshes as raw arrays in one file; all loops over elements are Blender's own (foreach_get)."""
import hashlib
from array import array

WIDTH = 4  # bytes of a number: float32 or int32


class MeshFile:
    """survey.bin and the list of what lies where in it."""

    def __init__(self, path):
        self._stream = open(path, "wb")
        self._index, self._hashes = {}, []
        self._hash = hashlib.blake2b()
        self.entries = []
        self.bytes_written = 0

    def close(self):
        self._stream.close()

    def add(self, mesh):
        """The number of the entry that holds an evaluated mesh, which is also the one that Cycles reads.

        Objects that share evaluated data share the entry; a modifier gives an object data of its own.
        """
        key = mesh.as_pointer()
        if key not in self._index:
            self._index[key] = len(self.entries)
            self._append(mesh)
        return self._index[key]

    def hash_of(self, mesh):
        """Fingerprint of all that add() wrote of the mesh."""
        return self._hashes[self._index[mesh.as_pointer()]]

    def _append(self, mesh):
        self._hash = hashlib.blake2b(digest_size=16)
        mesh.calc_loop_triangles()
        if not hasattr(mesh, "corner_normals"):  # before 4.1
            mesh.calc_normals_split()  # adds a layer: those taken hold of before it are no longer valid
        loops, polygons, triangles = len(mesh.loops), len(mesh.polygons), len(mesh.loop_triangles)
        uv_layers = list(mesh.uv_layers)
        self.entries.append({
            "name": mesh.name,
            "vertices": len(mesh.vertices), "loops": loops, "polygons": polygons, "triangles": triangles,
            "positions": self._write(mesh.vertices, "co", "f", 3),
            "loop_vertex": self._write(mesh.loops, "vertex_index", "i"),
            "loop_normal": self._write_normals(mesh),
            "triangle_loops": self._write(mesh.loop_triangles, "loops", "i", 3),
            "triangle_polygon": self._write(mesh.loop_triangles, "polygon_index", "i"),
            "polygon_start": self._write(mesh.polygons, "loop_start", "i"),
            "polygon_size": self._write(mesh.polygons, "loop_total", "i"),
            "polygon_slot": self._write(mesh.polygons, "material_index", "i"),
            "uv_layers": [{"name": layer.name, "offset": self.write_uv(layer)} for layer in uv_layers],
            "active_uv": mesh.uv_layers.active_index if uv_layers else -1,
            "render_uv": next((i for i, layer in enumerate(uv_layers) if layer.active_render), -1),
        })
        self._hashes.append(self._hash.hexdigest())

    def _write(self, collection, attribute, kind, components=1):
        """Append one attribute of all elements; returns its offset in bytes."""
        values = array(kind, bytes(len(collection) * components * WIDTH))
        if values:
            collection.foreach_get(attribute, values)
        return self.append(values)

    def append(self, values):
        """Append an array of numbers; returns its offset in bytes."""
        offset = self.bytes_written
        values.tofile(self._stream)
        self._hash.update(values)
        self.bytes_written += len(values) * WIDTH
        return offset

    def _write_normals(self, mesh):
        if hasattr(mesh, "corner_normals"):
            return self._write(mesh.corner_normals, "vector", "f", 3)
        return self._write(mesh.loops, "normal", "f", 3)

    def write_uv(self, layer):
        if hasattr(layer, "uv"):  # >= 3.5
            return self._write(layer.uv, "vector", "f", 2)
        return self._write(layer.data, "uv", "f", 2)
