// Unity's light probes: places and SphericalHarmonicsL2, whose coefficients are those of radiance times the
// clamped cosine's shares over pi times the harmonics' norms, so that E/pi = c0 + c1 y + c2 z + c3 x + c4 xy
// + c5 yz + c6 (3z2 - 1) + c7 xz + c8 (x2 - y2). A script of the editor puts them into a scene.
#include "encoding/sh.h"
#include "probes/formats/engine_box.h"
#include "probes/formats/makers.h"

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;

/// Norms times shares: the values of A(l) Y(l, m) where its polynomial is 1.
constexpr std::array<float, 9> unity_factors{0.28209479F,         0.48860251F * 2 / 3, 0.48860251F * 2 / 3,
                                             0.48860251F * 2 / 3, 1.09254843F / 4,     1.09254843F / 4,
                                             0.31539157F / 4,     1.09254843F / 4,     0.54627422F / 4};

json unity_volume(const ProbeVolume& volume) {
  json positions = json::array(), coefficients = json::array();
  for (const LightProbe& probe : volume.probes) {
    const Vec3d place = to_engine(unity_axes(), probe.position);
    const std::array<Vec3, 9> harmonics = turned(unity_axes(), probe.harmonics);
    for (int c = 0; c < 3; ++c) positions.push_back(static_cast<float>(place[c]));
    for (std::size_t k = 0; k < 9; ++k)
      for (int c = 0; c < 3; ++c) coefficients.push_back(harmonics[k][c] * unity_factors[k]);
  }
  return {{"name", volume.name}, {"positions", positions}, {"coefficients", coefficients}};
}

}  // namespace

std::vector<FormatFile> unity_files(std::span<const ProbeVolume> volumes) {
  json list = json::array();
  for (const ProbeVolume& volume : volumes) list.push_back(unity_volume(volume));
  const json document = {{"version", 1}, {"volumes", list}};
  return {{"light_probes_unity.json", document.dump(-1, ' ', false, json::error_handler_t::replace) + "\n"},
          shipped_file("RnmbakeLightProbes.cs")};
}

}  // namespace rnmbake
