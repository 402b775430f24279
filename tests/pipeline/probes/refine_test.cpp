// More light probes where light varies: below the wanted error, with fewer of them than a regular box needs.
#include "pipeline/probes/lit_probes.h"
#include "pipeline/probes/refine_probes.h"
#include "pipeline/probes/settle_probes.h"
#include "probes/fill_probes.h"
#include "probes/place_probes.h"
#include "probes/probe_tree.h"
#include "probes/volume_sampler.h"
#include "sampling/sampler.h"
#include "trace/probes/gather_probes.h"
#include "trace/trace_scenes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

/// A room from -2 to 2 along each axis; a small lamp lies under the ceiling near a corner.
DiffuseScene lamp_in_a_corner() {
  DiffuseScene scene;
  add_object(scene, "room", room(2), Vec3(0.5F));
  add_object(scene, "lamp", {level(0.4F, 1.99F, false, {1.4F, 1.4F, 0})}, Vec3(0), Vec3(50));
  return scene;
}

struct Refined {
  ProbeVolume volume;
  RefineCounts counts;
};

Refined refined(const TraceScene& scene, double spacing, int samples, const RefineOptions& options) {
  const ProbeBounds bounds{Vec3d(-2), Vec3d(2)};
  Refined made{empty_volume("box", grid_in(bounds, spacing, 1000, options.levels)), {}};
  settle_probes(scene, {}, made.volume);
  const LightProbes light = by_reference(scene, samples);
  light(valid_probes(made.volume), 99);
  made.counts = refine_probes(scene, {}, options, light, made.volume);
  fill_probes(made.volume);
  return made;
}

/// What interpolation by visibility errs by at random places, as a share of the mean light; the noise of the
/// truth is left out by two of its halves.
double rmse_between(const TraceScene& scene, const ProbeVolume& volume) {
  std::vector<Vec3d> places;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Sampler sampler(7, i);
    places.push_back((Vec3d(sampler.next3()) * 2 - Vec3d(1)) * 1.7);  // within the probes of all grids
  }
  ProbeGatherOptions options = gathering(256);
  options.seed = 7;
  const auto first = gather_at(scene, places, options);
  options.seed = 8;
  const auto second = gather_at(scene, places, options);
  const VolumeSampler sampler(volume, ProbeEncoding::sh3, LeakTest::visibility);
  double product = 0, mean = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < probe_direction_count; ++k) {
      Vec3 light(0);
      const ProbeShares shares = sampler.shares(places[i], probe_directions()[k]);
      for (const ProbeShare& share : shares.used())
        light += volume.probes[share.probe].irradiance[k] * share.weight;
      product += double((light - first[i].irradiance[k]).dot(light - second[i].irradiance[k])) / 3;
      mean += double(first[i].irradiance[k].y);
    }
  }
  const double values = double(places.size() * probe_direction_count);
  return std::sqrt(std::max(0.0, product / values)) / (mean / values);
}

std::size_t probes_of_regular_grid(const ProbeGrid& grid, int levels) {
  std::size_t probes = 1;
  for (const int count : grid.counts) probes *= std::size_t((count - 1) * (1 << levels) + 1);
  return probes;
}

/// Levels of cells that meet on a face or an edge.
int most_step_between(const ProbeVolume& volume) {
  const std::vector<CellPlace> places = cell_places(*volume.grid, *volume.tree);
  int most = 0;
  for (const TreeLeaf& leaf : leaves_of(*volume.grid, *volume.tree)) {
    for (std::size_t beside = 0; beside < 27; ++beside) {
      LatticePlace at = leaf.place.low;
      int moved = 0;
      bool is_inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const int step = node_steps(beside)[axis] - 1;
        moved += std::abs(step);
        at[axis] += step * leaf.place.size();
        is_inside &= at[axis] >= 0 && at[axis] < (volume.grid->counts[axis] - 1) * lattice_steps;
      }
      if (!is_inside || moved == 3) continue;
      const std::size_t there = cell_at(*volume.grid, *volume.tree, at, most_tree_levels);
      if (places[there].level < leaf.place.level)
        most = std::max(most, leaf.place.level - places[there].level);
    }
  }
  return most;
}

TEST(RefineProbes, ALampInACorner) {
  const DiffuseScene diffuse = lamp_in_a_corner();
  const TraceScene scene(diffuse, "4.3.2");
  const RefineOptions options{0.1, 3};
  const Refined made = refined(scene, 1.3, 128, options);
  const std::size_t regular = probes_of_regular_grid(*made.volume.grid, options.levels);
  EXPECT_NO_THROW(check_tree(*made.volume.grid, *made.volume.tree, made.volume.probes.size()));
  EXPECT_EQ(depth_of(*made.volume.grid, *made.volume.tree), options.levels) << "a finer grid is not needed";
  EXPECT_LT(made.volume.probes.size(), regular / 8);
  EXPECT_LT(made.counts.lit, regular / 4) << "traced";
  EXPECT_EQ(most_step_between(made.volume), 1);
  EXPECT_LT(rmse_between(scene, made.volume), options.error);
  // The places are worth their probes: as many on a regular grid err by more than is wanted.
  ProbeVolume even =
      empty_volume("even", grid_in({Vec3d(-2), Vec3d(2)}, 4 / std::cbrt(double(made.volume.probes.size()))));
  settle_probes(scene, {}, even);
  by_reference(scene, 128)(valid_probes(even), 99);
  EXPECT_GT(rmse_between(scene, even), options.error);
  EXPECT_EQ(made.volume.depths.mean.size(), made.volume.probes.size() * 256);
}

/// The same light everywhere: what differs is noise, however little is wanted.
TEST(RefineProbes, NoiseIsNoReason) {
  DiffuseScene diffuse;
  add_object(diffuse, "room", room(2), Vec3(0.5F), Vec3(1));
  const TraceScene scene(diffuse, "4.3.2");
  const Refined made = refined(scene, 1.0, 16, {1e-6, 3});
  const ProbeVolume& volume = made.volume;
  double noise = 0;
  for (const LightProbe& probe : volume.probes) noise = std::max(noise, double(probe.standard_error[0].x));
  EXPECT_GT(noise, 1e-3) << "no noise to be fooled by";
  // Two standard deviations of noise: a chance of 2.3 % for each of 4^3 cells; more than five are unlikely
  // (0.4 %).
  EXPECT_LE(made.counts.divided, 5U);
}

TEST(RefineProbes, BuriedCellsAndThinBoxesStayWhole) {
  const DiffuseScene diffuse = lamp_in_a_corner();
  const TraceScene scene(diffuse, "4.3.2");
  ProbeVolume thin = empty_volume("thin", grid_in({Vec3d(-1, -1, 0), Vec3d(1, 1, 0)}, 0.5));
  settle_probes(scene, {}, thin);
  const LightProbes light = by_reference(scene, 16);
  EXPECT_EQ(refine_probes(scene, {}, {0.01, 3}, light, thin).divided, 0U);
  EXPECT_FALSE(thin.tree);
  // A box that reaches far out: no cell whose corners are all behind the walls is divided.
  ProbeVolume wide = empty_volume("wide", grid_in({Vec3d(-8), Vec3d(8)}, 1.0));
  settle_probes(scene, {}, wide);
  light(valid_probes(wide), 99);
  const RefineCounts counts = refine_probes(scene, {}, {0.3, 1}, light, wide);
  EXPECT_GT(counts.divided, 0U);
  const std::vector<CellPlace> places = cell_places(*wide.grid, *wide.tree);
  for (std::size_t cell = 0; cell < places.size(); ++cell) {
    if (wide.tree->cells[cell].children == 0) continue;
    EXPECT_TRUE(std::ranges::any_of(wide.tree->cells[cell].corners, [&](std::uint32_t probe) {
      return is_valid(wide.probes[probe]);
    })) << cell;
  }
}

}  // namespace
}  // namespace rnmbake
