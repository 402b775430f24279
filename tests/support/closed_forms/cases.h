// closed_forms/cases.h - the scenes with one right answer for each basis vector, and what a bake made of
// them. Values are E/pi.
#pragma once

#include "closed_forms/workbench.h"
#include "encoding/basis_set.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace rnmbake {

/// One basis of one object whose texels all have the same right answer.
struct Outcome {
  std::string basis;
  double expected = 0;
  double mean = 0;
  double standard_error =
      0;                   // of the mean, from the spread over texels, or over 8 x 8 where they share paths
  double largest = 0;      // |value - expected| of the worst texel
  std::size_t texels = 0;  // covered

  [[nodiscard]] double error() const { return mean - expected; }
  /// What the mean may be off: 0.2 %, or three standard errors where noise is more than that.
  [[nodiscard]] double allowance() const;
};

/// flat, rnm0, rnm1, rnm2.
[[nodiscard]] const std::vector<BasisDirection>& baked_bases();

/// Compares the first channel of every covered texel with `truth` of each basis.
[[nodiscard]] std::vector<Outcome> compare(const LayeredImage& lightmap,
                                           const std::function<double(const BasisDirection&)>& truth);

/// A lit object that is the same everywhere.
struct UniformCase {
  std::string name, title;
  SceneChoice scene;
  std::string object;
  Words flags;  // resolution, samples, bounces
  std::function<double(const BasisDirection&)> truth;
};
[[nodiscard]] std::vector<UniformCase> uniform_cases();

/// One plane of the scene `suns`: where its sun stands in its tangent frame, and what is unusual about it.
struct SunCase {
  std::string prefix;  // "", "scaled_", ...
  double angle = 0;    // degrees off the normal
  int azimuth = 0;     // degrees from the tangent towards the bitangent

  [[nodiscard]] std::string object() const;
  [[nodiscard]] double truth(const BasisDirection& basis) const;
};
inline const std::vector<double> sun_angles{0, 30, 54.7, 70, 80, 85, 95};
inline const std::vector<int> sun_azimuths{0, 120, 210, 300};

/// The 28 plain planes: each angle with each azimuth.
[[nodiscard]] std::vector<SunCase> plain_suns();
/// The same sun on planes that are scaled, mirrored, have mirrored UVs, are far off or tiny.
[[nodiscard]] std::vector<SunCase> unusual_suns();
[[nodiscard]] Words sun_flags();

}  // namespace rnmbake
