"""Lightmaps added to a .glb, without Blender: blender_scripts/deliver/glb_file.py."""
from pathlib import Path
import sys
import tempfile
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "blender_scripts"))

from deliver.glb_file import EXTENSION, Glb, add_lightmaps  # noqa: E402

PROPERTY = "number"


def primitives(*materials):
    return {"primitives": [{} if material is None else {"material": material} for material in materials]}


class Materials(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.picture = Path(folder.name) / "page.png"
        self.picture.write_bytes(b"a picture")

    def lit(self, meshes, pages):
        """The JSON of a file whose mesh k is on page pages[k], or has no lightmap (None)."""
        nodes = [{"name": f"node {k}", "mesh": k, **({} if page is None else {"extras": {PROPERTY: k}})}
                 for k, page in enumerate(pages)]
        objects = [{"key": f"object {k}", "page": page, "scale": [1, 1], "offset": [0, 0]} for k, page in enumerate(pages)]
        glb = Glb({"nodes": nodes, "meshes": meshes, "materials": [{"name": "stone"}, {"name": "wood"}]}, bytearray())
        add_lightmaps(glb, {"objects": objects, "pages": [self.picture] * 2, "intensity": 3, "record": {}}, PROPERTY)
        return glb.json

    def page_of(self, document, mesh, primitive=0):
        """Index of the page's texture; None for a material without a lightmap."""
        material = document["materials"][document["meshes"][mesh]["primitives"][primitive]["material"]]
        return material.get("extensions", {}).get(EXTENSION, {}).get("index")

    def test_one_that_is_on_two_pages_is_there_twice(self):
        document = self.lit([primitives(0, 1), primitives(0)], [0, 1])
        self.assertEqual([self.page_of(document, 0), self.page_of(document, 0, 1), self.page_of(document, 1)], [0, 0, 1])
        self.assertEqual(len(document["materials"]), 3)

    def test_one_that_an_object_without_a_lightmap_shares_stays_as_it_is(self):
        document = self.lit([primitives(0), primitives(0, 1)], [0, None])
        self.assertEqual([self.page_of(document, 0), self.page_of(document, 1), self.page_of(document, 1, 1)], [0, None, None])
        self.assertEqual(document["materials"][0], {"name": "stone"})

    def test_none_becomes_one(self):
        document = self.lit([primitives(None), primitives(None)], [0, 0])
        self.assertEqual([self.page_of(document, 0), self.page_of(document, 1)], [0, 0])
        self.assertEqual(len(document["materials"]), 3)


if __name__ == "__main__":
    unittest.main()
