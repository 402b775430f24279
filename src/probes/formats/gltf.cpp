// glTF: a cloud of points for each volume, the light in attributes of the application's own: _VALIDITY and
// _SH_0 to _SH_8, coefficients of radiance along glTF's axes. What a box is stands in its node's extras.
#include "base/version.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;

constexpr std::uint32_t float_component = 5126, array_buffer = 34962, points_mode = 0;

/// The document and its one buffer, which grow together.
class GltfPoints {
 public:
  GltfPoints() {
    document_ = {{"asset", {{"version", "2.0"}, {"generator", std::string("rnmbake ") + version}}},
                 {"scene", 0},
                 {"scenes", {{{"nodes", json::array()}}}}};
  }

  void add(const ProbeVolume& volume) {
    json extras = {{"light",
                    "_SH_0 to _SH_8: radiance, RGB, real spherical harmonics 1, y, z, x, xy, yz, "
                    "3z2-1, xz, x2-y2, orthonormal, glTF's axes"}};
    std::vector<const LightProbe*> probes;
    if (volume.grid) {
      const EngineBox box = engine_box(volume, y_up_axes(), "gltf");
      for (int z = 0; z < box.counts[2]; ++z)
        for (int y = 0; y < box.counts[1]; ++y)
          for (int x = 0; x < box.counts[0]; ++x) probes.push_back(&volume.probes[box.index(x, y, z)]);
      json steps = json::array();
      for (const Vec3d& step : box.steps) steps.push_back({step.x, step.y, step.z});
      extras["grid"] = {
          {"counts", box.counts}, {"first", {box.first.x, box.first.y, box.first.z}}, {"steps", steps}};
    } else {
      for (const LightProbe& probe : volume.probes) probes.push_back(&probe);
    }
    json node = {{"name", volume.name}, {"extras", {{"rnmbake_probes", extras}}}};
    if (!probes.empty()) {
      node["mesh"] =
          entry("meshes", {{"name", volume.name},
                           {"primitives", {{{"mode", points_mode}, {"attributes", attributes(probes)}}}}});
    }
    document_["scenes"][0]["nodes"].push_back(entry("nodes", node));
  }

  std::string glb() {
    if (!buffer_.empty()) document_["buffers"] = {{{"byteLength", buffer_.size()}}};
    if (document_["scenes"][0]["nodes"].empty()) document_["scenes"][0].erase("nodes");
    std::string text = document_.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t binary = buffer_.empty() ? 0 : 8 + buffer_.size();
    std::string bytes = "glTF";
    append_u32(bytes, 2);
    append_u32(bytes, static_cast<std::uint32_t>(20 + text.size() + binary));
    append_u32(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    if (!buffer_.empty()) {
      append_u32(bytes, static_cast<std::uint32_t>(buffer_.size()));
      bytes += std::string("BIN\0", 4) + buffer_;
    }
    return bytes;
  }

 private:
  std::size_t entry(const char* list, const json& value) {
    document_[list].push_back(value);
    return document_[list].size() - 1;
  }

  std::size_t accessor(const std::vector<float>& numbers, std::size_t width) {
    const std::size_t start = buffer_.size();
    for (const float number : numbers) append_float(buffer_, number);
    const std::size_t view = entry("bufferViews", {{"buffer", 0},
                                                   {"byteOffset", start},
                                                   {"byteLength", buffer_.size() - start},
                                                   {"target", array_buffer}});
    json least = json::array(), greatest = json::array();
    for (std::size_t c = 0; c < width; ++c) {
      float low = numbers[c], high = numbers[c];
      for (std::size_t i = c; i < numbers.size(); i += width) {
        low = std::min(low, numbers[i]);
        high = std::max(high, numbers[i]);
      }
      least.push_back(low);
      greatest.push_back(high);
    }
    return entry("accessors", {{"bufferView", view},
                               {"componentType", float_component},
                               {"count", numbers.size() / width},
                               {"type", width == 1 ? "SCALAR" : "VEC3"},
                               {"min", least},
                               {"max", greatest}});
  }

  json attributes(const std::vector<const LightProbe*>& probes) {
    std::vector<float> positions, validity;
    std::array<std::vector<float>, 9> harmonics;
    for (const LightProbe* probe : probes) {
      const Vec3d place = to_engine(y_up_axes(), probe->position);
      const auto light = turned(y_up_axes(), probe->harmonics);
      validity.push_back(probe->validity);
      for (int c = 0; c < 3; ++c) {
        positions.push_back(static_cast<float>(place[c]));
        for (std::size_t k = 0; k < 9; ++k) harmonics[k].push_back(light[k][c]);
      }
    }
    json found = {{"POSITION", accessor(positions, 3)}, {"_VALIDITY", accessor(validity, 1)}};
    for (std::size_t k = 0; k < 9; ++k) found["_SH_" + std::to_string(k)] = accessor(harmonics[k], 3);
    return found;
  }

  json document_;
  std::string buffer_;
};

}  // namespace

std::vector<FormatFile> gltf_files(std::span<const ProbeVolume> volumes) {
  GltfPoints points;
  for (const ProbeVolume& volume : volumes) points.add(volume);
  return {{"light_probes.glb", points.glb()}};
}

}  // namespace rnmbake
