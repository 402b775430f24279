// shaders/shader_runs.h - runs functions of shaders/ on many random cases and holds them against C++.
#pragma once

#include "base/math.h"
#include "shaders/engines.h"
#include "support/gl_compute.h"

#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace rnmbake {

inline constexpr std::size_t shader_cases = 2000;

/// One context for the tests of a program; fails the test that asks first where there is none.
inline GlCompute& gl_compute() {
  static GlCompute compute;
  return compute;
}

inline std::string glsl_of(const std::vector<std::string>& names) {
  return shader_text(engine_named("glsl"), names);
}

class RandomVectors {
 public:
  /// Each component in [least, greatest).
  Vec3 within(float least, float greatest) {
    std::uniform_real_distribution<float> one(least, greatest);
    return {one(random_), one(random_), one(random_)};
  }
  Vec3 direction() {
    std::normal_distribution<float> gauss;
    return unit({gauss(random_), gauss(random_), gauss(random_)});
  }
  Vec3 normal_above() {
    const Vec3 n = direction();
    return {n.x, n.y, std::abs(n.z)};
  }
  /// What 8 bits make of a value in [0, 1].
  Vec3 bytes() {
    std::uniform_int_distribution<int> one(0, 255);
    const auto byte = [&] { return static_cast<float>(one(random_)) / 255; };
    return {byte(), byte(), byte()};
  }

 private:
  std::mt19937 random_{7};
};

/// Fills in one case's vectors.
using MakeCase = std::function<void(RandomVectors&, std::span<Vec3>)>;
using OfCase = std::function<Vec3(std::span<const Vec3>)>;

struct ShaderRun {
  std::vector<std::string> shaders;  // names of the catalogue
  std::string body;                  // of GlCompute::run
  std::size_t width = 1;             // vectors of a case
};

/// Every case's result is that of `expected` within `relative` of the greatest magnitude among its inputs and
/// results.
inline void expect_same(const ShaderRun& run, const MakeCase& make, const OfCase& expected,
                        float relative = 1e-5F) {
  RandomVectors random;
  std::vector<Vec3> inputs(shader_cases * run.width);
  const auto of = [&](std::size_t i) { return std::span(inputs).subspan(i * run.width, run.width); };
  for (std::size_t i = 0; i < shader_cases; ++i) make(random, of(i));
  const auto results = gl_compute().run(glsl_of(run.shaders), run.body, run.width, inputs);
  ASSERT_EQ(results.size(), shader_cases);
  double moved = 0;
  for (std::size_t i = 0; i < shader_cases; ++i) {
    const Vec3 wanted = expected(of(i));
    float scale = wanted.length();
    for (const Vec3& input : of(i)) scale = std::max(scale, input.length());
    ASSERT_LE((results[i] - wanted).length(), relative * scale)
        << "case " << i << ": " << results[i] << ", not " << wanted;
    moved += wanted.length();
  }
  EXPECT_GT(moved, 0);
}

}  // namespace rnmbake
