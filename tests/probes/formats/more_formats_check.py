"""The same as formats_check.py for glTF, VRC Light Volumes, Godot and Unity.

    SAMPLE_FORMATS=build/release/tests/sample_formats python3 tests/probes/formats/more_formats_check.py

With node and npm's gltf-validator in node_modules of the folder that RNMBAKE_NODE_MODULES names, that has its say, too.
"""
import itertools
import json
import math
import os
from pathlib import Path
import random
import re
import shutil
import struct
import subprocess
import sys
import unittest

sys.path.insert(0, str(Path(__file__).resolve().parent))
import known_light as known  # noqa: E402
from reading import Files, sampled, turned_by  # noqa: E402

FLOATS = 2e-6  # what sums of nine products of floats may be off, of light of about 1


class Gltf(Files):
    form, what = "gltf", "all"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        data = (cls.folder / "light_probes.glb").read_bytes()
        magic, version, length, text_size, text_kind = struct.unpack_from("<4sIIII", data)
        if (magic, version, length, text_kind) != (b"glTF", 2, len(data), 0x4e4f534a) or text_size % 4:
            raise ValueError("no GLB")
        cls.document = json.loads(data[20:20 + text_size])
        size, kind = struct.unpack_from("<II", data, 20 + text_size)
        if kind != 0x004e4942 or 28 + text_size + size != length or size != cls.document["buffers"][0]["byteLength"]:
            raise ValueError("no binary chunk")
        cls.binary = data[28 + text_size:]

    def rows(self, accessor):
        about = self.document["accessors"][accessor]
        view = self.document["bufferViews"][about["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3}[about["type"]]
        self.assertEqual(about["componentType"], 5126)
        self.assertEqual(view["byteLength"], 4 * width * about["count"])
        numbers = struct.unpack_from(f"<{width * about['count']}f", self.binary, view["byteOffset"])
        return [numbers[i:i + width] for i in range(0, len(numbers), width)]

    def probes(self, name):
        node = next(one for one in self.document["nodes"] if one["name"] == name)
        primitive = self.document["meshes"][node["mesh"]]["primitives"][0]
        self.assertEqual(primitive["mode"], 0)
        rows = {key: self.rows(accessor) for key, accessor in primitive["attributes"].items()}
        light = [list(coefficients) for coefficients in zip(*(rows[f"_SH_{k}"] for k in range(9)))]
        return list(zip(rows["POSITION"], light, rows["_VALIDITY"])), node["extras"]["rnmbake_probes"]

    def test_light_stands_where_it_was_gathered(self):
        for name in known.BOXES:
            found, extras = self.probes(name)
            self.assertEqual(len(found), len(known.probes(name)))
            expected = {index: known.y_up(known.place(name, *index)) for index in known.probes(name)}
            nx, ny, _ = extras["grid"]["counts"]
            for count, (position, coefficients, validity) in enumerate(found):
                index = min(expected, key=lambda one: math.dist(expected[one], position))
                self.assertLess(math.dist(expected.pop(index), position), 4e-6)
                share = known.share(name, *index)
                self.assertEqual(validity, (.125 if name == "hall" and index == (1, 2, 3) else 1,))
                for normal in known.NORMALS:
                    self.assert_light(known.from_radiance(coefficients, known.y_up(normal)),
                                      [share * value for value in known.light(normal)], FLOATS * share, f"{name} {index}")
                # The extras say the same place.
                steps = (count % nx, count // nx % ny, count // (nx * ny))
                place = [extras["grid"]["first"][c] + sum(steps[k] * extras["grid"]["steps"][k][c] for k in range(3)) for c in range(3)]
                self.assertLess(math.dist(place, position), 4e-6)

    def test_walls(self):
        _, coefficients, _ = self.probes("room")[0][0]
        self.assert_walls(lambda _, normal: known.from_radiance(coefficients, known.y_up(normal)), FLOATS)

    def test_points(self):
        found, extras = self.probes("two points")
        self.assertNotIn("grid", extras)
        for (place, share), (position, coefficients, _) in zip(known.POINTS.items(), found):
            self.assertEqual(position, known.y_up(place))
            self.assert_light(known.from_radiance(coefficients, known.y_up((0, 1, 0))), [share * v for v in known.light((0, 1, 0))], FLOATS)

    def test_validator_has_no_word_against_it(self):
        modules = os.environ.get("RNMBAKE_NODE_MODULES", "")
        if not shutil.which("node") or not (Path(modules) / "gltf-validator").is_dir():
            print("SKIPPED: no gltf-validator; npm install it and name its node_modules in RNMBAKE_NODE_MODULES", file=sys.stderr)
            self.skipTest("SKIPPED: no gltf-validator")
        script = """require(process.argv[1] + '/gltf-validator').validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[2])))
.then(report => console.log(JSON.stringify(report.issues)))"""
        answer = subprocess.run(["node", "-e", script, modules, str(self.folder / "light_probes.glb")],
                                check=True, timeout=60, capture_output=True).stdout
        issues = json.loads(answer)
        self.assertEqual((issues["numErrors"], issues["numWarnings"], issues["numInfos"]), (0, 0, 0), issues["messages"])


class Vrc(Files):
    """As the package's packer takes the textures, and its shader then reads them."""
    form = "vrc"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        script = (cls.folder / "RnmbakeLightVolumes.cs").read_text(encoding="utf-8")
        pattern = r'new BakedVolume\("(\w+)", new Vector3{0}, new Quaternion{0},\s*new Vector3{0}, new Vector3Int{0}\)'
        cls.volumes = {}
        for name, *rows in re.findall(pattern.replace("{0}", r"\(([^)]*)\)"), script):
            numbers = [tuple(float(one.strip().removesuffix("f")) for one in row.split(",")) for row in rows]
            cls.volumes[name] = numbers + [cls.texture(name, number) for number in range(3)]

    @classmethod
    def texture(cls, name, number):
        lines = (cls.folder / f"{name}_{number}.asset").read_text(encoding="ascii").splitlines()
        values = dict(line.lstrip().split(": ", 1) for line in lines if ": " in line)
        if lines[:4] != ["%YAML 1.1", "%TAG !u! tag:unity3d.com,2011:", "--- !u!117 &11700000", "Texture3D:"]:
            raise ValueError("no Texture3D")
        if values["m_Format"] != "48" or values["m_MipCount"] != "1" or values["m_Name"] != f'"{name}_{number}"':
            raise ValueError(f"{values}")
        size = tuple(int(values["m_" + side]) for side in ("Width", "Height", "Depth"))
        data = bytes.fromhex(values["_typelessdata"])
        if {len(data)} != {8 * size[0] * size[1] * size[2], int(values["m_DataSize"]), int(values["image data"])}:
            raise ValueError("sizes")
        return size, struct.unpack(f"<{len(data) // 2}e", data)

    def look_up(self, name, place, normal):
        place, normal = known.unity(place), known.unity(normal)
        centre, rotation, scale, resolution, *textures = self.volumes[name]
        within = turned_by((-rotation[0], -rotation[1], -rotation[2], rotation[3]), [place[c] - centre[c] for c in range(3)])
        numbers = []
        for size, halves in textures:
            self.assertEqual(size, resolution)
            at = [(within[c] / scale[c] + .5) * size[c] for c in range(3)]
            numbers.append(sampled(lambda x, y, z, s=size, h=halves: h[4 * (x + s[0] * (y + s[1] * z)):][:4], size, at))
        first, second, third = numbers
        light = []
        for channel, up in enumerate((first[3], second[3], third[3])):
            along = [.5 * v for v in (second[channel], third[channel], up)]
            length = math.sqrt(sum(v * v for v in along))
            along = [v * min(first[channel] / length, 1.13) for v in along] if length else along  # the packer's
            light.append(first[channel] + sum(v * n for v, n in zip(along, normal)))
        return light

    @staticmethod
    def expected(normal):
        """Bands 0 and 1 of the walls' light: the mean of the even part, and the odd part."""
        even = [sum(known.WALLS[axis][c] for axis in known.AXES) / 6 for c in range(3)]
        ahead, behind = known.light(normal), known.light([-n for n in normal])
        return [even[c] + (ahead[c] - behind[c]) / 2 for c in range(3)]

    def test_walls_and_places(self):
        # Four rounded numbers, the second to fourth below the first; places as in known_light.
        self.assertEqual(set(self.volumes), set(known.BOXES))
        for name in known.BOXES:
            for index in known.probes(name) + known.between(name):
                share = known.share(name, *index)
                for normal in known.NORMALS:
                    self.assert_light(self.look_up(name, known.place(name, *index), normal), [share * v for v in self.expected(normal)],
                                      share * (4 * known.HALF_STEP + known.PLACE), f"{name} {index} {normal}")
        # Where a wall stands the light is that wall's, of the two that face each other.
        for axis, normal in known.AXES.items():
            found = self.look_up("room", (.3, -.2, .1), normal)
            nearest = min(known.AXES, key=lambda one: math.dist(found, known.WALLS[one]))
            self.assertEqual(nearest, axis)

    def test_the_script_is_whole(self):
        script = (self.folder / "RnmbakeLightVolumes.cs").read_text(encoding="utf-8")
        self.assertEqual(script.count("{"), script.count("}"))
        self.assertNotIn("// volumes\n", script)


class Godot(Files):
    """As LightStorage::lightmap_tap_sh_light of Godot 4 finds a tetrahedron, and its scene shader reads the colours."""
    form = "godot"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.volumes = {}
        for name in known.BOXES:
            text = (cls.folder / (name + ".tres")).read_text(encoding="ascii")
            if not text.startswith('[gd_resource type="LightmapGIData" format=3]\n\n[resource]\nprobe_data = {\n') or not text.endswith("\n}\n"):
                raise ValueError("no resource")
            values = {key: [float(one) for one in numbers.split(",")]
                      for key, numbers in re.findall(r'"(\w+)": \w+\(([^)]*)\)', text)}
            if set(values) != {"bounds", "bsp", "points", "sh", "tetrahedra"} or '"interior": true' not in text or '"baked_exposure": 1.0' not in text:
                raise ValueError("keys")
            bits = [int(number) for number in values["bsp"]]
            nodes = [struct.unpack("<4f", struct.pack("<4i", *bits[i:i + 4])) + tuple(bits[i + 4:i + 6]) for i in range(0, len(bits), 6)]
            corners = [int(number) for number in values["tetrahedra"]]
            cls.volumes[name] = (values["bounds"], nodes, [corners[i:i + 4] for i in range(0, len(corners), 4)],
                                 [values["points"][i:i + 3] for i in range(0, len(values["points"]), 3)],
                                 [values["sh"][i:i + 36] for i in range(0, len(values["sh"]), 36)])

    @staticmethod
    def volume_of(a, b, c, d):
        (u, v, w) = ([p[i] - a[i] for i in range(3)] for p in (b, c, d))
        return sum(u[i] * (v[(i + 1) % 3] * w[(i + 2) % 3] - v[(i + 2) % 3] * w[(i + 1) % 3]) for i in range(3))

    def found(self, name, place):
        """The tetrahedron's corners and the place's barycentric coordinates; `place` in Godot's world."""
        _, nodes, tetrahedra, points, _ = self.volumes[name]
        at = 0
        while at >= 0:
            x, y, z, distance, over, under = nodes[at]
            child = over if x * place[0] + y * place[1] + z * place[2] > distance else under
            self.assertTrue(child < 0 or child > at, "Godot refuses children that come before their parents")
            at = child
        corners = tetrahedra[abs(at) - 1]
        places = [points[corner] for corner in corners]
        whole = self.volume_of(*places)
        return corners, [self.volume_of(*(place if i == k else p for i, p in enumerate(places))) / whole for k in range(4)]

    def look_up(self, name, place, normal):
        corners, shares = self.found(name, known.y_up(place))
        colours = self.volumes[name][4]
        numbers = [sum(min(max(share, 0), 1) * colours[corner][i] for corner, share in zip(corners, shares)) for i in range(36)]
        x, y, z = known.y_up(normal)
        factors = [.886227, 1.023327 * y, 1.023327 * z, 1.023327 * x, .858086 * x * y, .858086 * y * z,
                   .247708 * (3 * z * z - 1), .858086 * x * z, .429043 * (x * x - y * y)]
        return [sum(factors[k] * numbers[4 * k + c] for k in range(9)) for c in range(3)]

    def test_walls(self):
        self.assert_walls(lambda place, normal: self.look_up("room", place, normal), 1e-5)

    def test_places(self):
        # At probes, and half-way along edges, where a tetrahedron's interpolation is that of the edge.
        for name in known.BOXES:
            counts = known.BOXES[name][0]
            edges = [tuple(index[c] + (.5 if c == axis else 0) for c in range(3))
                     for index in known.probes(name) for axis in range(3) if index[axis] + 1 < counts[axis]]
            for index in known.probes(name) + edges:
                share = known.share(name, *index)
                for normal in known.NORMALS:
                    self.assert_light(self.look_up(name, known.place(name, *index), normal), [share * v for v in known.light(normal)],
                                      share * (1e-5 + known.PLACE), f"{name} {index} {normal}")

    def test_every_place_is_in_the_tetrahedron_that_is_found(self):
        chance = random.Random(1)
        for name, (counts, *_) in known.BOXES.items():
            _, nodes, tetrahedra, points, _ = self.volumes[name]
            # One layer alone is written twice, half a step to either side.
            ranges = [(0, count - 1) if count > 1 else (-.5, .5) for count in counts]
            cells = math.prod(max(count - 1, 1) for count in counts)
            self.assertEqual((len(tetrahedra), len(nodes), len(points)), (6 * cells, 6 * cells - 1, math.prod(max(count, 2) for count in counts)))
            seen = set()
            for _ in range(4000):
                place = known.y_up(known.place(name, *(chance.uniform(*one) for one in ranges)))
                corners, shares = self.found(name, place)
                self.assertGreater(min(shares), -known.PLACE)
                seen.add(tuple(corners))
            self.assertEqual(len(seen), 6 * cells)

    def test_bounds_hold_every_probe(self):
        for name in known.BOXES:
            bounds, *_, points, _ = self.volumes[name]
            for axis in range(3):
                self.assertAlmostEqual(bounds[axis], min(point[axis] for point in points), places=5)
                self.assertAlmostEqual(bounds[axis] + bounds[3 + axis], max(point[axis] for point in points), places=5)


class Unity(Files):
    form, what = "unity", "all"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        document = json.loads((cls.folder / "light_probes_unity.json").read_text(encoding="utf-8"))
        cls.volumes = {volume["name"]: volume for volume in document["volumes"]}

    def look_up(self, name, index, normal):
        """By the constants that Unity makes for shaders: unity_SHA*, unity_SHB*, unity_SHC."""
        x, y, z = known.unity(normal)
        numbers = self.volumes[name]["coefficients"][27 * index:27 * index + 27]
        light = []
        for channel in range(3):
            sh = numbers[channel::3]
            linear = (sh[3], sh[1], sh[2], sh[0] - sh[6])
            quadratic = (sh[4], sh[5], sh[6] * 3, sh[7])
            light.append(sum(a * b for a, b in zip(linear, (x, y, z, 1))) + sum(a * b for a, b in zip(quadratic, (x * y, y * z, z * z, z * x)))
                         + sh[8] * (x * x - y * y))
        return light

    def test_walls_and_places(self):
        self.assert_walls(lambda _, normal: self.look_up("room", 0, normal), FLOATS)
        for name in known.BOXES:
            positions = self.volumes[name]["positions"]
            for count, index in enumerate(known.probes(name)):
                self.assertLess(math.dist(positions[3 * count:3 * count + 3], known.unity(known.place(name, *index))), 4e-6)
                share = known.share(name, *index)
                for normal in known.NORMALS:
                    self.assert_light(self.look_up(name, count, normal), [share * v for v in known.light(normal)], FLOATS * share)

    def test_points(self):
        for count, (place, share) in enumerate(known.POINTS.items()):
            self.assertEqual(tuple(self.volumes["two points"]["positions"][3 * count:3 * count + 3]), known.unity(place))
            self.assert_light(self.look_up("two points", count, (1, 0, 0)), [share * v for v in known.light((1, 0, 0))], FLOATS)

    def test_the_script_is_whole_and_reads_these_keys(self):
        script = (self.folder / "RnmbakeLightProbes.cs").read_text(encoding="utf-8")
        self.assertEqual(script.count("{"), script.count("}"))
        for key in itertools.chain(("version", "volumes"), self.volumes["room"]):
            self.assertRegex(script, rf"public \S+ {key};")


if __name__ == "__main__":
    unittest.main()
