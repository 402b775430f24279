#include "bake/plan.h"

#include "bake/fixture.h"
#include "encoding/basis_set.h"

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
    add_receiver_tasks(plan, planned(target), plain_sheets(4), task_names(flat_and_rnm().directions), cycles);
  }
  return plan;
}

std::vector<std::size_t> all_units(const Plan& plan) {
  std::vector<std::size_t> tasks;
  for (const Batch& batch : plan.batches) tasks.insert(tasks.end(), batch.tasks.begin(), batch.tasks.end());
  std::sort(tasks.begin(), tasks.end());
  return tasks;
}

void expect_every_unit_once(const Plan& plan) {
  const auto tasks = all_units(plan);
  ASSERT_EQ(tasks.size(), plan.tasks.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) EXPECT_EQ(tasks[i], i);
}

TEST(Crop, CoversTheUvsAndATexelMoreInsideTheMap) {
  const Target target = make_target("a", 100, 40);
  for (const auto& [low, high] : {std::pair{0.0F, 1.0F}, {0.31F, 0.52F}, {0.5F, 0.5001F}, {0.98F, 1.0F}}) {
    Plan plan;
    add_receiver_tasks(plan, planned(target), plain_sheets(1, low, high), {"flat"}, {});
    ASSERT_EQ(plan.rects.size(), 1U);
    const AtlasRect& rect = plan.rects[0];
    const int place[] = {rect.x, rect.y}, size[] = {rect.size.width, rect.size.height}, side[] = {100, 40};
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
  ReceiverPasses passes = plain_sheets(4);
  passes.passes.push_back(sheet_over(0, 0.5, ReceiverPass::Role::below, 2));
  for (std::size_t m = 0; m < 5; ++m)
    passes.passes.push_back(sheet_over(0, 0.5, ReceiverPass::Role::moment, m));
  Plan plan;
  plan.targets.resize(7);
  add_receiver_tasks(plan, planned(make_target("a", 64, 64)), std::move(passes),
                     task_names(flat_and_rnm().directions), {});
  ASSERT_EQ(plan.targets.size(), 8U);
  EXPECT_EQ(plan.targets[7].key, "a");
  ASSERT_EQ(plan.tasks.size(), 5U);
  EXPECT_EQ(plan.rects.size(), 10U);
  EXPECT_EQ(plan.tasks[0].name, "basis flat");
  EXPECT_EQ(plan.tasks[3].name, "basis rnm2");
  EXPECT_EQ(plan.tasks[0].rects.size(), 1U);
  EXPECT_EQ(plan.tasks[2].rects.size(), 2U);  // what lies above and what lies below
  EXPECT_EQ(plan.tasks[4].name, "horizon");
  EXPECT_EQ(plan.tasks[4].rects.size(), 5U);
  for (const AtlasRect& rect : plan.rects) EXPECT_EQ(rect.target, 7U);
}

TEST(Units, KeepTheirRectangleWhereNoTriangleHoldsATexelsCentre) {
  const RectSize map{8, 8};
  const auto low = float(1.7 / 8), high = float(2.3 / 8);
  ReceiverPasses between = plain_sheets(2, low, high), both = plain_sheets(2, low, high);
  for (ReceiverPass& pass : both.passes) {
    const auto more = sheet_over(0, 1).corners;
    pass.corners.insert(pass.corners.end(), more.begin(), more.end());
  }
  Plan plan;
  add_receiver_tasks(plan, {"between", map, ""}, std::move(between), {"flat", "rnm0"}, {});
  add_receiver_tasks(plan, {"both", map, ""}, std::move(both), {"flat", "rnm0"}, {});
  ASSERT_EQ(plan.rects.size(), 4U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(plan.rects[i].pass.corners.empty());
    EXPECT_GE(plan.rects[i].size.width, 3);
    EXPECT_EQ(plan.rects[2 + i].pass.corners.size(), 3U);
    EXPECT_EQ(plan.rects[2 + i].size.width, 8);
  }
}

TEST(Units, LeaveEmptySheetsOut) {
  ReceiverPasses passes = plain_sheets(2);
  passes.passes[1].corners.clear();
  Plan plan;
  add_receiver_tasks(plan, planned(make_target("a", 8, 8)), std::move(passes), {"flat", "rnm0"}, {});
  EXPECT_EQ(plan.rects.size(), 1U);
  ASSERT_EQ(plan.tasks.size(), 2U);
  EXPECT_TRUE(plan.tasks[1].rects.empty());
}

TEST(Units, OfObjectsAreWholeMaps) {
  Plan plan;
  add_object_tasks(plan, planned(make_target("a", 24, 16)), task_names(flat_and_rnm().directions), {});
  ASSERT_EQ(plan.tasks.size(), 4U);
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(plan.tasks[b].basis, b);
    EXPECT_EQ(plan.rects[b].size.width, 24);
    EXPECT_EQ(plan.rects[b].size.height, 16);
  }
}

TEST(Group, BasisIsALaunchForEachUnit) {
  Plan plan = plan_of(3);
  group_tasks(plan, Mode::basis);
  EXPECT_EQ(plan.batches.size(), 12U);
  expect_every_unit_once(plan);
}

TEST(Group, ObjectIsALaunchForEachTarget) {
  Plan plan = plan_of(3);
  group_tasks(plan, Mode::object);
  ASSERT_EQ(plan.batches.size(), 3U);
  for (const Batch& batch : plan.batches) EXPECT_EQ(batch.tasks.size(), 4U);
  expect_every_unit_once(plan);
}

TEST(Group, SceneJoinsWhatSharesItsSettings) {
  Plan plan = plan_of(5);
  group_tasks(plan, Mode::scene);
  EXPECT_EQ(plan.batches.size(), 1U);
  Plan two = plan_of(5, {16, 64});
  group_tasks(two, Mode::scene);
  ASSERT_EQ(two.batches.size(), 2U);
  expect_every_unit_once(two);
  for (const Batch& batch : two.batches) {
    const CyclesSettings& cycles = two.tasks[batch.tasks.front()].cycles;
    for (const std::size_t task : batch.tasks) EXPECT_EQ(two.tasks[task].cycles, cycles);
  }
}

TEST(Group, EverySettingOfCyclesSeparates) {
  const CyclesSettings base;
  std::vector<CyclesSettings> others(6, base);
  others[0].samples = 7;
  others[1].bounces = 7;
  others[2].seed = 7;
  others[3].clamp = 7;
  others[4].device = "CUDA";
  others[5].lamps = false;
  for (const CyclesSettings& other : others) {
    Plan plan;
    add_object_tasks(plan, planned(make_target("a", 8, 8)), {"flat"}, base);
    add_object_tasks(plan, planned(make_target("b", 8, 8)), {"flat"}, other);
    group_tasks(plan, Mode::scene);
    EXPECT_EQ(plan.batches.size(), 2U);
  }
}

TEST(Batch, AutomaticJoinsReceiversOnly) {
  BakingSettings settings;
  EXPECT_EQ(resolve_dispatch(settings), Mode::scene);
  settings.recipe = BakingSettings::Recipe::flat_normal_map;
  EXPECT_EQ(resolve_dispatch(settings), Mode::object);
  settings.dispatch = Mode::basis;
  EXPECT_EQ(resolve_dispatch(settings), Mode::basis);
}

TEST(Split, KeepsEveryUnitInOrder) {
  const Plan plan = plan_of(3);
  Batch batch;
  for (std::size_t u = 0; u < plan.tasks.size(); ++u) batch.tasks.push_back(u);
  const auto halves = split(batch, plan);
  ASSERT_EQ(halves.size(), 2U);
  std::vector<std::size_t> joined = halves[0].tasks;
  joined.insert(joined.end(), halves[1].tasks.begin(), halves[1].tasks.end());
  EXPECT_EQ(joined, batch.tasks);
}

TEST(Split, CutsBetweenTargetsWhereThereIsABoundary) {
  // units of targets a and b in every proportion: the cut is always between them
  const Plan plan = plan_of(2);
  const std::vector<std::size_t> a{0, 1, 2, 3}, b{4, 5, 6, 7};
  for (std::size_t i = 1; i <= 4; ++i) {
    for (std::size_t j = 1; j <= 4; ++j) {
      Batch batch{{a.begin(), a.begin() + static_cast<std::ptrdiff_t>(i)}};
      batch.tasks.insert(batch.tasks.end(), b.begin(), b.begin() + static_cast<std::ptrdiff_t>(j));
      const auto halves = split(batch, plan);
      ASSERT_EQ(halves.size(), 2U);
      EXPECT_EQ(halves[0].tasks.size(), i);
      EXPECT_EQ(halves[1].tasks.size(), j);
    }
  }
}

TEST(Split, OfOneTargetHalvesItsUnits) {
  const Plan plan = plan_of(1);
  const auto halves = split({{0, 1, 2, 3}}, plan);
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].tasks.size(), 2U);
}

TEST(Split, EndsWithSingleUnitsAfterFewSteps) {
  const Plan plan = plan_of(37);
  Batch whole;
  for (std::size_t u = 0; u < plan.tasks.size(); ++u) whole.tasks.push_back(u);
  std::vector<Batch> queue{whole};
  std::set<std::size_t> alone;
  std::size_t splits = 0;
  while (!queue.empty()) {
    const Batch batch = queue.back();
    queue.pop_back();
    ASSERT_FALSE(batch.tasks.empty());
    if (batch.tasks.size() == 1) {
      alone.insert(batch.tasks[0]);
      continue;
    }
    ++splits;
    for (Batch& half : split(batch, plan)) queue.push_back(std::move(half));
  }
  EXPECT_EQ(alone.size(), plan.tasks.size());
  EXPECT_EQ(splits, plan.tasks.size() - 1);
}

TEST(Split, OfASingleUnitIsItself) {
  const auto halves = split({{2}}, plan_of(1));
  ASSERT_EQ(halves.size(), 1U);
  EXPECT_EQ(halves[0].tasks, std::vector<std::size_t>{2});
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
