// rnmbake bake --engine embree against Cycles: two independent estimates of the same light.
#include "closed_forms/workbench.h"
#include "encoding/basis_set.h"
#include "lightmap/metadata.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

struct EngineDifference {
  double mean = 0, standard_error = 0, level = 0;  // E/pi
  std::size_t texels = 0;
};

/// Mean over texels and colours of `ours` - `theirs`. Colours of a texel share their paths, texels do not.
EngineDifference difference_of(const LayeredImage& ours, const LayeredImage& theirs,
                               const std::string& basis) {
  const std::string layer = basis == "flat" ? "" : basis;
  const FloatImage &a = ours.find(layer)->pixels, &b = theirs.find(layer)->pixels;
  const FloatImage &here = ours.find("coverage")->pixels, &there = theirs.find("coverage")->pixels;
  EngineDifference result;
  double squares = 0;
  for (std::size_t i = 0; i < here.texels(); ++i) {
    EXPECT_EQ(here.data()[i], there.data()[i]);
    if (here.data()[i] < 1) continue;
    double difference = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      difference += (double(a.data()[3 * i + c]) - b.data()[3 * i + c]) / 3;
      result.level += double(b.data()[3 * i + c]) / 3;
    }
    result.mean += difference;
    squares += difference * difference;
    ++result.texels;
  }
  const auto n = double(result.texels);
  result.mean /= n;
  result.level /= n;
  result.standard_error = std::sqrt((squares / n - result.mean * result.mean) / n);
  return result;
}

TEST(EmbreeEngine, AgreesWithCyclesToNoise) {
  Workbench bench(RNMBAKE_BINARY, {});
  const auto blend = bench.build({"cornell", {}});
  const Words flags{"--resolution", "16", "--samples", "256", "--bounces", "8"};
  Words by_embree = flags;
  // The scatter of texels says too little of the noise of their mean where they share paths: ours gets small.
  by_embree.insert(by_embree.end(), {"--engine", "embree", "--samples", "4096"});
  const Baked cycles = bench.bake(blend, flags), embree = bench.bake(blend, by_embree);
  for (const char* object : {"floor", "ceiling", "left", "right", "back"}) {
    const LayeredImage ours = embree.lightmap(object), theirs = cycles.lightmap(object);
    EXPECT_EQ(read_metadata(ours, object).engine, "embree");
    EXPECT_EQ(read_metadata(theirs, object).engine, "cycles");
    for (const BasisDirection& basis : flat_and_rnm().directions) {
      const EngineDifference difference = difference_of(ours, theirs, basis.name);
      EXPECT_EQ(difference.texels, 256U);
      // Walls that meet take light from right beside them: the engines' ray offsets are not the same there.
      EXPECT_LE(std::abs(difference.mean), 4 * difference.standard_error + 0.003 * difference.level)
          << object << " " << basis.name << ": " << difference.mean << " of " << difference.level
          << ", standard error " << difference.standard_error;
    }
  }
}

TEST(EmbreeEngine, BakesAnExportedSceneWithoutBlender) {
  Workbench bench(RNMBAKE_BINARY, {});
  const auto blend = bench.build({"plane_lamp", {}});
  const Words flags{"--engine", "embree", "--resolution", "8", "--samples", "16", "--objects", "plane"};
  Words alone = flags;
  alone.insert(alone.end(), {"--blender", "/nowhere/blender"});
  const LayeredImage from_blend = bench.bake(blend, flags).lightmap("plane");
  const LayeredImage from_scene = bench.bake(bench.exported(blend), alone).lightmap("plane");
  for (const char* name : {"", "rnm0", "rnm1", "rnm2", "flat_stderr", "coverage"}) {
    ASSERT_NE(from_scene.find(name), nullptr) << name;
    EXPECT_EQ(from_scene.find(name)->pixels.data(), from_blend.find(name)->pixels.data()) << name;
  }
}

}  // namespace
}  // namespace rnmbake
