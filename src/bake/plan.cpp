#include "bake/plan.h"

#include "bake/texel_centres.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace rnmbake {
namespace {

/// Crops to whole texels around the UVs, one texel more on each side against rounding.
AtlasRect crop(std::size_t target, const RectSize& map, ReceiverPass pass) {
  Vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const ReceiverCorner& corner : pass.corners) {
    for (int axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], corner.uv[axis]);
      high[axis] = std::max(high[axis], corner.uv[axis]);
    }
  }
  const auto below = [](float uv, int side) {
    return std::clamp(int(std::floor(uv * float(side))) - 1, 0, side - 1);
  };
  const auto above = [](float uv, int side) {
    return std::clamp(int(std::ceil(uv * float(side))) + 1, 1, side);
  };
  AtlasRect rect{target, std::move(pass), below(low.x, map.width), below(low.y, map.height), {}};
  rect.size = {above(high.x, map.width) - rect.x, above(high.y, map.height) - rect.y};
  return rect;
}

}  // namespace

PlanTarget plan_target(const SceneSurvey& survey, const Target& target) {
  return {target.key, {target.width, target.height}, survey.objects[target.object].light_group};
}

std::vector<std::string> task_names(const std::vector<BasisDirection>& bases) {
  std::vector<std::string> names;
  names.reserve(bases.size());
  for (const BasisDirection& basis : bases) names.push_back("basis " + basis.name);
  return names;
}

void add_receiver_tasks(Plan& plan, PlanTarget target, ReceiverPasses passes,
                        const std::vector<std::string>& names, const CyclesSettings& cycles) {
  const std::size_t index = plan.targets.size(), first = plan.tasks.size();
  for (std::size_t b = 0; b < names.size(); ++b) plan.tasks.push_back({index, names[b], b, {}, cycles});
  BakeTask horizon{index, "horizon", 0, {}, cycles};
  for (ReceiverPass& pass : passes.passes) {
    if (pass.corners.empty()) continue;
    BakeTask& task = pass.role == ReceiverPass::Role::moment ? horizon : plan.tasks[first + pass.basis];
    task.rects.push_back(plan.rects.size());
    plan.rects.push_back(crop(index, target.map, std::move(pass)));
    // After the crop, so that the layout, and with it the noise, is the whole surface's.
    drop_between_centres(plan.rects.back().pass.corners, target.map);
  }
  if (!horizon.rects.empty()) plan.tasks.push_back(std::move(horizon));
  plan.targets.push_back(std::move(target));
}

void add_object_tasks(Plan& plan, PlanTarget target, const std::vector<std::string>& names,
                      const CyclesSettings& cycles) {
  const std::size_t index = plan.targets.size();
  for (std::size_t b = 0; b < names.size(); ++b) {
    plan.tasks.push_back({index, names[b], b, {plan.rects.size()}, cycles});
    plan.rects.push_back({index, {ReceiverPass::Role::basis, b, {}}, 0, 0, target.map});
  }
  plan.targets.push_back(std::move(target));
}

void group_tasks(Plan& plan, BakingSettings::Dispatch mode) {
  using Mode = BakingSettings::Dispatch;
  const auto belongs = [&](const Batch& batch, const BakeTask& task) {
    const BakeTask& first = plan.tasks[batch.tasks.front()];
    if (mode == Mode::basis || !(first.cycles == task.cycles)) return false;
    return mode == Mode::scene || first.target == task.target;
  };
  for (std::size_t u = 0; u < plan.tasks.size(); ++u) {
    if (plan.tasks[u].cycles.mirrors) continue;  // group_mirrors()
    const auto found = std::find_if(plan.batches.begin(), plan.batches.end(),
                                    [&](const Batch& d) { return belongs(d, plan.tasks[u]); });
    if (found != plan.batches.end()) {
      found->tasks.push_back(u);
    } else {
      plan.batches.push_back({{u}});
    }
  }
}

BakingSettings::Dispatch resolve_dispatch(const BakingSettings& settings) {
  if (settings.dispatch != BakingSettings::Dispatch::automatic) return settings.dispatch;
  return settings.recipe == BakingSettings::Recipe::flat_normal_map ? BakingSettings::Dispatch::object
                                                                    : BakingSettings::Dispatch::scene;
}

std::int64_t texels_of(const Plan& plan, const std::vector<std::size_t>& rects) {
  std::int64_t texels = 0;
  for (const std::size_t rect : rects)
    texels += std::int64_t(plan.rects[rect].size.width) * plan.rects[rect].size.height;
  return texels;
}

std::vector<Batch> cut(const Batch& batch, const Plan& plan, std::int64_t max_pixels) {
  std::map<std::size_t, std::int64_t> pixels;  // of each target
  for (const std::size_t task : batch.tasks)
    pixels[plan.tasks[task].target] += texels_of(plan, plan.tasks[task].rects);
  std::map<std::size_t, std::size_t> place;  // target -> batch
  std::vector<Batch> batches;
  std::int64_t filled = 0;
  for (const std::size_t task : batch.tasks) {
    const std::size_t target = plan.tasks[task].target;
    const auto [known, is_new] = place.try_emplace(target);
    if (is_new) {
      filled += pixels[target];
      if (batches.empty() || filled > max_pixels) {
        batches.emplace_back();
        filled = pixels[target];
      }
      known->second = batches.size() - 1;
    }
    batches[known->second].tasks.push_back(task);
  }
  return batches;
}

std::vector<Batch> split(const Batch& batch, const Plan& plan) {
  const auto& tasks = batch.tasks;
  if (tasks.size() < 2) return {batch};
  std::size_t middle = tasks.size() / 2;
  const auto target_of = [&](std::size_t i) { return plan.tasks[tasks[i]].target; };
  if (target_of(0) != target_of(tasks.size() - 1)) {
    while (middle > 1 && target_of(middle) == target_of(middle - 1)) --middle;
    while (middle + 1 < tasks.size() && target_of(middle) == target_of(middle - 1)) ++middle;
  }
  const auto cut = tasks.begin() + static_cast<std::ptrdiff_t>(middle);
  return {Batch{{tasks.begin(), cut}}, Batch{{cut, tasks.end()}}};
}

std::int64_t atlas_pixels(std::int64_t atlas_limit, std::int64_t memory, std::int64_t scene_triangles,
                          std::int64_t receiver_triangles) {
  const std::int64_t left =
      memory - scene_triangles * bytes_per_scene_triangle - receiver_triangles * bytes_per_receiver_triangle;
  const std::int64_t most = std::max<std::int64_t>(atlas_limit, 1);
  return std::clamp(left / bytes_per_pixel, std::min<std::int64_t>(most, 1 << 20), most);
}

}  // namespace rnmbake
