#include "bake/plan.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace rnmbake {
namespace {

/// Crops to whole texels around the UVs, one texel more on each side against rounding.
Tile crop(std::size_t target_index, const Target& target, Sheet sheet) {
  Vec2 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
  for (const ReceiverCorner& corner : sheet.corners) {
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
  Tile tile{target_index, std::move(sheet), below(low.x, target.width), below(low.y, target.height), {}};
  tile.size = {above(high.x, target.width) - tile.x, above(high.y, target.height) - tile.y};
  return tile;
}

}  // namespace

void add_receiver_units(Plan& plan, std::size_t target_index, const Target& target, Sheets sheets,
                        const std::vector<BasisDirection>& bases, const CyclesSettings& cycles) {
  const std::size_t first = plan.units.size();
  for (std::size_t b = 0; b < bases.size(); ++b)
    plan.units.push_back({target_index, bases[b].name, b, {}, cycles});
  Unit horizon{target_index, "horizon", 0, {}, cycles};
  for (Sheet& sheet : sheets.sheets) {
    if (sheet.corners.empty()) continue;
    Unit& unit = sheet.role == Sheet::Role::moment ? horizon : plan.units[first + sheet.basis];
    unit.tiles.push_back(plan.tiles.size());
    plan.tiles.push_back(crop(target_index, target, std::move(sheet)));
  }
  if (!horizon.tiles.empty()) plan.units.push_back(std::move(horizon));
}

void add_object_units(Plan& plan, std::size_t target_index, const Target& target,
                      const std::vector<BasisDirection>& bases, const CyclesSettings& cycles) {
  for (std::size_t b = 0; b < bases.size(); ++b) {
    plan.units.push_back({target_index, bases[b].name, b, {plan.tiles.size()}, cycles});
    plan.tiles.push_back({target_index, {Sheet::Role::basis, b, {}}, 0, 0, {target.width, target.height}});
  }
}

void group_units(Plan& plan, BakingSettings::Dispatch mode) {
  using Mode = BakingSettings::Dispatch;
  const auto belongs = [&](const Dispatch& dispatch, const Unit& unit) {
    const Unit& first = plan.units[dispatch.units.front()];
    if (mode == Mode::basis || !(first.cycles == unit.cycles)) return false;
    return mode == Mode::scene || first.target == unit.target;
  };
  for (std::size_t u = 0; u < plan.units.size(); ++u) {
    const auto found = std::find_if(plan.dispatches.begin(), plan.dispatches.end(),
                                    [&](const Dispatch& d) { return belongs(d, plan.units[u]); });
    if (found != plan.dispatches.end()) {
      found->units.push_back(u);
    } else {
      plan.dispatches.push_back({{u}});
    }
  }
}

BakingSettings::Dispatch resolve_dispatch(const BakingSettings& settings) {
  if (settings.dispatch != BakingSettings::Dispatch::automatic) return settings.dispatch;
  return settings.recipe == BakingSettings::Recipe::receiver ? BakingSettings::Dispatch::scene
                                                             : BakingSettings::Dispatch::object;
}

std::vector<Dispatch> split(const Dispatch& dispatch, const Plan& plan) {
  const auto& units = dispatch.units;
  if (units.size() < 2) return {dispatch};
  std::size_t middle = units.size() / 2;
  const auto target_of = [&](std::size_t i) { return plan.units[units[i]].target; };
  if (target_of(0) != target_of(units.size() - 1)) {
    while (middle > 1 && target_of(middle) == target_of(middle - 1)) --middle;
    while (middle + 1 < units.size() && target_of(middle) == target_of(middle - 1)) ++middle;
  }
  const auto cut = units.begin() + static_cast<std::ptrdiff_t>(middle);
  return {Dispatch{{units.begin(), cut}}, Dispatch{{cut, units.end()}}};
}

std::int64_t atlas_pixels(std::int64_t atlas_limit, std::int64_t memory, std::int64_t scene_triangles,
                          std::int64_t receiver_triangles) {
  const std::int64_t left =
      memory - scene_triangles * bytes_per_scene_triangle - receiver_triangles * bytes_per_receiver_triangle;
  const std::int64_t most = std::max<std::int64_t>(atlas_limit, 1);
  return std::clamp(left / bytes_per_pixel, std::min<std::int64_t>(most, 1 << 20), most);
}

}  // namespace rnmbake
