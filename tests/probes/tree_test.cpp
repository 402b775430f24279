// Trees of light probes: look-up, where cells of two levels meet, filling, files, regular grids out of them.
#include "base/error.h"
#include "base/files.h"
#include "image/layered_exr.h"
#include "probes/fill_probes.h"
#include "probes/formats/formats.h"
#include "probes/place_probes.h"
#include "probes/probe_tree.h"
#include "probes/regular_volume.h"
#include "probes/tree_file.h"
#include "probes/volume_file.h"
#include "probes/volume_sampler.h"

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <unordered_map>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

using LightAt = std::function<float(const Vec3d&)>;

/// Alike at all normals.
LightProbe even_probe(const Vec3d& place, const LightAt& light) {
  LightProbe probe;
  probe.position = place;
  probe.irradiance.fill(Vec3(light(place)));
  probe.harmonics = harmonics_of(probe.irradiance);
  return probe;
}

/// Divides cells by hand, with a probe at each new corner.
class TreeMaker {
 public:
  TreeMaker(const ProbeGrid& grid, LightAt light) : light_(std::move(light)) {
    volume_ = empty_volume("tree", grid);
    for (LightProbe& probe : volume_.probes) probe = even_probe(probe.position, light_);
    volume_.tree = undivided_tree(grid);
    for (std::size_t cell = 0; cell < volume_.tree->cells.size(); ++cell)
      for (std::size_t k = 0; k < 8; ++k)
        known_[number(cell_places(grid, *volume_.tree)[cell].node(corner_node(k)))] =
            volume_.tree->cells[cell].corners[k];
  }
  /// The deepest cell at a place of the lattice.
  void divide(const LatticePlace& at) {
    const ProbeGrid& grid = *volume_.grid;
    const std::size_t cell = cell_at(grid, *volume_.tree, at, most_tree_levels);
    const CellPlace place = cell_places(grid, *volume_.tree)[cell];
    CellNodes nodes;
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const auto [found, is_new] =
          known_.emplace(number(place.node(node)), std::uint32_t(volume_.probes.size()));
      if (is_new) volume_.probes.push_back(even_probe(lattice_point(grid, place.node(node)), light_));
      nodes[node] = found->second;
    }
    divide_cell(*volume_.tree, cell, nodes);
  }
  [[nodiscard]] ProbeVolume& volume() { return volume_; }

 private:
  [[nodiscard]] std::uint64_t number(const LatticePlace& at) const {
    return lattice_number(*volume_.grid, at);
  }
  LightAt light_;
  ProbeVolume volume_;
  std::unordered_map<std::uint64_t, std::uint32_t> known_;
};

/// 3 x 2 x 2 cells, slanted; one of them is divided, and within it the one at its low corner.
TreeMaker three_levels(const LightAt& light) {
  ProbeGrid grid;
  grid.counts = {4, 3, 3};
  grid.first = Vec3d(-1, 2, 0.5);
  grid.steps = {Vec3d(1, 0.2, 0), Vec3d(-0.1, 0.8, 0), Vec3d(0, 0.1, 1.2)};
  TreeMaker maker(grid, light);
  const int whole = lattice_steps;
  maker.divide({whole, 0, 0});
  maker.divide({0, 0, 0});  // next to the smallest: levels differ by one where cells meet
  maker.divide({whole, 0, 0});
  return maker;
}

float linear(const Vec3d& at) {
  return float(5 + at.x - 2 * at.y + 0.5 * at.z);
}

/// Far from linear within a cell.
float wild(const Vec3d& at) {
  return float(2 + std::sin(9 * at.x) + std::cos(7 * at.y + at.z));
}

Vec3d inside(const ProbeGrid& grid, double x, double y, double z) {
  return grid.first + grid.steps[0] * x + grid.steps[1] * y + grid.steps[2] * z;
}

TEST(ProbeTree, CellsOfHandMadeTrees) {
  TreeMaker maker = three_levels(linear);
  const ProbeVolume& volume = maker.volume();
  EXPECT_NO_THROW(check_tree(*volume.grid, *volume.tree, volume.probes.size()));
  EXPECT_EQ(volume.tree->cells.size(), 12U + 3 * 8);
  EXPECT_EQ(depth_of(*volume.grid, *volume.tree), 2);
  // Two divided cells with a face in common have 5 x 3 x 3 probes, 12 of them the grid's.
  EXPECT_EQ(volume.probes.size(), 36U + (5 * 3 * 3 - 12) + (27 - 8));
  const auto levels = levels_of_probes(leaves_of(*volume.grid, *volume.tree), volume.probes.size());
  EXPECT_EQ(levels[volume.grid->index(1, 0, 0)].finest, 2);
  EXPECT_EQ(levels[volume.grid->index(1, 0, 0)].coarsest, 1);
  EXPECT_EQ(levels[volume.grid->index(3, 2, 2)].finest, 0);
}

TEST(ProbeTree, LinearLightIsExactAtAnyLevel) {
  TreeMaker maker = three_levels(linear);
  const VolumeSampler sampler(maker.volume(), ProbeEncoding::sh3, LeakTest::none);
  for (double x = 0; x <= 3; x += 0.0937)
    for (double y = 0; y <= 2; y += 0.131)
      for (double z = 0; z <= 2; z += 0.217) {
        const Vec3d place = inside(*maker.volume().grid, x, y, z);
        ASSERT_NEAR(sampler.irradiance(place, {0, 0, 1}).y, linear(place), 2e-5) << x << ' ' << y << ' ' << z;
      }
}

TEST(ProbeTree, ProbesKeepTheirLight) {
  TreeMaker maker = three_levels(wild);
  const VolumeSampler sampler(maker.volume(), ProbeEncoding::sh3, LeakTest::validity);
  for (const LightProbe& probe : maker.volume().probes)
    EXPECT_NEAR(sampler.irradiance(probe.position, {1, 0, 0}).x, probe.irradiance[0].x, 1e-4);
}

/// Steps along lines through all levels: what light changes by in a step is bounded by its steepest slope,
/// the difference of two probes (at most 4) over the shortest edge (a quarter), so by 16 times the step and
/// rounding; a jump would be a difference of probes whatever the step.
TEST(ProbeTree, NoJumpWhereLevelsMeet) {
  for (const LeakTest test : {LeakTest::none, LeakTest::validity}) {
    TreeMaker maker = three_levels(wild);
    if (test == LeakTest::validity)
      for (std::size_t i = 0; i < maker.volume().probes.size(); i += 7) maker.volume().probes[i].validity = 0;
    const VolumeSampler sampler(maker.volume(), ProbeEncoding::cube, test);
    const double step = 1e-6;
    double most = 0;
    for (double x = 0.25; x < 3; x += 0.25) {  // planes between cells of any level
      for (double a = 0.013; a < 2; a += 0.0371) {
        for (double b = 0.017; b < 2; b += 0.0597) {
          const auto jump = [&](const Vec3d& low, const Vec3d& high) {
            const auto at = [&](const Vec3d& p) {
              return sampler.irradiance(inside(*maker.volume().grid, p.x, p.y, p.z), {1, 0, 0}).x;
            };
            most = std::max(most, double(std::abs(at(high) - at(low))));
          };
          jump({x - step, a, b}, {x + step, a, b});
          if (x >= 2) continue;
          jump({a, x - step, b}, {a, x + step, b});
          jump({a, b, x - step}, {a, b, x + step});
        }
      }
    }
    // Shares of probes that count change faster the fewer of the eight there are: validity allows ten times.
    EXPECT_LT(most, (test == LeakTest::none ? 1 : 10) * 16 * 2 * step + 1e-5) << int(test);
  }
}

/// Without taking hanging probes in, the larger cell would know nothing of the one in its face.
TEST(ProbeTree, LargerCellsTakeHangingProbesIn) {
  TreeMaker maker = three_levels([](const Vec3d&) { return 0.0F; });
  ProbeVolume& volume = maker.volume();
  const auto leaves = leaves_of(*volume.grid, *volume.tree);
  const std::size_t beyond = cell_at(*volume.grid, *volume.tree, {2 * lattice_steps, 0, 0}, 0);
  const auto leaf = std::ranges::find(leaves, beyond, &TreeLeaf::cell);
  ASSERT_NE(leaf, leaves.end());
  EXPECT_TRUE(leaf->has_hanging);
  const std::uint32_t hanging = leaf->nodes[12];  // x low, the middle of the face
  ASSERT_NE(hanging, no_probe);
  volume.probes[hanging].irradiance.fill(Vec3(1));
  const VolumeSampler sampler(volume, ProbeEncoding::cube, LeakTest::none);
  EXPECT_NEAR(sampler.irradiance(inside(*volume.grid, 2.25, 0.5, 0.5), {1, 0, 0}).x, 0.5, 1e-5);
  EXPECT_NEAR(sampler.irradiance(inside(*volume.grid, 2.5, 0.5, 0.5), {1, 0, 0}).x, 0, 1e-5);
}

TEST(ProbeTree, FillsAlongEdges) {
  TreeMaker maker = three_levels(linear);
  ProbeVolume& volume = maker.volume();
  const std::size_t last = volume.probes.size() - 1;
  volume.probes[last].validity = 0;
  volume.probes[last].irradiance.fill(Vec3(0));
  EXPECT_EQ(fill_probes(volume), 1U);
  EXPECT_EQ(volume.probes[last].state, LightProbe::State::filled);
  // On all sides of it neighbours as far off: linear light is what they have in the middle.
  EXPECT_NEAR(volume.probes[last].irradiance[0].x, linear(volume.probes[last].position), 0.7);
}

TEST(ProbeTree, AsARegularGrid) {
  TreeMaker maker = three_levels(linear);
  ProbeVolume& volume = maker.volume();
  volume.depths = {1, {}, {}};
  for (std::size_t i = 0; i < volume.probes.size(); ++i) {
    volume.depths.mean.push_back(linear(volume.probes[i].position));
    volume.depths.square.push_back(2);
  }
  const RegularVolume regular = regular_volume(volume, 2);
  EXPECT_EQ(regular.volume.grid->counts, (std::array{13, 9, 9}));
  EXPECT_FALSE(regular.volume.tree);
  EXPECT_EQ(regular.volume.probes.size() - regular.interpolated.size(), volume.probes.size());
  for (int x = 0; x < 13; ++x) {
    const std::size_t i = regular.volume.grid->index(x, 3, 8);
    const LightProbe& probe = regular.volume.probes[i];
    EXPECT_LT((probe.position - regular.volume.grid->place(x, 3, 8)).length(), 1e-6);
    EXPECT_NEAR(probe.irradiance[4].z, linear(probe.position), 2e-5);
    EXPECT_NEAR(regular.volume.depths.mean[i], linear(probe.position), 2e-5);
  }
  EXPECT_THROW((void)regular_volume(regular.volume, 2), Error);
  const TempFolder folder;
  EXPECT_THROW((void)write_probe_format("cpp", std::vector{volume}, folder.path()), Error);
  EXPECT_NO_THROW((void)write_probe_format("cpp", std::vector{regular.volume}, folder.path()));
}

TEST(ProbeTree, FileThereAndBack) {
  const TempFolder folder;
  TreeMaker maker = three_levels(wild);
  ProbeVolume& volume = maker.volume();
  volume.depths.side = 2;
  for (std::size_t i = 0; i < volume.probes.size() * 4; ++i) {
    volume.depths.mean.push_back(float(i));
    volume.depths.square.push_back(float(i) * 2);
  }
  write_volumes(folder.path(), {volume}, {});
  const ProbeVolume back = read_volumes(folder.path()).volumes.at(0);
  ASSERT_TRUE(back.tree);
  ASSERT_EQ(back.tree->cells.size(), volume.tree->cells.size());
  for (std::size_t i = 0; i < back.tree->cells.size(); ++i) {
    EXPECT_EQ(back.tree->cells[i].corners, volume.tree->cells[i].corners);
    EXPECT_EQ(back.tree->cells[i].children, volume.tree->cells[i].children);
  }
  ASSERT_EQ(back.probes.size(), volume.probes.size());
  for (std::size_t i = 0; i < back.probes.size(); ++i) {
    EXPECT_EQ(back.probes[i].irradiance, volume.probes[i].irradiance);
    EXPECT_EQ(back.probes[i].position, Vec3d(Vec3(volume.probes[i].position)));
  }
  EXPECT_EQ(back.depths.mean, volume.depths.mean);
  EXPECT_EQ(back.depths.square, volume.depths.square);
}

/// What is wrong, with the name of the file that is.
std::string refusal(const std::filesystem::path& folder) {
  try {
    (void)read_volumes(folder);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
  return "none";
}

TEST(ProbeTree, RefusesDamagedFiles) {
  const TempFolder folder;
  const ProbeVolume sound = three_levels(linear).volume();
  const auto file = folder.path() / "tree_tree.exr";
  write_volumes(folder.path(), {sound}, {});
  const auto expect = [&](const std::function<void(std::vector<ProbeCell>&)>& harm,
                          const std::string& words) {
    ProbeTree tree = *sound.tree;
    harm(tree.cells);
    write_exr(file, tree_picture(tree), Depth::full);
    const std::string text = refusal(folder.path());
    EXPECT_NE(text.find("tree_tree.exr: " + words), std::string::npos) << text << " lacks " << words;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  };
  using Cells = std::vector<ProbeCell>;
  expect([](Cells& cells) { cells[20].corners[3] = 70000; }, "cell 20 of its tree has probe 70000 of ");
  expect([](Cells& cells) { cells[20].corners[3] = 0; }, "the cells within cell 0 of its tree disagree");
  expect([](Cells& cells) { cells[0].corners[3] = 0; },
         "the first cells of its tree are not those of its grid");
  expect([](Cells& cells) { cells[5].children = 33; }, "the cells within cell 5 of its tree are 33");
  expect([](Cells& cells) { cells[5].children = 3; }, "the cells within cell 5 of its tree are 3");
  expect([](Cells& cells) { cells[30].children = 20; }, "the cells within cell 30 of its tree are 20");
  expect([](Cells& cells) { cells[5].children = 20; }, "cell 20 of its tree lies in two others");
  expect([](Cells& cells) { cells[0].children = 0; }, "cells of its tree lie in no other");
  write_volumes(folder.path(), {sound}, {});
  EXPECT_EQ(refusal(folder.path()), "none");
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.5F, 1e9F}) {
    LayeredImage image = tree_picture(*sound.tree);
    image.layers[0].pixels.data()[10] = bad;
    write_exr(file, image, Depth::full);
    EXPECT_NE(refusal(folder.path()).find("which is no number of a probe"), std::string::npos) << bad;
  }
  const auto json = folder.path() / "probes.json";
  const std::string text = read_text(json);
  for (const char* count : {"35", "0", "-8", "99999999999"}) {
    std::string changed = text;
    changed.replace(changed.find("\"cells\": 36"), 11, std::string("\"cells\": ") + count);
    write_exr(file, tree_picture(*sound.tree), Depth::full);
    write_atomically(json, changed);
    EXPECT_NE(refusal(folder.path()).find(" cells"), std::string::npos) << count;
  }
}

}  // namespace
}  // namespace rnmbake
