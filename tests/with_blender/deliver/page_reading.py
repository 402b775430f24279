"""Pages as others read them: pictures by oiiotool, KTX2 files by npm's ktx-parse, blocks by OpenImageIO's decoder, packed floats
as their specification says. All as rows of RGB from the top, one list."""
import base64
import json
import math
import os
from pathlib import Path
import struct
import subprocess

from pictures import read_picture

# Zstandard by what three.js ships, so that node needs none of its own.
PARSE = """
import fs from 'fs'; import { pathToFileURL as url } from 'url';
const [modules, file] = process.argv.slice(1);
const { read } = await import(url(modules + '/ktx-parse/dist/index.mjs'));
const parsed = read(new Uint8Array(fs.readFileSync(file)));
let decode = (level) => level.levelData;
if (parsed.supercompressionScheme === 2) {
  const { ZSTDDecoder } = await import(url(modules + '/three/examples/jsm/libs/zstddec.module.js'));
  const zstd = new ZSTDDecoder();
  await zstd.init();
  decode = (level) => zstd.decode(level.levelData, level.uncompressedByteLength);
}
console.log(JSON.stringify({ ...parsed, levels: parsed.levels.map((level) => Buffer.from(decode(level)).toString('base64')),
                             stored: parsed.levels.map((level) => level.levelData.length) }));
"""
RGBA16F, B10G11R11, E5B9G9R9, BC6H_UF, BC6H_SF = 97, 122, 123, 143, 144
TEXEL_BYTES = {RGBA16F: 8, B10G11R11: 4, BC6H_UF: 1, BC6H_SF: 1}


def parse_ktx2(modules, file):
    """What ktx-parse says of it, with the bytes of its levels."""
    done = subprocess.run(["node", "--input-type=module", "-e", PARSE, str(Path(modules).resolve()), str(file)],
                          capture_output=True, text=True, check=True, env={**os.environ})
    parsed = json.loads(done.stdout)
    parsed["levels"] = [base64.b64decode(level) for level in parsed["levels"]]
    return parsed


def picture(file):
    """Of an EXR, Radiance's picture or DDS file."""
    return [tuple(pixel[channel] for channel in "RGB") for row in read_picture(file)[2] for pixel in row]


def level_texels(parsed, level, folder):
    """RGB of one level of a parsed KTX2 file."""
    width, height = (max(1, parsed[side] >> level) for side in ("pixelWidth", "pixelHeight"))
    data, format_ = parsed["levels"][level], parsed["vkFormat"]
    if format_ in (BC6H_UF, BC6H_SF):
        return blocks(data, width, height, format_ == BC6H_SF, folder)
    if format_ == RGBA16F:
        return [texel[:3] for texel in struct.iter_unpack("<4e", data)]
    unpack = e5b9g9r9 if format_ == E5B9G9R9 else b10g11r11
    return [unpack(bits) for (bits,) in struct.iter_unpack("<I", data)]


def b10g11r11(bits):
    def small_float(value, mantissa):
        exponent, rest = value >> mantissa, value & (1 << mantissa) - 1
        return math.ldexp(rest, -14 - mantissa) if exponent == 0 else math.ldexp(rest + (1 << mantissa), exponent - 15 - mantissa)
    return small_float(bits & 2047, 6), small_float(bits >> 11 & 2047, 6), small_float(bits >> 22, 5)


def e5b9g9r9(bits):
    return tuple(math.ldexp(bits >> shift & 511, (bits >> 27) - 24) for shift in (0, 9, 18))


def blocks(data, width, height, is_signed, folder):
    """Through a DDS file, https://learn.microsoft.com/windows/win32/direct3ddds/dds-header."""
    header = struct.pack("<4s7I44x", b"DDS ", 124, 0x81007, height, width, len(data), 0, 0)
    header += struct.pack("<2I4s20x", 32, 4, b"DX10") + struct.pack("<I16x", 0x1000)
    file = Path(folder) / "blocks.dds"
    file.write_bytes(header + struct.pack("<5I", 96 if is_signed else 95, 3, 0, 1, 0) + data)
    return picture(file)
