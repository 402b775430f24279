"""What scripts and builds get of real runs: --json against its schema, every line of --log-format jsonl, --depfile.

    RNMBAKE_BINARY=build/release/rnmbake python3 tests/with_blender/outputs_check.py
"""
import json
from pathlib import Path
import tempfile
import unittest

import jsonschema

from harness import IO, OK, SCENES, TASKS_FAILED, USAGE, rnmbake, run_blender

ROOT = Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "docs" / "json.schema.json").read_text(encoding="utf-8"))
FIELDS = {  # docs/logs.md: of each event
    "message": set(), "step": {"step", "steps", "name", "seconds_left"},
    "progress": {"title", "share", "seconds_left", "item"}, "failed": {"object", "reason"}, "end": {"exit_code"},
}


class Outputs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        folder = tempfile.TemporaryDirectory(prefix="rnmbake-outputs-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.scene = cls.folder / "things.blend"
        run_blender(SCENES / "manifest_cases.py", cls.scene)
        cls.project = cls.folder / "things.toml"
        cls.project.write_text('[scene]\nfile = "things.blend"\n\n[bake]\nresolution = 16\nsamples = 2\n\n'
                               '[output]\nsave_scene = "never"\n', encoding="utf-8")
        cls.baked = cls.call("bake", cls.project, "-o", cls.folder / "maps", "--retries", "0")

    @classmethod
    def call(cls, command, scene, *flags):
        """How it ended, its object, its lines, its depfile (None: none was written)."""
        deps = cls.folder / f"{command}.d"
        deps.unlink(missing_ok=True)
        done = rnmbake("--log-format", "jsonl", command, scene, *flags, "--json", "--depfile", deps)
        made = json.loads(done.stdout)
        jsonschema.Draft202012Validator(SCHEMA).validate(made)
        return done.returncode, made, done.stderr.splitlines(), deps.read_text() if deps.exists() else None

    def check_lines(self, lines):
        """Every line is an event of the documentation; returns them."""
        events = [json.loads(line) for line in lines]
        for event in events:
            self.assertRegex(event["time"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
            self.assertIn(event["level"], ("info", "warning", "error"))
            self.assertEqual(set(event) - {"time", "level", "event", "message"}, FIELDS[event["event"]], event)
        return events

    def test_a_bake_in_which_one_object_fails(self):
        code, made, lines, deps = self.baked
        self.assertEqual((code, made["exit_code"], made["command"]), (TASKS_FAILED, TASKS_FAILED, "bake"))
        self.assertEqual([one["key"] for one in made["failed"]], ["dust"])
        self.assertIn("no texel", made["failed"][0]["reason"])
        self.assertEqual(made["files"][-1], "manifest.json")
        written = {path.name for path in (self.folder / "maps").iterdir() if not path.name.startswith(".")}
        self.assertEqual(written, set(made["files"]))
        self.assertEqual(made["lightmaps"] + 2, len(made["files"]))
        self.assertGreater(made["seconds"], 0)
        events = self.check_lines(lines)
        failed = [event for event in events if event["event"] == "failed"]
        self.assertEqual([(event["object"], event["reason"]) for event in failed],
                         [(one["key"], one["reason"]) for one in made["failed"]])

    def test_progress_is_an_event_every_second(self):
        done = rnmbake("--log-format", "jsonl", "bake", self.project, "-o", self.folder / "slow", "--samples", "1000", "--resolution",
                       "128")
        shares = [event["share"] for event in self.check_lines(done.stderr.splitlines()) if event["event"] == "progress"]
        self.assertGreater(len(shares), 1)
        known = [share for share in shares if share is not None]
        self.assertEqual(known, sorted(known))
        self.assertTrue(all(0 <= share <= 1 for share in known))

    def test_the_depfile_of_a_bake(self):
        target, *inputs = self.baked[3].replace("\\\n", "").split()
        self.assertEqual(target, f"{self.folder}/maps/manifest.json:")
        self.assertEqual(inputs[:2], [str(self.scene), str(self.project)])
        for name in inputs:
            self.assertTrue(Path(name).is_file(), name)

    def test_a_reference_and_a_basis_file(self):
        basis = self.folder / "up.toml"
        basis.write_text('[[basis]]\nname = "up"\ndirection = [0.0, 0.0, 1.0]\n')
        code, made, lines, deps = self.call("reference", self.project, "-o", self.folder / "truth", "--basis", basis)
        self.assertEqual((code, made["command"]), (TASKS_FAILED, "reference"))
        self.check_lines(lines)
        self.assertIn(str(basis), deps)

    def test_probes(self):
        code, made, lines, deps = self.call("probes", self.scene, "-o", self.folder / "volume", "--spacing", "4", "--samples", "4",
                                            "--check", "8", "--to", "threejs")
        self.assertEqual(code, OK, lines)
        self.check_lines(lines)
        for name in made["files"]:
            self.assertTrue((self.folder / "volume" / name).is_file(), name)
        self.assertGreater(made["volumes"][0]["probes"], 0)
        self.assertTrue(deps.startswith(f"{self.folder}/volume/probes.json:"), deps)
        self.assertIn(str(self.scene), deps)

    def test_a_validation_says_its_steps(self):
        code, made, lines, deps = self.call("validate", self.project, "-o", self.folder / "proof", "--view", "0", "--exclude", "dust",
                                            "--decompose", "none", "--fail-above", "rmse=1000%")
        self.assertEqual(code, OK, lines)
        steps = [event for event in self.check_lines(lines) if event["event"] == "step"]
        self.assertEqual([event["step"] for event in steps], list(range(1, steps[0]["steps"] + 1)))
        self.assertEqual(made["exceeded"], [])
        self.assertTrue(made["complete"])
        self.assertTrue(deps.startswith(f"{self.folder}/proof/report.json:"), deps)
        for name in made["files"]:
            self.assertTrue((self.folder / "proof" / name).is_file(), name)

    def test_what_fails_as_a_whole(self):
        code, made, lines, deps = self.call("bake", self.folder / "missing.blend", "-o", self.folder / "none")
        self.assertEqual((code, made["exit_code"], deps), (IO, IO, None))
        events = self.check_lines(lines)
        self.assertEqual((events[-1]["event"], events[-1]["exit_code"], events[-1]["message"]), ("end", IO, made["error"]))
        self.assertEqual(self.call("bake", self.scene)[0], USAGE)


if __name__ == "__main__":
    unittest.main()
