#include "bake/plan.h"

#include "bake/fixture.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace rnmbake {
namespace {

using Mode = BakingSettings::Dispatch;

/// `targets` targets of four bases each; target t gets `samples[t % size]` samples.
Plan plan_of(std::size_t targets, const std::vector<int>& samples = {16}) {
  Plan plan;
  const Target target = make_target("a", 64, 64);
  for (std::size_t t = 0; t < targets; ++t) {
    CyclesSettings cycles;
    cycles.samples = samples[t % samples.size()];
    add_receiver_units(plan, t, target, plain_sheets(4), flat_and_rnm(), cycles);
  }
  return plan;
}

std::vector<std::size_t> all_units(const Plan& plan) {
  std::vector<std::size_t> units;
  for (const Dispatch& dispatch : plan.dispatches)
    units.insert(units.end(), dispatch.units.begin(), dispatch.units.end());
  std::sort(units.begin(), units.end());
  return units;
}

void expect_every_unit_once(const Plan& plan) {
  const auto units = all_units(plan);
  ASSERT_EQ(units.size(), plan.units.size());
  for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(units[i], i);
}

TEST(Crop, CoversTheUvsAndATexelMoreInsideTheMap) {
  const Target target = make_target("a", 100, 40);
  for (const auto& [low, high] : {std::pair{0.0F, 1.0F}, {0.31F, 0.52F}, {0.5F, 0.5001F}, {0.98F, 1.0F}}) {
    Plan plan;
    add_receiver_units(plan, 0, target, plain_sheets(1, low, high), {flat_direction()}, {});
    ASSERT_EQ(plan.tiles.size(), 1U);
    const Tile& tile = plan.tiles[0];
    const int place[] = {tile.x, tile.y}, size[] = {tile.size.width, tile.size.height}, side[] = {100, 40};
    for (int axis = 0; axis < 2; ++axis) {
      const float first = low * float(side[axis]), last = high * float(side[axis]);
      EXPECT_GE(place[axis], 0);
      EXPECT_LE(place[axis] + size[axis], side[axis]);
      EXPECT_LE(place[axis], std::max(0.0F, first - 1));
      EXPECT_GE(float(place[axis] + size[axis]), std::min(float(side[axis]), last + 1));
      EXPECT_LE(float(size[axis]), last - first + 5);
    }
  }
}

TEST(Units, AreOneForEachBasisAndOneForTheHorizon) {
  Sheets sheets = plain_sheets(4);
  sheets.sheets.push_back(sheet_over(0, 0.5, Sheet::Role::below, 2));
  for (std::size_t m = 0; m < 5; ++m) sheets.sheets.push_back(sheet_over(0, 0.5, Sheet::Role::moment, m));
  Plan plan;
  add_receiver_units(plan, 7, make_target("a", 64, 64), std::move(sheets), flat_and_rnm(), {});
  ASSERT_EQ(plan.units.size(), 5U);
  EXPECT_EQ(plan.tiles.size(), 10U);
  EXPECT_EQ(plan.units[0].name, "flat");
  EXPECT_EQ(plan.units[3].name, "rnm2");
  EXPECT_EQ(plan.units[0].tiles.size(), 1U);
  EXPECT_EQ(plan.units[2].tiles.size(), 2U);  // what lies above and what lies below
  EXPECT_EQ(plan.units[4].name, "horizon");
  EXPECT_EQ(plan.units[4].tiles.size(), 5U);
  for (const Tile& tile : plan.tiles) EXPECT_EQ(tile.target, 7U);
}

TEST(Units, LeaveEmptySheetsOut) {
  Sheets sheets = plain_sheets(2);
  sheets.sheets[1].corners.clear();
  Plan plan;
  add_receiver_units(plan, 0, make_target("a", 8, 8), std::move(sheets),
                     {flat_direction(), rnm_set().directions[0]}, {});
  EXPECT_EQ(plan.tiles.size(), 1U);
  ASSERT_EQ(plan.units.size(), 2U);
  EXPECT_TRUE(plan.units[1].tiles.empty());
}

TEST(Units, OfObjectsAreWholeMaps) {
  Plan plan;
  add_object_units(plan, 1, make_target("a", 24, 16), flat_and_rnm(), {});
  ASSERT_EQ(plan.units.size(), 4U);
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(plan.units[b].basis, b);
    EXPECT_EQ(plan.tiles[b].size.width, 24);
    EXPECT_EQ(plan.tiles[b].size.height, 16);
  }
}

TEST(Group, BasisIsALaunchForEachUnit) {
  Plan plan = plan_of(3);
  group_units(plan, Mode::basis);
  EXPECT_EQ(plan.dispatches.size(), 12U);
  expect_every_unit_once(plan);
}

TEST(Group, ObjectIsALaunchForEachTarget) {
  Plan plan = plan_of(3);
  group_units(plan, Mode::object);
  ASSERT_EQ(plan.dispatches.size(), 3U);
  for (const Dispatch& dispatch : plan.dispatches) EXPECT_EQ(dispatch.units.size(), 4U);
  expect_every_unit_once(plan);
}

TEST(Group, SceneJoinsWhatSharesItsSettings) {
  Plan plan = plan_of(5);
  group_units(plan, Mode::scene);
  EXPECT_EQ(plan.dispatches.size(), 1U);
  Plan two = plan_of(5, {16, 64});
  group_units(two, Mode::scene);
  ASSERT_EQ(two.dispatches.size(), 2U);
  expect_every_unit_once(two);
  for (const Dispatch& dispatch : two.dispatches) {
    const CyclesSettings& cycles = two.units[dispatch.units.front()].cycles;
    for (const std::size_t unit : dispatch.units) EXPECT_EQ(two.units[unit].cycles, cycles);
  }
}

TEST(Group, EverySettingOfCyclesSeparates) {
  const CyclesSettings base;
  std::vector<CyclesSettings> others(5, base);
  others[0].samples = 7;
  others[1].bounces = 7;
  others[2].seed = 7;
  others[3].clamp = 7;
  others[4].device = "CUDA";
  for (const CyclesSettings& other : others) {
    Plan plan;
    add_object_units(plan, 0, make_target("a", 8, 8), {flat_direction()}, base);
    add_object_units(plan, 1, make_target("b", 8, 8), {flat_direction()}, other);
    group_units(plan, Mode::scene);
    EXPECT_EQ(plan.dispatches.size(), 2U);
  }
}

TEST(Dispatch, AutomaticJoinsReceiversOnly) {
  BakingSettings settings;
  EXPECT_EQ(resolve_dispatch(settings), Mode::scene);
  settings.recipe = BakingSettings::Recipe::flat_normal_map;
  EXPECT_EQ(resolve_dispatch(settings), Mode::object);
  settings.dispatch = Mode::basis;
  EXPECT_EQ(resolve_dispatch(settings), Mode::basis);
}

TEST(Split, KeepsEveryUnitInOrder) {
  const Plan plan = plan_of(3);
  Dispatch dispatch;
  for (std::size_t u = 0; u < plan.units.size(); ++u) dispatch.units.push_back(u);
  const auto halves = split(dispatch, plan);
  ASSERT_EQ(halves.size(), 2U);
  std::vector<std::size_t> joined = halves[0].units;
  joined.insert(joined.end(), halves[1].units.begin(), halves[1].units.end());
  EXPECT_EQ(joined, dispatch.units);
}

TEST(Split, CutsBetweenTargetsWhereThereIsABoundary) {
  // units of targets a and b in every proportion: the cut is always between them
  const Plan plan = plan_of(2);
  const std::vector<std::size_t> a{0, 1, 2, 3}, b{4, 5, 6, 7};
  for (std::size_t i = 1; i <= 4; ++i) {
    for (std::size_t j = 1; j <= 4; ++j) {
      Dispatch dispatch{{a.begin(), a.begin() + static_cast<std::ptrdiff_t>(i)}};
      dispatch.units.insert(dispatch.units.end(), b.begin(), b.begin() + static_cast<std::ptrdiff_t>(j));
      const auto halves = split(dispatch, plan);
      ASSERT_EQ(halves.size(), 2U);
      EXPECT_EQ(halves[0].units.size(), i);
      EXPECT_EQ(halves[1].units.size(), j);
    }
  }
}

TEST(Split, OfOneTargetHalvesItsUnits) {
  const Plan plan = plan_of(1);
  const auto halves = split({{0, 1, 2, 3}}, plan);
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].units.size(), 2U);
}

TEST(Split, EndsWithSingleUnitsAfterFewSteps) {
  const Plan plan = plan_of(37);
  Dispatch whole;
  for (std::size_t u = 0; u < plan.units.size(); ++u) whole.units.push_back(u);
  std::vector<Dispatch> queue{whole};
  std::set<std::size_t> alone;
  std::size_t splits = 0;
  while (!queue.empty()) {
    const Dispatch dispatch = queue.back();
    queue.pop_back();
    ASSERT_FALSE(dispatch.units.empty());
    if (dispatch.units.size() == 1) {
      alone.insert(dispatch.units[0]);
      continue;
    }
    ++splits;
    for (Dispatch& half : split(dispatch, plan)) queue.push_back(std::move(half));
  }
  EXPECT_EQ(alone.size(), plan.units.size());
  EXPECT_EQ(splits, plan.units.size() - 1);
}

TEST(Split, OfASingleUnitIsItself) {
  const auto halves = split({{2}}, plan_of(1));
  ASSERT_EQ(halves.size(), 1U);
  EXPECT_EQ(halves[0].units, std::vector<std::size_t>{2});
}

TEST(AtlasPixels, AreTheLimitWhileMemoryLasts) {
  EXPECT_EQ(atlas_pixels(1 << 24, std::int64_t(64) << 30, 1000, 1000), 1 << 24);
}

TEST(AtlasPixels, ShrinkWithMemoryAndTriangles) {
  const std::int64_t memory = std::int64_t(2) << 30;
  EXPECT_EQ(atlas_pixels(std::int64_t(1) << 40, memory, 0, 0), memory / bytes_per_pixel);
  EXPECT_EQ(atlas_pixels(std::int64_t(1) << 40, memory, 500000, 500000),
            (memory - 500000 * (bytes_per_scene_triangle + bytes_per_receiver_triangle)) / bytes_per_pixel);
}

TEST(AtlasPixels, NeverFallBelowAMegapixelUnlessAskedFor) {
  EXPECT_EQ(atlas_pixels(1 << 24, 0, 1000000, 1000000), 1 << 20);
  EXPECT_EQ(atlas_pixels(4096, 0, 1000000, 1000000), 4096);
  EXPECT_EQ(atlas_pixels(0, 0, 0, 0), 1);
}

}  // namespace
}  // namespace rnmbake
