#include "ssbump/map/lobes.h"

#include "encoding/rnm.h"

#include <algorithm>
#include <cmath>

namespace rnmbake {
namespace {

/// Gauss-Legendre, 8 points on [-1, 1]: half of them, the other half is their mirror image.
constexpr std::array<double, 4> nodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                      0.9602898564975363};
constexpr std::array<double, 4> node_weights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                             0.1012285362903763};

template <typename Function>
double integral(double from, double to, int pieces, const Function& f) {
  const double half = (to - from) / (2 * pieces);
  double sum = 0;
  for (int piece = 0; piece < pieces; ++piece) {
    const double middle = from + half * (2 * piece + 1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sum += node_weights[i] * (f(middle - half * nodes[i]) + f(middle + half * nodes[i]));
  }
  return sum * half;
}

/// The antiderivative at power 1, from `elevation` to the zenith.
double linear_above(double along, double axis_z, double elevation) {
  const double sine = std::sin(elevation), cosine = std::cos(elevation);
  return (along * (pi / 2 - elevation - sine * cosine) + axis_z * cosine * cosine) / 2;
}

}  // namespace

std::array<Lobe, SsbumpWeights::channels> ssbump_lobes(double power) {
  const auto basis = rnm_basis();
  const auto lobe = [&](const Vec3& axis) { return Lobe{Vec3d(axis), power}; };
  return {lobe(basis[0]), lobe(basis[1]), lobe(basis[2]), lobe(Vec3(0, 0, 1)), Lobe{Vec3d(0, 0, 1), 1}};
}

double lobe_value(const Lobe& lobe, const Vec3d& direction) {
  const double cosine = std::max(0.0, direction.dot(lobe.axis));
  return lobe.power == 1 ? cosine : std::pow(cosine, lobe.power);
}

double lobe_above(double along, double axis_z, double power, double sine) {
  const double begins = along < 0 ? std::atan2(-along, axis_z) : 0;  // the lobe is 0 below
  const double elevation = std::max(begins, std::asin(std::clamp(sine, 0.0, 1.0)));
  if (power == 1) return linear_above(along, axis_z, elevation);
  return integral(elevation, pi / 2, 8, [&](double at) {
    return std::pow(std::max(0.0, along * std::cos(at) + axis_z * std::sin(at)), power) * std::cos(at);
  });
}

double lobe_whole(const Lobe& lobe) {
  if (lobe.power == 1) return pi * (1 + lobe.axis.z) / 2;
  const double across = std::hypot(lobe.axis.x, lobe.axis.y);
  return 2 * integral(0, pi, 16, [&](double azimuth) {
           return lobe_above(across * std::cos(azimuth), lobe.axis.z, lobe.power, 0);
         });
}

}  // namespace rnmbake
