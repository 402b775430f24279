// three.js' LightProbeGrid: nine coefficients of radiance, 27 numbers, in seven volumes of RGBA that are
// stacked along z. A slice before and one behind each volume repeats its border, so that a linear look-up
// does not mix volumes.
#include "base/version.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;

constexpr std::size_t pack_count = 7, pack_size = 4, number_count = 27;

std::array<float, number_count> numbers_of_probe(const LightProbe& probe) {
  const std::array<Vec3, 9> harmonics = turned(y_up_axes(), probe.harmonics);
  std::array<float, number_count> numbers{};
  for (std::size_t k = 0; k < 9; ++k)
    for (std::size_t c = 0; c < 3; ++c) numbers[3 * k + c] = harmonics[k][static_cast<int>(c)];
  return numbers;
}

std::string atlas(const ProbeVolume& volume, const EngineBox& box) {
  std::vector<std::array<float, number_count>> numbers;
  for (const LightProbe& probe : volume.probes) numbers.push_back(numbers_of_probe(probe));
  std::string texels;
  for (std::size_t pack = 0; pack < pack_count; ++pack) {
    for (int slice = -1; slice <= box.counts[2]; ++slice) {
      const int z = std::clamp(slice, 0, box.counts[2] - 1);
      for (int y = 0; y < box.counts[1]; ++y) {
        for (int x = 0; x < box.counts[0]; ++x) {
          const auto& probe = numbers[box.index(x, y, z)];
          for (std::size_t i = pack * pack_size; i < (pack + 1) * pack_size; ++i)
            append_half(texels, i < number_count ? probe[i] : 0.0F);
        }
      }
    }
  }
  return texels;
}

json vector_of(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

json about_box(const EngineBox& box, const std::string& file) {
  json steps = json::array();
  for (const Vec3d& step : box.steps) steps.push_back(vector_of(step));
  return {{"file", file},
          {"resolution", box.counts},
          {"first", vector_of(box.first)},
          {"steps", steps},
          {"alongAxes", box.along_axes()}};
}

json about_points(const ProbeVolume& volume) {
  json positions = json::array(), coefficients = json::array();
  for (const LightProbe& probe : volume.probes) {
    positions.push_back(vector_of(to_engine(y_up_axes(), probe.position)));
    coefficients.push_back(numbers_of_probe(probe));
  }
  return {{"positions", positions}, {"coefficients", coefficients}};
}

}  // namespace

std::vector<FormatFile> threejs_files(std::span<const ProbeVolume> volumes) {
  const std::vector<std::string> stems = volume_stems(volumes);
  std::vector<FormatFile> files;
  json list = json::array();
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    json about;
    if (volumes[i].grid) {
      const EngineBox box = engine_box(volumes[i], y_up_axes(), "threejs");
      files.push_back({stems[i] + ".bin", atlas(volumes[i], box)});
      about = about_box(box, files.back().name);
    } else {
      about = about_points(volumes[i]);
    }
    about["name"] = volumes[i].name;
    list.push_back(about);
  }
  const json document = {{"generator", std::string("rnmbake ") + version},
                         {"version", 1},
                         {"coefficients", "radiance, RGB, SphericalHarmonics3 of three.js, Y up"},
                         {"volumes", list}};
  files.push_back({"light_probes.json", document.dump(1, ' ', false, json::error_handler_t::replace) + "\n"});
  files.push_back(shipped_file("probes.js"));
  files.push_back(shipped_file("index.html"));
  return files;
}

}  // namespace rnmbake
