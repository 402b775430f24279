"""Files that are missing, are something else, or cannot be written."""
import os
from pathlib import Path
import subprocess
import unittest

from bad_input import BadInput, files_in
from harness import INVALID_INPUT, IO, USAGE


class Scenes(BadInput):
    def test_missing(self):
        self.assert_refused(self.bake("nowhere.blend"), IO, "nowhere.blend", "check the path")

    def test_folder(self):
        scene = self.folder / "folder.blend"
        scene.mkdir()
        self.assert_refused(self.bake(scene), IO, "folder.blend")

    def test_text_in_disguise(self):
        scene = self.folder / "text.blend"
        scene.write_text("Dear diary,\n", encoding="utf-8")
        self.assert_refused(self.bake(scene), INVALID_INPUT, "text.blend")

    def test_empty(self):
        scene = self.folder / "empty.blend"
        scene.touch()
        self.assert_refused(self.bake(scene), INVALID_INPUT, "empty.blend")

    def test_truncated(self):
        whole = (self.scenes / "good.blend").read_bytes()
        for share in (0.01, 0.5, 0.95):
            with self.subTest(share=share):
                scene = self.folder / "half.blend"
                scene.write_bytes(whole[:int(share * len(whole))])
                self.assert_refused(self.bake(scene), INVALID_INPUT, "half.blend")

    def test_gltf_in_disguise(self):
        scene = self.folder / "text.glb"
        scene.write_text("Dear diary,\n", encoding="utf-8")
        ended = self.bake(scene)
        if "numpy" in ended.err:
            self.skipTest("SKIPPED: this Blender has no numpy, so no glTF importer; install python3-numpy")
        self.assert_refused(ended, INVALID_INPUT, "text.glb")

    def test_unknown_key(self):
        project = self.folder / "project.toml"
        project.write_text(f'[scene]\nfile = "{self.scenes}/good.blend"\n[bake]\nsampels = 4\n', encoding="utf-8")
        self.assert_refused(self.bake(project), USAGE, "project.toml", "'sampels'", "samples")


class Folders(BadInput):
    def test_file_in_its_place(self):
        self.out.write_text("mine", encoding="utf-8")
        ended = self.bake("good.blend")
        self.assertEqual(ended.code, IO, ended.err)
        self.assert_one_error(ended, str(self.out))
        self.assertEqual(self.out.read_text(encoding="utf-8"), "mine")
        self.assert_tidy()

    def test_not_writable(self):
        """/proc: a folder that not even root can write to."""
        self.out = Path("/proc/rnmbake")
        self.assert_refused(self.bake("good.blend"), IO, "/proc/rnmbake")

    def test_without_permission(self):
        self.out.mkdir(mode=0o555)
        if os.access(self.out, os.W_OK):
            self.skipTest("SKIPPED: root may write everywhere; see test_not_writable")
        self.assert_refused(self.bake("good.blend"), IO, str(self.out), "ermission")

    def small_disk(self, kibibytes):
        self.out.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kibibytes}k", "tmpfs", str(self.out)],
                                 capture_output=True, encoding="utf-8", check=False)
        if mounted.returncode != 0:
            self.skipTest(f"SKIPPED: cannot mount a small tmpfs ({mounted.stderr.strip()}); run as root")
        self.addCleanup(subprocess.run, ["umount", str(self.out)], check=True)

    def test_full_from_the_start(self):
        self.small_disk(16)
        self.assert_refused(self.bake("good.blend"), IO, str(self.out), "full")

    def test_full_on_the_way(self):
        """Room for a lightmap or so, not for three: whatever is there in the end is whole."""
        self.small_disk(400)
        ended = self.bake("good.blend", "--resolution", "128", "--samples", "4", "--depth", "float")
        self.assertEqual(ended.code, IO, ended.err)
        self.assert_one_error(ended, str(self.out), "full")
        self.assert_tidy()
        left = files_in(self.out)
        self.assertEqual([name for name in left if not name.endswith(".exr")], [])
        self.assertLess(len(left), 3)
        for name in left:
            self.assert_whole(name)

    def test_full_temporary_folder(self):
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=40k", "tmpfs", str(self.temporary)],
                                 capture_output=True, encoding="utf-8", check=False)
        if mounted.returncode != 0:
            self.skipTest(f"SKIPPED: cannot mount a small tmpfs ({mounted.stderr.strip()}); run as root")
        self.addCleanup(subprocess.run, ["umount", str(self.temporary)], check=True)
        ended = self.bake("good.blend")
        self.assert_refused(ended, IO, str(self.temporary), "full")


if __name__ == "__main__":
    unittest.main(verbosity=2)
