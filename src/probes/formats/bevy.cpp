// Bevy's IrradianceVolume: an ambient cube for each probe in a texture of x, 2 y, 3 z texels. Slabs of z for
// the axes X, Y, Z; the half of greater y holds the negative sides. Its documentation says the opposite, its
// shader samples as is done here, and so does bevy-baked-gi write. The cube is along world axes however the
// box is turned: the shader turns places into the box, not normals.
#include "base/error.h"
#include "image/ktx2.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

#include <utility>

namespace rnmbake {
namespace {

std::string voxels(const ProbeVolume& volume, const EngineBox& box) {
  std::vector<std::array<Vec3, 6>> cubes;
  for (const LightProbe& probe : volume.probes) cubes.push_back(turned_cube(y_up_axes(), probe));
  std::string texels;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (int z = 0; z < box.counts[2]; ++z) {
      for (std::size_t negative = 0; negative < 2; ++negative) {
        for (int y = 0; y < box.counts[1]; ++y) {
          for (int x = 0; x < box.counts[0]; ++x) {
            const Vec3 light = cubes[box.index(x, y, z)][2 * axis + negative];
            for (int c = 0; c < 3; ++c) append_half(texels, light[c]);
            append_half(texels, 1);
          }
        }
      }
    }
  }
  const auto side = [&](std::size_t k) { return static_cast<std::uint32_t>(box.counts[k]); };
  return ktx2_of({.size = {side(0), 2 * side(1), 3 * side(2)}, .levels = {std::move(texels)}});
}

std::string row_of(const std::string& file, const EngineBox& box) {
  const Vec3d centre = box.centre(), size = box.size();
  const std::array<double, 4> turn = box.rotation();
  return fmt::format(
      "    BakedVolume {{\n        voxels: {},\n        translation: Vec3::new({}, {}, {}),\n"
      "        rotation: Quat::from_xyzw({}, {}, {}, {}),\n        scale: Vec3::new({}, {}, {}),\n    }},\n",
      string_literal(file), decimal(centre.x), decimal(centre.y), decimal(centre.z), decimal(turn[0]),
      decimal(turn[1]), decimal(turn[2]), decimal(turn[3]), decimal(size.x), decimal(size.y),
      decimal(size.z));
}

}  // namespace

std::vector<FormatFile> bevy_files(std::span<const ProbeVolume> volumes) {
  const std::vector<std::string> stems = volume_stems(volumes);
  std::vector<FormatFile> files;
  std::string rows;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    const EngineBox box = right_angled_box(volumes[i], y_up_axes(), "bevy");
    files.push_back({stems[i] + ".vxgi.ktx2", voxels(volumes[i], box)});
    rows += row_of(files.back().name, box);
  }
  FormatFile code = shipped_file("probes.rs");
  code.bytes += fmt::format("pub const BAKED_VOLUMES: [BakedVolume; {}] = [\n{}];\n", volumes.size(), rows);
  files.push_back(code);
  return files;
}

}  // namespace rnmbake
