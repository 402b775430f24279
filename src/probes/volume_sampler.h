// probes/volume_sampler.h - light at any place of a volume, for a surface of any normal.
#pragma once

#include "probes/cell_lookup.h"
#include "probes/probe_volume.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rnmbake {

/// What is kept of a probe, and decoded: 6, 6, 4, 4 and 9 colours.
enum class ProbeEncoding {
  cube,      // ambient cube, exact at its axes (encoding/ambient_cube.h); as Source's vrad fills it
  cube_fit,  // ambient cube of least squares over the probe's directions
  sh2,       // bands 0 and 1 of the harmonics
  zh3,       // the same numbers, decoded with a zonal lobe of band 2 (encoding/zh3.h)
  sh3,       // bands 0 to 2
};
inline constexpr std::array<std::string_view, 5> probe_encoding_names{"cube", "cube-fit", "sh2", "zh3",
                                                                      "sh3"};
[[nodiscard]] std::optional<ProbeEncoding> probe_encoding_of(std::string_view name);

/// Which of the probes around a place may light it.
enum class LeakTest {
  none,        // all, by their distance
  validity,    // those that stand in the open
  visibility,  // those that see it, by the distances around each probe; needs ProbeVolume::depths
};
inline constexpr std::array<std::string_view, 3> leak_test_names{"none", "validity", "visibility"};
[[nodiscard]] std::optional<LeakTest> leak_test_of(std::string_view name);

/// Those that all boxes among the volumes allow, the best last.
[[nodiscard]] std::vector<LeakTest> leak_tests_for(std::span<const ProbeVolume> volumes);

/// Colours that are kept of a probe.
[[nodiscard]] std::size_t coefficients_of(ProbeEncoding encoding);
/// Coefficients of one probe, E/pi.
[[nodiscard]] std::vector<Vec3> encoded_probe(const LightProbe& probe, ProbeEncoding encoding);
/// E/pi, RGB, for a unit normal, world space. May be negative where the encoding is.
[[nodiscard]] Vec3 decoded_probe(std::span<const Vec3> coefficients, ProbeEncoding encoding,
                                 const Vec3& normal);

/// Interpolates a grid, or its tree (probes/cell_lookup.h); thread-safe. The volume must outlive it.
class VolumeSampler {
 public:
  /// Throws Error(unsupported) for points without a grid, and for visibility where there are no distances.
  VolumeSampler(const ProbeVolume& volume, ProbeEncoding encoding, LeakTest test);

  /// E/pi, RGB, at a place, for a surface with that unit normal, world space. Places outside of the grid are
  /// lit as the nearest on its border.
  [[nodiscard]] Vec3 irradiance(const Vec3d& place, const Vec3& normal) const;

  /// Probes that light such a surface; their weights sum to 1.
  [[nodiscard]] ProbeShares shares(const Vec3d& place, const Vec3& normal) const;

 private:
  [[nodiscard]] float leak_weight(std::size_t probe, const Vec3d& place, const Vec3& normal) const;

  const ProbeVolume& volume_;
  ProbeEncoding encoding_;
  LeakTest test_;
  std::size_t coefficients_;
  CellLookup cells_;
  std::vector<Vec3> values_;    // [probes][coefficients]
  std::vector<double> biases_;  // [probes]; of places along their normal, where visibility is tested
};

}  // namespace rnmbake
