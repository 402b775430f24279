#include "bake/mirrors.h"

#include "bake/point_receivers.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

/// Mirrors of one picture, the smallest thing that is tried again, and of one launch, where a memory limit
/// allows so many.
constexpr std::size_t task_mirrors = std::size_t(1) << 16;
constexpr std::size_t batch_mirrors = std::size_t(1) << 19;

/// Smaller than other receivers of a point: corner normals decide where it looks, so its face may be turned
/// by rounding, and so it need not stand as high over the surface.
double mirror_size(const Vec3d& point) {
  return point_receiver_size(point, 5);
}

}  // namespace

Vec3 mirror_position(const Vec3d& place, const Vec3& face) {
  return Vec3(place + Vec3d(face) * (1.25 * mirror_size(place)));
}

std::array<ReceiverCorner, 3> mirror_triangle(const Mirror& mirror, std::size_t texel, const RectSize& map) {
  const Vec3d point(mirror.position);
  return point_receiver(point, mirror.direction, mirror_size(point), texel, map);
}

void add_mirror_tasks(Plan& plan, std::size_t target, std::size_t half, bool meets_light,
                      const std::vector<Mirror>& mirrors, const CyclesSettings& cycles) {
  const std::size_t tasks = (mirrors.size() + task_mirrors - 1) / task_mirrors;
  for (std::size_t t = 0; t < tasks; ++t) {
    const std::size_t first = t * task_mirrors, last = std::min(mirrors.size(), first + task_mirrors);
    AtlasRect rect{target, {ReceiverPass::Role::mirrors, half, {}}, 0, 0, point_map(last - first)};
    rect.pass.mirrors.assign(mirrors.begin() + std::ptrdiff_t(first), mirrors.begin() + std::ptrdiff_t(last));
    rect.pass.meets_light = meets_light;
    const std::string name = fmt::format("{} {}/{} of half {}", meets_light ? "mirrors of lights" : "mirrors",
                                         t + 1, tasks, half + 1);
    plan.tasks.push_back({target, name, 0, {plan.rects.size()}, cycles});
    plan.rects.push_back(std::move(rect));
  }
}

void group_mirrors(Plan& plan) {
  std::vector<bool> is_grouped(plan.tasks.size());
  for (const Batch& batch : plan.batches) {
    for (const std::size_t task : batch.tasks) is_grouped[task] = true;
  }
  std::size_t filled = batch_mirrors;
  const CyclesSettings* settings = nullptr;
  for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
    if (is_grouped[task]) continue;
    const std::size_t mirrors = plan.rects[plan.tasks[task].rects.front()].pass.mirrors.size();
    if (filled + mirrors > batch_mirrors || !(*settings == plan.tasks[task].cycles)) {
      plan.batches.emplace_back();
      filled = 0;
      settings = &plan.tasks[task].cycles;
    }
    filled += mirrors;
    plan.batches.back().tasks.push_back(task);
  }
}

}  // namespace rnmbake
