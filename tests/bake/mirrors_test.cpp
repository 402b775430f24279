#include "bake/mirrors.h"

#include "bake/fixture.h"

#include <set>

namespace rnmbake {
namespace {

std::vector<Mirror> mirrors_of(std::size_t count) {
  std::vector<Mirror> mirrors;
  for (std::size_t i = 0; i < count; ++i)
    mirrors.push_back({Vec3(float(i), 1, 2), Vec3(direction_at(0.001 * double(i), 0.3))});
  return mirrors;
}

Plan plan_with(std::size_t count, const CyclesSettings& cycles) {
  Plan plan;
  plan.targets.push_back({"one", {8, 8}, ""});
  add_mirror_tasks(plan, 0, 1, false, mirrors_of(count), cycles);
  return plan;
}

CyclesSettings of_mirrors() {
  CyclesSettings cycles;
  cycles.mirrors = true;
  return cycles;
}

TEST(Mirrors, LookAlongTheirRay) {
  const Mirror mirror{{3, -2, 1}, Vec3(1, 2, -0.5F).normalized()};
  for (const ReceiverCorner& corner : mirror_triangle(mirror, 5, {3, 3})) {
    EXPECT_EQ(corner.normal, mirror.direction);
    EXPECT_LT((corner.position - mirror.position).length(), 1e-4F);
    EXPECT_EQ(int(corner.uv.x * 3), 2);  // texel 5 of rows of 3
    EXPECT_EQ(int(corner.uv.y * 3), 1);
  }
}

TEST(Mirrors, StandOverTheirFaceHoweverFlatTheyLie) {
  for (const double far : {0.0, 1.0, 40.0, 3000.0}) {
    const Vec3d place(far, -far, far);
    for (const Vec3& direction : {Vec3(1, 0, 1e-3F), Vec3(0, 1, 1e-3F), Vec3(0, 0, 1)}) {
      const Mirror mirror{mirror_position(place, {0, 0, 1}), direction.normalized()};
      for (const ReceiverCorner& corner : mirror_triangle(mirror, 0, {1, 1}))
        EXPECT_GT(double(corner.position.z), place.z) << "at " << far;
    }
  }
}

TEST(Mirrors, AreAllThereOnceInTheirOrder) {
  const std::size_t count = 200'000;
  const Plan plan = plan_with(count, of_mirrors());
  std::size_t next = 0;
  for (const BakeTask& task : plan.tasks) {
    ASSERT_EQ(task.rects.size(), 1U);
    const AtlasRect& rect = plan.rects[task.rects.front()];
    EXPECT_EQ(rect.pass.role, ReceiverPass::Role::mirrors);
    EXPECT_EQ(rect.pass.basis, 1U) << "the half";
    EXPECT_GE(std::size_t(rect.size.width) * std::size_t(rect.size.height), rect.pass.mirrors.size());
    for (const Mirror& mirror : rect.pass.mirrors) EXPECT_EQ(mirror.position.x, float(next++));
  }
  EXPECT_EQ(next, count);
}

TEST(Mirrors, MakeBatchesOfTheirOwn) {
  Plan plan = plan_with(1'200'000, of_mirrors());
  plan.tasks.push_back({0, "basis flat", 0, {}, CyclesSettings{}});
  group_tasks(plan, BakingSettings::Dispatch::scene);
  ASSERT_EQ(plan.batches.size(), 1U) << "the receivers'";
  group_mirrors(plan);
  EXPECT_EQ(plan.batches.size(), 4U);
  std::set<std::size_t> tasks;
  for (const Batch& batch : plan.batches) tasks.insert(batch.tasks.begin(), batch.tasks.end());
  EXPECT_EQ(tasks.size(), plan.tasks.size());
}

}  // namespace
}  // namespace rnmbake
