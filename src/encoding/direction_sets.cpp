#include "encoding/direction_sets.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Three directions tilted by `tilt` degrees, the first of them at `azimuth`.
void add_ring(BasisSet& set, double tilt, double azimuth) {
  for (int i = 0; i < 3; ++i) {
    const Vec3d direction = direction_at(tilt * pi / 180, (azimuth + 120 * i) * pi / 180);
    set.directions.push_back({fmt::format("d{}", set.directions.size() - 4), Vec3(direction)});
  }
}

/// Evenly over rings, which are turned against each other.
void add_tested(BasisSet& set) {
  struct Ring {
    double tilt;
    int count;
  };
  double turn = 0.1;
  for (const auto& [tilt, count] : {Ring{12.5, 5}, Ring{35, 8}, Ring{52, 11}, Ring{75, 12}}) {
    for (int i = 0; i < count; ++i) {
      const Vec3d direction = direction_at(tilt * pi / 180, 2 * pi * (i + turn) / count);
      set.directions.push_back({fmt::format("t{}_{:02}", static_cast<int>(tilt), i), Vec3(direction)});
    }
    turn += 0.15;
  }
}

}  // namespace

std::optional<BasisSet> direction_set(std::string_view name) {
  const bool is_h6 = name == "h6" || name == "sg", is_study = name == "study",
             is_sh3 = name == "sh3" || is_study;
  if (!is_h6 && !is_sh3 && name != "l1") return std::nullopt;
  BasisSet set = flat_and_rnm();
  set.name = name;
  add_ring(set, std::acos(std::sqrt(1.0 / 3)) * 180 / pi, 60);
  if (is_h6 || is_sh3) add_ring(set, 30, 0);
  if (is_sh3) add_ring(set, 80, 60);
  if (is_study) add_tested(set);
  return set;
}

std::string name_of_set(const std::vector<BasisDirection>& directions) {
  const auto is_all_of = [&](const BasisSet& set) {
    return set.directions.size() == directions.size() &&
           std::ranges::all_of(directions,
                               [&](const auto& basis) { return place_of(set, basis).has_value(); });
  };
  for (const char* name : {"l1", "h6", "sh3", "study"})
    if (is_all_of(*direction_set(name))) return name;
  if (is_all_of(flat_and_rnm())) return "rnm";
  std::string names;
  for (const BasisDirection& basis : directions) names += (names.empty() ? "" : ",") + basis.name;
  return names;
}

}  // namespace rnmbake
