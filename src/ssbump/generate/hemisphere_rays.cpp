#include "ssbump/generate/hemisphere_rays.h"

#include "encoding/rnm.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace rnmbake {
namespace {

constexpr int kept_rays = 1 << 18;  // of all sets together
constexpr int most_sets = 256;
/// Steps of Roberts' R2 sequence: the sets together are spread as evenly as each is.
constexpr double plastic = 0.7548776662466927;

/// The digits of a number in base 2, mirrored at the point: in [0, 1).
double radical_inverse(std::uint32_t index) {
  double value = 0;
  for (double digit = 0.5; index != 0; index >>= 1, digit /= 2) value += (index & 1U) != 0 ? digit : 0;
  return value;
}

double wrapped(double value) {
  return value - std::floor(value);
}

SsbumpChannels weights_of(const Vec3& direction, double power) {
  const auto raised = [&](float cosine) {
    if (!(cosine > 0)) return 0.0F;
    return power == 1 ? cosine : static_cast<float>(std::pow(double{cosine}, power));
  };
  const auto basis = rnm_basis();
  return {raised(direction.dot(basis[0])), raised(direction.dot(basis[1])), raised(direction.dot(basis[2])),
          raised(direction.z), std::max(0.0F, direction.z)};
}

/// `over` and `round` in [0, 1): where in its ring of solid angle a ray lies, and how far the set is turned.
std::vector<WeightedRay> make_set(int rays, double power, double over, double round) {
  std::vector<WeightedRay> set;
  set.reserve(static_cast<std::size_t>(rays));
  for (int i = 0; i < rays; ++i) {
    const double z = (i + over) / rays;  // uniform in solid angle
    const double angle = 2 * pi * wrapped(radical_inverse(static_cast<std::uint32_t>(i)) + round);
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec3 direction(Vec3d(r * std::cos(angle), r * std::sin(angle), z));
    set.push_back({direction, weights_of(direction, power)});
  }
  return set;
}

}  // namespace

HemisphereRays::HemisphereRays(int rays, double power, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int count = std::clamp(kept_rays / rays, 2, most_sets);
  const double over = uniform(random), round = uniform(random);
  for (int i = 0; i < count; ++i)
    sets_.push_back(
        make_set(rays, power, wrapped(over + i * plastic), wrapped(round + i * plastic * plastic)));
}

}  // namespace rnmbake
