// probes/probe_lights.h - which part of a scene's light its probes hold.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

namespace rnmbake {

enum class ProbeLights {
  all,       // all that arrives
  no_lamps,  // all but what comes straight from lamp objects (sun, point, spot, area), which an engine keeps
             // as lights of its own; what surfaces send on of them stays in, as do glowing surfaces and the
             // sky
  bounced,   // what a surface has sent on, or a volume: nothing straight from lamps, glowing surfaces or sky
};

/// As flags and files say it.
inline constexpr std::array<std::string_view, 3> probe_lights_names{"all", "static", "indirect"};

[[nodiscard]] inline std::optional<ProbeLights> probe_lights_of(std::string_view name) {
  const auto found = std::ranges::find(probe_lights_names, name);
  if (found == probe_lights_names.end()) return std::nullopt;
  return static_cast<ProbeLights>(found - probe_lights_names.begin());
}

}  // namespace rnmbake
