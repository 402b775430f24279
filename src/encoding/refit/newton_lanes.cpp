#include "encoding/refit/newton_lanes.h"

#include "encoding/geomerics.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <array>
#include <cstddef>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/refit/newton_lanes.cpp"
#include <hwy/foreach_target.h>

#include "encoding/geomerics-inl.h"
#include "encoding/lanes-inl.h"
#include "encoding/refit/newton-inl.h"
#include "encoding/zh3-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

/// Four numbers of each lane, lane by lane in memory.
struct FourRows {
  alignas(64) std::array<std::array<double, Lanes::most>, 4> rows;

  [[nodiscard]] HWY_INLINE std::array<Lanes, 4> load() const {
    return {Lanes::load(rows[0].data()), Lanes::load(rows[1].data()), Lanes::load(rows[2].data()),
            Lanes::load(rows[3].data())};
  }
};

template <typename LobeFunction>
void newton_of(const LobeFunction& lobe, const std::array<Vec3d, 4>& directions,
               std::span<const FourBakes> bakes, std::span<FourNumbers> numbers) {
  FourEquations<Lanes, LaneVector> equations;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3d& direction = directions[k];
    equations.directions[k] = {direction.x, direction.y, direction.z};
  }
  for (std::size_t first = 0; first < bakes.size(); first += Lanes::count()) {
    FourRows wanted, x;
    for (std::size_t lane = 0; lane < Lanes::count(); ++lane) {
      const std::size_t i = std::min(first + lane, bakes.size() - 1);  // the last again, where lanes are left
      for (std::size_t k = 0; k < 4; ++k) wanted.rows[k][lane] = bakes[i][k];
      x.rows[0][lane] = numbers[i].a;
      for (std::size_t k = 0; k < 3; ++k) x.rows[k + 1][lane] = numbers[i].v[static_cast<int>(k)];
    }
    equations.bakes = wanted.load();
    const NewtonEnd<Lanes> end = newton(lobe, equations, x.load());
    alignas(64) std::array<double, Lanes::most> cost;
    end.cost.store(cost.data());
    for (std::size_t k = 0; k < 4; ++k) end.x[k].store(x.rows[k].data());
    for (std::size_t lane = 0; lane < std::min(Lanes::count(), bakes.size() - first); ++lane) {
      numbers[first + lane] = {
          x.rows[0][lane], {x.rows[1][lane], x.rows[2][lane], x.rows[3][lane]}, cost[lane] <= newton_arrived};
    }
  }
}

void newton_here(Lobe lobe, const std::array<Vec3d, 4>& directions, std::span<const FourBakes> bakes,
                 std::span<FourNumbers> numbers) {
  if (lobe == zh3_lobe) newton_of(Zh3(), directions, bakes, numbers);
  if (lobe == geomerics_lobe) newton_of(Geomerics(), directions, bakes, numbers);
}

}  // namespace
}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rnmbake {
namespace {

HWY_EXPORT(newton_here);

}  // namespace

void newton_in_lanes(Lobe lobe, const std::array<Vec3d, 4>& directions, std::span<const FourBakes> bakes,
                     std::span<FourNumbers> numbers) {
  for (FourNumbers& one : numbers) one.has_converged = false;
  HWY_DYNAMIC_DISPATCH(newton_here)(lobe, directions, bakes, numbers);
}

}  // namespace rnmbake
#endif
