// probes/probe_lights.h - which part of a scene's light its probes hold.
#pragma once

#include <array>
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

}  // namespace rnmbake
