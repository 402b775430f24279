// bench/volumes/leaks.h - light that probes let through walls.
#pragma once

#include <filesystem>
#include <vector>

#include <nlohmann/json.hpp>

namespace rnmbake {

struct LeakStudy {
  std::filesystem::path two_rooms;  // .rnmscene of scenes/two_rooms.py
  std::vector<double> spacings;
  int samples = 256;
};

/// For each case, spacing and leak test, means over places where it is dark and normals in shares of the
/// bright side's light: "truth", what arrives there; "excess", what is looked up less that; "largest" of it
/// at a place; "through", what is looked up of probes on the other side of the wall. Harmonics of order 3.
[[nodiscard]] nlohmann::json study_leaks(const LeakStudy& study);

}  // namespace rnmbake
