// The whole program against formulas: scenes of scenes/, built and baked by the Blender at hand.
#include "closed_forms/cases.h"
#include "closed_forms/horizon.h"
#include "closed_forms/workbench.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr double sun_allowance = 5e-4;  // of the sun's irradiance, for every texel
// Below the horizon faces are cut into pieces of a few texels, and samples beyond a piece's edge fold back
// into it: an error of the mean that falls with the texel's size.
constexpr double horizon_allowance = 1e-3;
// Noise must not widen an allowance to more than this share of the right answer.
constexpr double widest_allowance = 0.005;

void expect_suns(const Baked& baked, const std::vector<SunCase>& suns) {
  for (const SunCase& sun : suns) {
    const auto outcomes =
        compare(baked.lightmap(sun.object()), [&](const BasisDirection& basis) { return sun.truth(basis); });
    for (const Outcome& outcome : outcomes) {
      EXPECT_EQ(outcome.texels, 256U) << sun.object();
      EXPECT_LE(outcome.largest, sun_allowance) << sun.object() << " " << outcome.basis << ": mean "
                                                << outcome.mean << ", expected " << outcome.expected;
    }
  }
}

TEST(ClosedForms, SunsAtEveryAngleOnEveryKindOfPlane) {
  Workbench bench(RNMBAKE_BINARY, {});
  const Baked baked = bench.bake(bench.build({"suns", {}}), sun_flags());
  expect_suns(baked, plain_suns());
  expect_suns(baked, unusual_suns());
}

/// Bakes the case's object; means must agree within what is allowed.
void expect_uniform(const UniformCase& form, const Words& more_flags = {}) {
  Workbench bench(RNMBAKE_BINARY, {});
  Words flags = form.flags;
  flags.insert(flags.end(), {"--objects", form.object});
  flags.insert(flags.end(), more_flags.begin(), more_flags.end());
  const Baked baked = bench.bake(bench.build(form.scene), flags);
  for (const Outcome& outcome : compare(baked.lightmap(form.object), form.truth)) {
    EXPECT_GT(outcome.texels, 500U);
    EXPECT_LE(std::abs(outcome.error()), outcome.allowance())
        << outcome.basis << ": mean " << outcome.mean << ", expected " << outcome.expected
        << ", standard error " << outcome.standard_error;
    EXPECT_LE(outcome.allowance(), widest_allowance * outcome.expected) << outcome.basis;
  }
}

class UniformLight : public testing::TestWithParam<UniformCase> {};

TEST_P(UniformLight, MeansAgree) {
  expect_uniform(GetParam());
}

TEST(Gather, FurnaceAgrees) {
  const auto forms = uniform_cases();
  expect_uniform(*std::ranges::find(forms, "FurnaceHalf", &UniformCase::name), {"--recipe", "gather"});
}

TEST(Gather, SunsAreThoseOfReceivers) {
  Workbench bench(RNMBAKE_BINARY, {});
  Words flags = sun_flags();
  flags.insert(flags.end(), {"--recipe", "gather"});
  expect_suns(bench.bake(bench.build({"suns", {}}), flags), unusual_suns());
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, UniformLight, testing::ValuesIn(uniform_cases()),
                         [](const auto& form) { return form.param.name; });

class Horizon : public testing::TestWithParam<HorizonCase> {};

void expect_right(const ErrorSummary& errors, bool sun, const char* where) {
  const double share = sun ? horizon_allowance : 0.002 * errors.truth;
  EXPECT_GT(errors.texels, 250U) << where;
  EXPECT_LE(std::abs(errors.mean), std::max(share, 3 * errors.standard_error))
      << where << ": standard error " << errors.standard_error;
  if (sun) {  // a sky's is noise
    EXPECT_LE(errors.rms, 0.005) << where;
  }
}

TEST_P(Horizon, IdentityIsRight) {
  const HorizonCase& form = GetParam();
  Workbench bench(RNMBAKE_BINARY, {});
  const auto blend = bench.build(form.scene);
  const Baked baked = bench.bake(blend, horizon_flags());
  const HorizonOutcome outcome = compare_horizon(form, bench.survey(blend), baked.lightmap(form.object),
                                                 footprint_of(bench.blender().version));
  expect_right(outcome.above, form.sun, "above the horizon");
  expect_right(outcome.below, form.sun, "below the horizon");
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, Horizon, testing::ValuesIn(horizon_cases()),
                         [](const auto& form) { return form.param.name; });

}  // namespace
}  // namespace rnmbake
