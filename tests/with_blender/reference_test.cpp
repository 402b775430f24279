// rnmbake reference against formulas: the scenes that the bake is held against, through the same program.
#include "closed_forms/cases.h"
#include "closed_forms/workbench.h"
#include "lightmap/metadata.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

// Cycles' units of a sun's strength and the tracer's agree to this, for every texel.
constexpr double sun_allowance = 5e-4;

TEST(Reference, SunsAtEveryAngleOnEveryKindOfPlane) {
  Workbench bench(RNMBAKE_BINARY, {});
  const Baked traced = bench.reference(bench.build({"suns", {}}), sun_flags());
  std::vector<SunCase> suns = plain_suns();
  for (const SunCase& sun : unusual_suns()) suns.push_back(sun);
  for (const SunCase& sun : suns) {
    const auto outcomes =
        compare(traced.lightmap(sun.object()), [&](const BasisDirection& basis) { return sun.truth(basis); });
    for (const Outcome& outcome : outcomes) {
      EXPECT_EQ(outcome.texels, 256U) << sun.object();
      EXPECT_LE(outcome.largest, sun_allowance) << sun.object() << " " << outcome.basis << ": mean "
                                                << outcome.mean << ", expected " << outcome.expected;
    }
  }
}

class UniformReference : public testing::TestWithParam<UniformCase> {};

TEST_P(UniformReference, MeansAgreeAndStandardErrorsAreTrue) {
  const UniformCase& form = GetParam();
  Workbench bench(RNMBAKE_BINARY, {});
  Words flags = form.flags;
  flags.insert(flags.end(), {"--objects", form.object});
  const LayeredImage lightmap = bench.reference(bench.build(form.scene), flags).lightmap(form.object);
  EXPECT_EQ(read_metadata(lightmap, form.object).recipe, "reference");
  for (const Outcome& outcome : compare(lightmap, form.truth)) {
    EXPECT_GT(outcome.texels, 500U);
    EXPECT_LE(std::abs(outcome.error()), outcome.allowance())
        << outcome.basis << ": mean " << outcome.mean << ", expected " << outcome.expected
        << ", standard error " << outcome.standard_error;
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, UniformReference, testing::ValuesIn(uniform_cases()),
                         [](const auto& form) { return form.param.name; });

/// RMS over the texels of a smooth cylinder in the sun, its faces about as wide as a texel: reference minus
/// bake, over the mean.
double cylinder_difference(Workbench& bench, Words flags, const Words& of_bake, const Words& of_reference) {
  const auto blend = bench.build({"smooth_cylinder", {"sides=48"}});
  flags.insert(flags.end(), {"--samples", "512", "--bounces", "0", "--bases", "flat"});
  const auto with = [&](Words more) {
    more.insert(more.end(), flags.begin(), flags.end());
    return more;
  };
  const LayeredImage baked = bench.bake(blend, with(of_bake)).lightmap("smooth_cylinder");
  const LayeredImage traced = bench.reference(blend, with(of_reference)).lightmap("smooth_cylinder");
  const FloatImage &ours = traced.find("")->pixels, &theirs = baked.find("")->pixels;
  double squares = 0, sum = 0;
  for (int y = 0; y < ours.height(); ++y) {
    for (int x = 0; x < ours.width(); ++x) {
      const double value = ours.texel(x, y)[0];
      squares += std::pow(value - theirs.texel(x, y)[0], 2);
      sum += value;
    }
  }
  return std::sqrt(squares * double(ours.width()) * ours.height()) / sum;
}

// The normals turn by 45 degrees within a texel: what a texel averages over, and what becomes of samples past
// a face's edge, decides most of its value. No other choice of the two comes below 1 %.
TEST(Reference, AveragesOverTheSamePlacesAsThisBlender) {
  Workbench bench(RNMBAKE_BINARY, {});
  EXPECT_LT(cylinder_difference(bench, {"--resolution", "32"}, {}, {}), 0.005);
}

// The sun stands under many faces and above their normals' horizons: 30 % without that light.
TEST(Reference, LightFromBelowIsWhatThisBlenderLetsBy) {
  Workbench bench(RNMBAKE_BINARY, {});
  EXPECT_LT(cylinder_difference(bench, {"--resolution", "64"}, {"--recipe", "flat-normal-map"},
                                {"--model", "flat-normal-map"}),
            0.005);
}

// The same scene again from its .rnmscene, without a Blender: the same bytes.
TEST(Reference, TakesAnExportedSceneWithoutBlender) {
  Workbench bench(RNMBAKE_BINARY, {});
  const auto blend = bench.build({"plane_lamp", {}});
  const auto scene = bench.exported(blend);
  const Words flags{"--resolution", "8", "--samples", "16", "--objects", "plane"};
  const LayeredImage from_blend = bench.reference(blend, flags).lightmap("plane");
  Words alone = flags;
  alone.insert(alone.end(), {"--blender", "/nowhere/blender"});
  const LayeredImage from_scene = bench.reference(scene, alone).lightmap("plane");
  for (const char* name : {"", "rnm0", "rnm1", "rnm2", "flat_stderr", "coverage", "validity"}) {
    ASSERT_NE(from_scene.find(name), nullptr) << name;
    EXPECT_EQ(from_scene.find(name)->pixels.data(), from_blend.find(name)->pixels.data()) << name;
  }
}

}  // namespace
}  // namespace rnmbake
