// probes/probe_volume.h - light probes: what of a scene's light is known at points in free space.
#pragma once

#include "base/math.h"
#include "probes/probe_directions.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rnmbake {

/// Of one volume; more are a slip of the keyboard.
inline constexpr int most_probes = 4'000'000;

/// A box of probes, not necessarily along the world's axes. World space.
struct ProbeGrid {
  std::array<int, 3> counts{1, 1, 1};
  Vec3d first{0, 0, 0};  // the first probe's place
  std::array<Vec3d, 3> steps{Vec3d(1, 0, 0), Vec3d(0, 1, 0),
                             Vec3d(0, 0, 1)};  // to the next probe of each axis

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
           static_cast<std::size_t>(counts[2]);
  }
  /// x fastest, z slowest.
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(counts[0]) *
               (static_cast<std::size_t>(y) +
                static_cast<std::size_t>(counts[1]) * static_cast<std::size_t>(z));
  }
  [[nodiscard]] Vec3d place(int x, int y, int z) const {
    return first + steps[0] * x + steps[1] * y + steps[2] * z;
  }
  /// In steps from the first probe. The steps must span space.
  [[nodiscard]] Vec3d coordinates(const Vec3d& world) const;
};

/// Light at one point, from all around.
struct LightProbe {
  enum class State { sound, moved, filled };

  /// Dark: Imath's vectors begin as what the memory holds.
  LightProbe() {
    irradiance.fill(Vec3(0));
    standard_error.fill(Vec3(0));
    harmonics.fill(Vec3(0));
  }

  Vec3d position{0, 0, 0};             // where it was gathered, world space
  PerProbeDirection<Vec3> irradiance;  // E/pi, RGB, at probe_directions()
  PerProbeDirection<Vec3> standard_error;
  std::array<Vec3, 9> harmonics;  // of radiance, world space: encoding/sh.h
  float validity = 1;             // share of its rays that met no back face
  State state = State::sound;     // moved: off its place, out of geometry; filled: from its neighbours
};

/// Distances that a probe's rays go, over octahedral maps; for tests of visibility (probes/volume_sampler.h).
struct ProbeDepths {
  int side = 0;               // texels of each map; 0: there are none
  std::vector<float> mean;    // [probes][side][side], units of the scene, cut off at some reach
  std::vector<float> square;  // the mean of their squares
};

/// The space between eight probes, or eight smaller cells.
struct ProbeCell {
  std::array<std::uint32_t, 8> corners{};  // numbers of probes, x fastest
  std::uint32_t children = 0;              // number of the first of its eight cells, x fastest; 0: none
};

/// Octrees in the cells of a grid, whose probes stand closer where light varies (probes/probe_tree.h).
struct ProbeTree {
  std::vector<ProbeCell> cells;  // the grid's own first, counts - 1 of each axis, x fastest; no child before
                                 // its parent
};

/// A box of probes, or points alone.
struct ProbeVolume {
  std::string name;
  std::optional<ProbeGrid> grid;
  std::vector<LightProbe> probes;  // of a grid: in the order of ProbeGrid::index(), then those of the tree
  ProbeDepths depths;
  std::optional<ProbeTree> tree = std::nullopt;  // of a grid
};

}  // namespace rnmbake
