"""Reads what src/probes/formats wrote by readers of its own, as each engine would, and looks for the walls' colours.

    SAMPLE_FORMATS=build/release/tests/sample_formats CXX=c++ python3 tests/probes/formats/formats_check.py

With node and npm's ktx-parse in node_modules of the folder that RNMBAKE_NODE_MODULES names, that reads Bevy's texture too.
"""
import json
import os
from pathlib import Path
import re
import shutil
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parent))
import known_light as known  # noqa: E402
from reading import Files, sampled, turned_by  # noqa: E402


def ktx2(path):
    """Width, height, depth and the halves of an uncompressed RGBA16F KTX2 file, read by the letter of its specification."""
    data = path.read_bytes()
    if data[:12] != b"\xabKTX 20\xbb\r\n\x1a\n":
        raise ValueError("no KTX2")
    fields = struct.unpack_from("<13I2Q", data, 12)
    vk_format, type_size, width, height, depth, layers, faces, levels, scheme, dfd_at, dfd_size, kvd_at, kvd_size = fields[:13]
    if (vk_format, type_size, layers, faces, levels, scheme) != (97, 2, 0, 1, 1, 0):
        raise ValueError(f"header {fields}")
    if struct.unpack_from("<I", data, dfd_at)[0] != dfd_size or kvd_at != dfd_at + dfd_size:
        raise ValueError("data format descriptor")
    vendor, version_size = struct.unpack_from("<2I", data, dfd_at + 4)
    if vendor != 0 or version_size != 2 | (dfd_size - 4) << 16:
        raise ValueError("basic descriptor")
    for channel, name in enumerate((0, 1, 2, 15)):
        offset, length, kind, _, lower, upper = struct.unpack_from("<HBBIff", data, dfd_at + 28 + 16 * channel)
        if (offset, length, kind, lower, upper) != (16 * channel, 15, name | 0xc0, -1, 1):
            raise ValueError(f"channel {channel}")
    at, size, unpacked = struct.unpack_from("<3Q", data, 80)
    if at % 8 or size != unpacked or size != width * height * depth * 8 or at + size != len(data) or at < kvd_at + kvd_size:
        raise ValueError("level")
    return width, height, depth, struct.unpack_from(f"<{size // 2}e", data, at)


class Bevy(Files):
    form = "bevy"
    NUMBERS = r"\(([^)]*)\)"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        code = (cls.folder / "probes.rs").read_text(encoding="utf-8")
        cls.volumes = {}
        pattern = r'voxels: "(\w+)\.vxgi\.ktx2",\s*translation: Vec3::new{0},\s*rotation: Quat::from_xyzw{0},\s*scale: Vec3::new{0}'
        for name, *rows in re.findall(pattern.replace("{0}", cls.NUMBERS), code):
            cls.volumes[name] = [tuple(map(float, row.split(","))) for row in rows] + [ktx2(cls.folder / (name + ".vxgi.ktx2"))]

    def look_up(self, name, place, normal):
        """The shader's way (irradiance_volume.wesl of Bevy 0.20): both in Bevy's world."""
        place, normal = known.y_up(place), known.y_up(normal)
        translation, rotation, scale, (width, height, depth, halves) = self.volumes[name]
        inverse = (-rotation[0], -rotation[1], -rotation[2], rotation[3])
        within = turned_by(inverse, [place[c] - translation[c] for c in range(3)])
        size = (width, height, depth)
        resolution = (width, height // 2, depth // 3)
        at = [min(max((within[c] / scale[c] + .5) * resolution[c], .5), resolution[c] - .5) for c in range(3)]
        light = [0, 0, 0]

        def texel(x, y, z):
            first = 4 * (x + width * (y + height * z))
            return halves[first:first + 3]

        for axis in range(3):
            where = (at[0], at[1] + (height / 2 if normal[axis] < 0 else 0), at[2] + depth / 3 * axis)
            colour = sampled(texel, size, where)
            light = [light[c] + colour[c] * normal[axis] ** 2 for c in range(3)]
        return light

    def test_walls(self):
        self.assert_walls(lambda place, normal: self.look_up("room", place, normal), 1.2 * known.HALF_STEP)

    def test_places(self):
        self.assertEqual(set(self.volumes), set(known.BOXES))
        self.assert_boxes(self.look_up, known.AXES.values(), 1.2 * known.HALF_STEP + known.PLACE)

    def test_code_names_what_bevy_has(self):
        code = (self.folder / "probes.rs").read_text(encoding="utf-8")
        self.assertIn("use bevy::light::{IrradianceVolume, LightProbe};", code)
        self.assertEqual(code.count("{"), code.count("}"))
        self.assertIn("BAKED_VOLUMES: [BakedVolume; 4]", code)

    def test_ktx_parse_reads_the_same(self):
        modules = os.environ.get("RNMBAKE_NODE_MODULES", "")
        if not shutil.which("node") or not (Path(modules) / "ktx-parse").is_dir():
            print("SKIPPED: no ktx-parse; npm install ktx-parse and name its node_modules in RNMBAKE_NODE_MODULES", file=sys.stderr)
            self.skipTest("SKIPPED: no ktx-parse")
        script = """const {read} = require(process.argv[1] + '/ktx-parse'), fs = require('fs');
const k = read(new Uint8Array(fs.readFileSync(process.argv[2])));
console.log(JSON.stringify([k.vkFormat, k.typeSize, k.pixelWidth, k.pixelHeight, k.pixelDepth, k.layerCount, k.faceCount,
  k.supercompressionScheme, k.levels.length, Buffer.from(k.levels[0].levelData).toString('hex'),
  k.dataFormatDescriptor[0].samples.map(s => [s.bitOffset, s.bitLength, s.channelType]), k.keyValue.KTXwriter]))"""
        for name, (*_, (width, height, depth, halves)) in self.volumes.items():
            answer = subprocess.run(["node", "-e", script, modules, str(self.folder / (name + ".vxgi.ktx2"))],
                                    check=True, timeout=60, capture_output=True).stdout
            found = json.loads(answer)
            self.assertEqual(found[:9], [97, 2, width, height, depth, 0, 1, 0, 1])
            self.assertEqual(bytes.fromhex(found[9]), struct.pack(f"<{len(halves)}e", *halves))
            self.assertEqual([sample[2] for sample in found[10]], [0xc0, 0xc1, 0xc2, 0xcf])
            self.assertTrue(found[11].startswith("rnmbake"))


class Threejs(Files):
    """The files; threejs_check.py has three.js itself."""
    form, what = "threejs", "all"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        about = json.loads((cls.folder / "light_probes.json").read_text(encoding="utf-8"))
        cls.volumes = {volume["name"]: volume for volume in about["volumes"]}
        cls.halves = {name: struct.unpack(f"<{(cls.folder / volume['file']).stat().st_size // 2}e",
                                          (cls.folder / volume["file"]).read_bytes())
                      for name, volume in cls.volumes.items() if "file" in volume}

    def look_up(self, name, place, normal):
        """Seven look-ups in the atlas, as three.js' shader; both along its axes."""
        place, normal, volume = known.y_up(place), known.y_up(normal), self.volumes[name]
        nx, ny, nz = volume["resolution"]
        # All boxes here have right angles.
        away = [place[c] - volume["first"][c] for c in range(3)]
        at = [sum(a * s for a, s in zip(away, step)) / sum(s * s for s in step) + .5 for step in volume["steps"]]
        size, halves = (nx, ny, 7 * (nz + 2)), self.halves[name]

        def texel(x, y, z):
            first = 4 * (x + nx * (y + ny * z))
            return halves[first:first + 4]

        numbers = []
        for pack in range(7):
            numbers += sampled(texel, size, (at[0], at[1], at[2] + pack * (nz + 2) + 1))
        return known.from_radiance([numbers[3 * k:3 * k + 3] for k in range(9)], normal)

    # Nine rounded coefficients make up a value: their magnitudes times the basis sum to less than 2.5 of the walls' light.
    TOLERANCE = 2.5 * known.HALF_STEP

    def test_walls(self):
        self.assert_walls(lambda place, normal: self.look_up("room", place, normal), self.TOLERANCE)

    def test_places(self):
        self.assert_boxes(self.look_up, known.NORMALS, self.TOLERANCE)

    def test_slices_between_the_packs_repeat_the_border(self):
        nx, ny, nz = self.volumes["hall"]["resolution"]
        self.assertEqual((nx, ny, nz), (2, 4, 3))
        row, halves = 4 * nx * ny, self.halves["hall"]
        slices = [halves[i:i + row] for i in range(0, len(halves), row)]
        self.assertEqual(len(slices), 7 * (nz + 2))
        for pack in range(0, len(slices), nz + 2):
            self.assertEqual(slices[pack], slices[pack + 1])
            self.assertEqual(slices[pack + nz + 1], slices[pack + nz])

    def test_says_what_is_turned(self):
        self.assertEqual({name: volume["alongAxes"] for name, volume in self.volumes.items() if "file" in volume},
                         {"room": True, "hall": True, "turned": False, "single": True})

    def test_points(self):
        volume = self.volumes["two points"]
        for (place, share), position, numbers in zip(known.POINTS.items(), volume["positions"], volume["coefficients"]):
            self.assertEqual(tuple(position), known.y_up(place))
            for normal in known.NORMALS:
                found = known.from_radiance([numbers[3 * k:3 * k + 3] for k in range(9)], known.y_up(normal))
                self.assert_light(found, [share * value for value in known.light(normal)], 1e-6)


class Cpp(Files):
    """The shipped header, compiled by the compiler that built rnmbake, as C++11."""
    form, what = "cpp", "all"
    PROGRAM = """#include "rnmbake_probes.h"
#include <cstdio>
int main(int, char** arguments) {
  rnmbake_probes::Volume volume;
  std::string problem;
  if (!volume.load(arguments[1], &problem)) { std::fprintf(stderr, "%s\\n", problem.c_str()); return 2; }
  float p[3], n[3], least;
  while (std::scanf("%f %f %f %f %f %f %f", p, p + 1, p + 2, n, n + 1, n + 2, &least) == 7) {
    const rnmbake_probes::Vector place{p[0], p[1], p[2]}, normal{n[0], n[1], n[2]};
    const rnmbake_probes::Vector light = volume.irradiance(place, normal, least);
    std::printf("%.9g %.9g %.9g %d\\n", light.x, light.y, light.z, volume.contains(place) ? 1 : 0);
  }
}
"""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        (cls.folder / "use.cpp").write_text(cls.PROGRAM, encoding="utf-8")
        cls.program = cls.folder / "use"
        subprocess.run([os.environ.get("CXX", "c++"), "-std=c++11", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion",
                        "-Wno-sign-conversion", "-Wshadow", "-Werror", "-o", str(cls.program), "use.cpp"],
                       check=True, timeout=120, cwd=cls.folder)

    def ask(self, name, queries, least=.75):
        """A list of (light, whether the place is in the box)."""
        text = "".join(" ".join(f"{v:.9g}" for v in (*place, *normal, least)) + "\n" for place, normal in queries)
        answer = subprocess.run([str(self.program), str(self.folder / (name + ".rnmprobes"))], input=text, text=True,
                                check=True, timeout=60, capture_output=True).stdout
        rows = [line.split() for line in answer.splitlines()]
        self.assertEqual(len(rows), len(queries))
        return [(tuple(map(float, row[:3])), row[3] == "1") for row in rows]

    def test_walls(self):
        self.assert_walls(lambda place, normal: self.ask("room", [(place, normal)])[0][0], 1e-6)

    def test_places(self):
        for name in known.BOXES:
            queries, expected = [], []
            for index in known.probes(name) + known.between(name):
                for normal in known.NORMALS:
                    queries.append((known.place(name, *index), normal))
                    expected.append((known.share(name, *index), normal, index))
            for (found, _), (share, normal, index) in zip(self.ask(name, queries, least=0), expected):
                self.assert_light(found, [share * value for value in known.light(normal)],
                                  share * (known.PLACE + 1e-6), f"{name} {index} {normal}")

    def test_buried_probes_count_only_alone(self):
        # Half-way to the buried probe (1, 2, 3) its seven neighbours are left; at its own place there is nothing else.
        normal = (0, 0, 1)
        others = [known.share("hall", x, y, z) for x in (0, 1) for y in (1, 2) for z in (2, 3) if (x, y, z) != (1, 2, 3)]
        answers = self.ask("hall", [(known.place("hall", .5, 1.5, 2.5), normal), (known.place("hall", 1, 2, 3), normal)])
        mean = sum(others) / 7
        self.assert_light(answers[0][0], [mean * v for v in known.light(normal)], 1e-5 * mean)
        alone = known.share("hall", 1, 2, 3)
        self.assert_light(answers[1][0], [alone * v for v in known.light(normal)], 1e-5 * alone)

    def test_beyond_the_box_is_its_border(self):
        _, normal = (0, 0, 0), (0, 0, 1)
        (found, inside), (_, within) = self.ask("hall", [((0, -30, 0), normal), ((10.25, -19, 4), normal)])
        self.assertFalse(inside)
        self.assertTrue(within)
        share = known.share("hall", 0, 0, 0)
        self.assert_light(found, [share * v for v in known.light(normal)], 1e-6 * share)

    def test_points_are_looked_up_by_the_nearest(self):
        for (found, _), share in zip(self.ask("two points", [((1, 2, 2), (1, 0, 0)), ((-4, 0, -6), (1, 0, 0))]), (1, .5)):
            self.assert_light(found, [share * v for v in known.light((1, 0, 0))], 1e-6)

    def test_damaged_files_are_refused(self):
        data = (self.folder / "room.rnmprobes").read_bytes()
        for name, damaged in {"short": data[:-1], "long": data + b"\0", "none": b"", "other": b"X" + data[1:],
                              "version": data[:8] + b"\2" + data[9:], "counts": data[:12] + b"\3" + data[13:]}.items():
            (self.folder / (name + ".rnmprobes")).write_bytes(damaged)
            outcome = subprocess.run([str(self.program), str(self.folder / (name + ".rnmprobes"))], input="", text=True,
                                     timeout=60, capture_output=True)
            self.assertEqual(outcome.returncode, 2, name)
            self.assertIn(name + ".rnmprobes", outcome.stderr)


if __name__ == "__main__":
    unittest.main()
