// Light of one room in the next: what leaks through walls between probes.
#include "pipeline/probes/lit_probes.h"
#include "pipeline/probes/settle_probes.h"
#include "probes/fill_probes.h"
#include "probes/place_probes.h"
#include "probes/volume_sampler.h"
#include "trace/trace_scenes.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// Probes over both rooms, as the command makes them; with a wanted error as a tree.
ProbeVolume lit_volume(const DiffuseScene& scene, const ProbeBounds& bounds, double spacing,
                       const RefineOptions& refine = {}) {
  const TraceScene traced(scene, "4.3.2");
  ProbeVolume volume =
      empty_volume("rooms", grid_in(bounds, spacing, 1000, refine.error > 0 ? refine.levels : 0));
  settle_probes(traced, {}, volume);
  const LightProbes light = by_reference(traced, 256);
  light(valid_probes(volume), 0);
  refine_probes(traced, {}, refine, light, volume);
  fill_probes(volume);
  return volume;
}

/// Mean of E/pi over places (x from `low` to `high`, y and z over the middle of a room) and normals.
double mean_light(const VolumeSampler& sampler, double low, double high) {
  double sum = 0;
  int count = 0;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      for (int k = 0; k < 10; ++k) {
        const Vec3d place(low + (high - low) * (i + 0.5) / 10, 0.3 + 3.4 * (j + 0.5) / 10,
                          0.3 + 2.4 * (k + 0.5) / 10);
        for (const Vec3& normal : probe_directions()) {
          sum += double(sampler.irradiance(place, normal).y);
          ++count;
        }
      }
    }
  }
  return sum / count;
}

/// A bright room and a dark one, 10 cm apart: nothing of the one's light reaches the other.
const ProbeBounds both_rooms{{0, 0, 0}, {8.1, 4, 3}};
DiffuseScene two_rooms() {
  DiffuseScene scene;
  add_object(scene, "bright", box({0, 0, 0}, {4, 4, 3}), Vec3(0.7F));
  add_object(scene, "dark", box({4.1F, 0, 0}, {8.1F, 4, 3}), Vec3(0.7F));
  add_object(scene, "lamp", {level(0.5F, 2.9F, false, {2, 2, 0})}, Vec3(0), Vec3(10));
  return scene;
}

TEST(Leaks, ThroughAThinWall) {
  const DiffuseScene scene = two_rooms();
  for (const double spacing : {1.3, 1.0, 0.5}) {
    const ProbeVolume volume = lit_volume(scene, both_rooms, spacing);
    for (std::size_t t = 0; t < 3; ++t) {
      const VolumeSampler sampler(volume, ProbeEncoding::sh3, static_cast<LeakTest>(t));
      const double bright = mean_light(sampler, 3.0, 3.9), dark = mean_light(sampler, 4.2, 5.2);
      if (static_cast<LeakTest>(t) == LeakTest::visibility) {
        EXPECT_LT(dark, 0.02 * bright) << spacing;
      } else if (spacing >= 1) {  // the nearer the probes are, the fewer see the wall from its other side
        EXPECT_GT(dark, 0.02 * bright) << "the test is too weak";
      }
    }
  }
}

TEST(Leaks, OfATree) {
  const DiffuseScene scene = two_rooms();
  for (const double spacing : {2.0, 1.3}) {
    const ProbeVolume volume = lit_volume(scene, both_rooms, spacing, {0.1, 2});
    ASSERT_GT(volume.probes.size(), volume.grid->size());
    const VolumeSampler sampler(volume, ProbeEncoding::sh3, LeakTest::visibility);
    const double bright = mean_light(sampler, 3.0, 3.9), dark = mean_light(sampler, 4.2, 5.2);
    EXPECT_LT(dark, 0.02 * bright) << spacing;
  }
}

}  // namespace
}  // namespace rnmbake
