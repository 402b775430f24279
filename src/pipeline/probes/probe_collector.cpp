#include "pipeline/probes/probe_collector.h"

#include "base/log.h"
#include "base/numeric/row_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rnmbake {

ProbeCollector::ProbeCollector(const Plan& plan, const std::vector<ProbeBlock>& blocks,
                               std::vector<ProbeTerm> terms, std::size_t directions)
    : plan_(plan), terms_(std::move(terms)), directions_(directions) {
  std::size_t positions = 0;
  for (const ProbeBlock& block : blocks) {
    blocks_.push_back({block});
    positions = std::max(positions, block.first + block.count);
  }
  for (const BakeTask& task : plan.tasks) ++blocks_[task.target].missing;
  sums_.assign(positions * directions, Vec3d(0, 0, 0));
  differences_ = sums_;
  holed_.assign(positions, false);
}

void ProbeCollector::take(const Batch& batch, const BatchLayout& layout, std::vector<BakedPicture> pictures) {
  const std::lock_guard lock(mutex_);
  std::size_t next = 0;
  for (const std::size_t index : batch.tasks) {
    const BakeTask& task = plan_.tasks[index];
    Block& block = blocks_[task.target];
    const bool is_wanted = !block.given_up && block.missing > 0;
    for (std::size_t i = 0; i < task.rects.size(); ++i, ++next) {
      if (is_wanted) add(plan_.rects[layout.rects[next]], pictures[next], sign_of(task));
    }
    if (is_wanted) --block.missing;
  }
}

void ProbeCollector::give_up(std::size_t target, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  if (std::exchange(blocks_[target].given_up, true)) return;
  log::error("{}: {}", plan_.targets[target].key, reason);
}

bool ProbeCollector::is_settled(std::size_t target) const {
  const std::lock_guard lock(mutex_);
  return blocks_[target].given_up || blocks_[target].missing == 0;
}

std::vector<Vec3> ProbeCollector::irradiance() const {
  const std::vector<bool> baked = is_baked();
  std::vector<Vec3> values;
  values.reserve(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Vec3d& sum = sums_[i];
    const Vec3 value(float(std::max(sum.x, 0.0)), float(std::max(sum.y, 0.0)), float(std::max(sum.z, 0.0)));
    values.push_back(baked[i / directions_] ? value : Vec3(0));
  }
  return values;
}

std::vector<Vec3> ProbeCollector::standard_errors() const {
  if (variance_factor_ == 0) return {};
  const double factor = std::sqrt(variance_factor_);
  std::vector<Vec3> errors;
  errors.reserve(differences_.size());
  for (const Vec3d& d : differences_)
    errors.emplace_back(float(std::abs(d.x) * factor), float(std::abs(d.y) * factor),
                        float(std::abs(d.z) * factor));
  return errors;
}

std::vector<bool> ProbeCollector::is_baked() const {
  const std::lock_guard lock(mutex_);
  std::vector<bool> baked(holed_.size(), false);
  for (const Block& block : blocks_) {
    const auto [first, count] = block.positions;
    for (std::size_t i = first; i < first + count; ++i) baked[i] = is_complete(block) && !holed_[i];
  }
  return baked;
}

std::vector<std::size_t> ProbeCollector::holes() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::size_t> holes;
  for (const Block& block : blocks_) {
    const auto [first, count] = block.positions;
    for (std::size_t i = first; i < first + count; ++i) {
      if (is_complete(block) && holed_[i]) holes.push_back(i);
    }
  }
  return holes;
}

void ProbeCollector::add(const AtlasRect& rect, const BakedPicture& baked, double sign) {
  const FloatImage picture = baked.mean();
  variance_factor_ = baked.variance_factor();
  const ProbeBlock& block = blocks_[rect.target].positions;
  const RectSize map = plan_.targets[rect.target].map;
  for (std::size_t i = 0; i < block.count; ++i) {
    const int x = static_cast<int>(i) % map.width - rect.x, y = static_cast<int>(i) / map.width - rect.y;
    const auto texel = picture.texel(x, other_row(y, picture.height()));
    const Vec3d value(texel[0], texel[1], texel[2]);
    if (texel[3] > 0.5F && std::isfinite(value.length2())) {
      const std::size_t at = (block.first + i) * directions_ + rect.pass.basis;
      sums_[at] += value * sign;
      if (baked.has_error()) {
        const int row = other_row(y, picture.height());
        differences_[at] +=
            (Vec3d(vec3_at(baked.halves[0], x, row)) - Vec3d(vec3_at(baked.halves[1], x, row))) * sign;
      }
    } else {
      holed_[block.first + i] = true;
    }
  }
}

double ProbeCollector::sign_of(const BakeTask& task) const {
  return std::ranges::find(terms_, task.cycles, &ProbeTerm::cycles)->sign;
}

}  // namespace rnmbake
