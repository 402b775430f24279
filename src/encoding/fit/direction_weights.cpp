#include "encoding/fit/direction_weights.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Dense>

namespace rnmbake {
namespace {

/// Singular values of G below this share of the greatest are taken as 0: the lobes of axes that are alike.
constexpr double least_singular = 1e-9;

using Row = Eigen::Index;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Vector = Eigen::VectorXd;

Row row(std::size_t i) {
  return static_cast<Row>(i);
}

Eigen::Map<const Vector> vector_of(const std::vector<double>& values) {
  return {values.data(), row(values.size())};
}

Eigen::Map<const Matrix> square_of(const std::vector<double>& values, std::size_t side) {
  return {values.data(), row(side), row(side)};
}

/// The least squares on the lobes `used` alone; 0 for the others.
Vector solved_on(const Eigen::Map<const Matrix>& gram, const Eigen::Map<const Vector>& t,
                 const std::vector<Row>& used) {
  const Eigen::MatrixXd part = gram(used, used);
  const Vector right = t(used);
  const Vector some = part.ldlt().solve(right);
  Vector all = Vector::Zero(t.size());
  for (std::size_t i = 0; i < used.size(); ++i) all(used[i]) = some(row(i));
  return all;
}

/// Moves from `at` towards `goal` until the first weight of `used` reaches 0; takes it and its like out.
void step_back(Vector& at, const Vector& goal, std::vector<Row>& used) {
  double share = 1;
  for (const Row i : used)
    if (goal(i) <= 0) share = std::min(share, at(i) / (at(i) - goal(i)));
  at += share * (goal - at);
  std::erase_if(used, [&](Row i) {
    const bool is_out = goal(i) <= 0 && at(i) <= 1e-12;
    if (is_out) at(i) = 0;
    return is_out;
  });
}

}  // namespace

DirectionWeights::DirectionWeights(const std::vector<Vec3>& axes, const std::vector<Vec3>& directions)
    : sums_(axes.size()) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    for (const Vec3& direction : directions) {
      lobes_.push_back(std::max(0.0F, direction.dot(axes[i])));
      sums_[i] += double{lobes_.back()};
    }
  }
  const std::size_t n = directions.size();
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = 0; j < axes.size(); ++j)
      gram_.push_back(std::inner_product(&lobes_[i * n], &lobes_[i * n] + n, &lobes_[j * n], 0.0,
                                         std::plus<>(),
                                         [](float a, float b) { return double{a} * double{b}; }));
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> parts(axes.size(), axes.size());
  parts.setThreshold(least_singular);
  parts.compute(square_of(gram_, axes.size()));
  const Matrix inverse = parts.pseudoInverse();
  inverse_.assign(inverse.data(), inverse.data() + inverse.size());
  const Vector sky = inverse * vector_of(sums_);
  const double whole = vector_of(sums_).dot(sky);
  for (const double part : sky) sky_.push_back(part / whole);
}

void DirectionWeights::solve(std::span<const float> response, WeightSign sign,
                             std::span<float> weights) const {
  std::vector<double> t(count());
  double sky = 0;
  for (const float value : response) sky += double{value};
  for (std::size_t i = 0; i < t.size(); ++i) {
    const float* lobe = &lobes_[i * response.size()];
    for (std::size_t k = 0; k < response.size(); ++k) t[i] += double{lobe[k]} * double{response[k]};
  }
  const std::vector<double> found = sign == WeightSign::free ? free_of(t, sky) : positive_of(t, sky);
  std::ranges::transform(found, weights.begin(), [](double value) { return static_cast<float>(value); });
}

std::vector<double> DirectionWeights::free_of(const std::vector<double>& t, double sky) const {
  Vector s = square_of(inverse_, count()) * vector_of(t);
  s += vector_of(sky_) * (sky - vector_of(sums_).dot(s));
  return {s.begin(), s.end()};
}

std::vector<double> DirectionWeights::positive_of(const std::vector<double>& t, double sky) const {
  const auto gram = square_of(gram_, count());
  const auto right = vector_of(t);
  const double enough = 1e-9 * gram.diagonal().maxCoeff();
  Vector s = Vector::Zero(right.size());
  std::vector<Row> used;
  for (std::size_t round = 0; round < 3 * count(); ++round) {
    Vector gain = right - gram * s;
    for (const Row i : used) gain(i) = 0;
    Row best = 0;
    if (gain.maxCoeff(&best) <= enough) break;
    used.push_back(best);
    for (Vector goal = solved_on(gram, right, used);; goal = solved_on(gram, right, used)) {
      const bool is_within = std::ranges::all_of(used, [&](Row i) { return goal(i) > 0; });
      if (is_within) {
        s = goal;
        break;
      }
      step_back(s, goal, used);
      if (used.empty()) break;
    }
  }
  const double whole = vector_of(sums_).dot(s);
  if (whole > 0) s *= sky / whole;
  return {s.begin(), s.end()};
}

}  // namespace rnmbake
