#include "encoding/refit/flat_kept.h"

#include "encoding/geomerics.h"
#include "encoding/zh3.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

// What follows is compiled for each set of instructions; the order matters.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "encoding/refit/flat_kept.cpp"
#include <hwy/foreach_target.h>

#include "encoding/fit/gauss_newton-inl.h"
#include "encoding/geomerics-inl.h"
#include "encoding/lanes-inl.h"
#include "encoding/zh3-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace rnmbake::HWY_NAMESPACE {
namespace {

/// sh2_lobe().
struct Sh2 {
  template <typename Number, typename Vector>
  HWY_INLINE LobeOf<Number, Vector> operator()(Number a, const Vector& v, const Vector& normal) const {
    return {a + v.dot(normal), 1.0, normal};
  }
};

/// As many problems as there are lanes.
struct LaneProblems {
  std::array<Lanes, 4> bakes;  // in units of the greatest
  std::array<LaneVector, 4> directions;
  LaneVector towards;

  /// Loads from `first` on; the last problem again where lanes are left.
  LaneProblems(std::span<const FlatKeptProblem> problems, std::size_t first) {
    const auto load = [&](const auto& number_of) HWY_ATTR {
      alignas(64) std::array<double, Lanes::most> numbers{};
      for (std::size_t lane = 0; lane < Lanes::count(); ++lane)
        numbers[lane] = number_of(problems[std::min(first + lane, problems.size() - 1)]);
      return Lanes::load(numbers.data());
    };
    const auto load_vector = [&](const auto& vector_of) HWY_ATTR {
      return LaneVector{load([&](const FlatKeptProblem& one) HWY_ATTR { return vector_of(one).x; }),
                        load([&](const FlatKeptProblem& one) HWY_ATTR { return vector_of(one).y; }),
                        load([&](const FlatKeptProblem& one) HWY_ATTR { return vector_of(one).z; })};
    };
    for (std::size_t k = 0; k < 4; ++k) {
      bakes[k] = load([&](const FlatKeptProblem& one)
                          HWY_ATTR { return one.bakes[k] / *std::ranges::max_element(one.bakes); });
      directions[k] = load_vector([&](const FlatKeptProblem& one) HWY_ATTR { return one.directions[k]; });
    }
    towards = load_vector([](const FlatKeptProblem& one) HWY_ATTR { return one.towards; });
  }
};

/// Least squares over the three directions of the basis; a follows from the flat bake. The quotient
/// a = flat / shape(flat) is infinite at the border of what is allowed, so that steps never cross it.
template <typename LobeFunction>
struct FlatKept {
  LobeFunction lobe;
  const LaneProblems& problems;

  HWY_INLINE LaneResidual<3> operator()(const std::array<Lanes, 3>& ratio) const {
    const LaneVector v{ratio[0], ratio[1], ratio[2]};
    const auto flat = lobe(Lanes(1.0), v, problems.directions[0]);
    const Lanes a = problems.bakes[0] / flat.value;
    LaneResidual<3> residual;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = lobe(Lanes(1.0), v, problems.directions[k + 1]);
      const LaneVector slope = (value.by_v - flat.by_v * (value.value / flat.value)) * a;
      residual.values[k] = select(flat.value > 0.0, a * value.value - problems.bakes[k + 1],
                                  std::numeric_limits<double>::infinity());
      residual.jacobian[k] = {slope.x, slope.y, slope.z};
    }
    return residual;
  }
};

template <typename LobeFunction>
void flat_kept_of(const LobeFunction& lobe, std::span<const FlatKeptProblem> problems, double range,
                  std::span<Vec3d> ratios) {
  for (std::size_t first = 0; first < problems.size(); first += Lanes::count()) {
    const LaneProblems some(problems, first);
    const FlatKept<LobeFunction> model{lobe, some};
    const LaneVector axis = some.towards / max(sqrt(some.towards.dot(some.towards)), no_length);
    LaneMinimum<3> best{{0.0, 0.0, 0.0}, std::numeric_limits<double>::infinity()};
    for (const double start : {range, 0.5, 0.0}) {  // a constant lobe is always allowed
      const auto clamped = [&](Lanes x) HWY_ATTR { return min(max(x * start, -range), range); };
      const LaneMinimum<3> found =
          damped_gauss_newton(model, std::array{clamped(axis.x), clamped(axis.y), clamped(axis.z)}, range);
      const auto is_better = found.cost < best.cost;
      for (std::size_t i = 0; i < 3; ++i) best.at[i] = select(is_better, found.at[i], best.at[i]);
      best.cost = select(is_better, found.cost, best.cost);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      alignas(64) std::array<double, Lanes::most> numbers{};
      best.at[i].store(numbers.data());
      for (std::size_t lane = 0; lane < std::min(Lanes::count(), problems.size() - first); ++lane)
        ratios[first + lane][static_cast<int>(i)] = numbers[lane];
    }
  }
}

void flat_kept_here(Lobe lobe, std::span<const FlatKeptProblem> problems, double range,
                    std::span<Vec3d> ratios) {
  if (lobe == zh3_lobe) {
    flat_kept_of(Zh3(), problems, range, ratios);
  } else if (lobe == geomerics_lobe) {
    flat_kept_of(Geomerics(), problems, range, ratios);
  } else {
    flat_kept_of(Sh2(), problems, range, ratios);
  }
}

}  // namespace
}  // namespace rnmbake::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rnmbake {
namespace {

HWY_EXPORT(flat_kept_here);

}  // namespace

std::vector<Vec3d> flat_kept(Lobe lobe, std::span<const FlatKeptProblem> problems, double range) {
  std::vector<Vec3d> ratios(problems.size(), Vec3d(0));
  HWY_DYNAMIC_DISPATCH(flat_kept_here)(lobe, problems, range, ratios);
  return ratios;
}

}  // namespace rnmbake
#endif
