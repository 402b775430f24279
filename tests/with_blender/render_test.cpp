// rnmbake render on real scenes: the traced view is Cycles' own, and the report shows every picture.
#include "base/error.h"
#include "base/files.h"
#include "closed_forms/workbench.h"
#include "image/layered_exr.h"
#include "image/metrics.h"
#include "process/run.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

class Render : public testing::Test {
 protected:
  Render() : bench_(RNMBAKE_BINARY, {}) {}

  /// Exit code; what it says stays in said_.
  int rnmbake(Words words) {
    ProcessOptions options;
    options.argv = {RNMBAKE_BINARY};
    options.argv.insert(options.argv.end(), words.begin(), words.end());
    const ProcessResult result = run_process(options);
    said_ = result.output;
    return result.exit_code;
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  LayeredImage rendered(const fs::path& scene, const std::string& name, Words flags) {
    Words words{"render", scene.string(), "-o", path(name)};
    words.insert(words.end(), flags.begin(), flags.end());
    EXPECT_EQ(rnmbake(words), 0) << said_;
    return read_image(path(name));
  }

  TempFolder folder_;
  Workbench bench_;
  std::string said_;
};

// Two independent renders of each: the intervals then say what noise allows. A box of lambert surfaces has
// nothing that the tracer and Cycles could take differently, but for how both find an edge within a pixel.
TEST_F(Render, TruthIsWhatCyclesRenders) {
  const fs::path blend = bench_.build({"cornell", {}});
  const fs::path scene = bench_.exported(blend);
  const Words size{"--resolution", "48x48", "--samples", "256"};
  const auto picture = [&](const fs::path& file, const Words& how, const char* seed) {
    Words flags = size;
    flags.insert(flags.end(), how.begin(), how.end());
    flags.insert(flags.end(), {"--seed", seed});
    return rendered(file, how.back() + seed + ".exr", flags);
  };
  const LayeredImage truth[] = {picture(scene, {"--decode", "truth"}, "1"),
                                picture(scene, {"--decode", "truth"}, "2")};
  const LayeredImage cycles[] = {picture(blend, {"--with", "cycles"}, "1"),
                                 picture(blend, {"--with", "cycles"}, "2")};
  const FloatImage& covered = truth[0].find("coverage")->pixels;
  PictureComparison comparison;
  comparison.add({&cycles[0].layers[0].pixels, &cycles[1].layers[0].pixels, nullptr},
                 {&truth[0].find("")->pixels, &truth[1].find("")->pixels, nullptr}, {{&covered, 1}});
  const PictureMetrics metrics = comparison.metrics();
  EXPECT_GT(metrics.texels, 1000U);
  EXPECT_LE(metrics.relative_bias.low95, 0.002) << metrics.relative_bias.value;
  EXPECT_GE(metrics.relative_bias.high95, -0.002) << metrics.relative_bias.value;
  EXPECT_LE(metrics.relative_rmse.low95, 0.01) << metrics.relative_rmse.value;
}

TEST_F(Render, AComparisonShowsEveryPictureAndOrdersTheErrors) {
  const fs::path blend = bench_.build({"panels", {}});
  const std::string lightmaps = path("lightmaps");
  ASSERT_EQ(rnmbake({"reference", blend.string(), "-o", lightmaps, "--resolution", "32", "--samples", "32"}),
            0)
      << said_;
  const std::string converted = path("zh3");
  ASSERT_EQ(rnmbake({"convert", lightmaps, "--to", "zh3", "--range", "2", "--bits", "8", "-o", converted}), 0)
      << said_;
  ASSERT_EQ(rnmbake({"render", blend.string(), "--lightmaps", lightmaps, "--lightmaps", converted,
                     "--compare", "-o", path("report"), "--resolution", "64x40", "--samples", "64"}),
            0)
      << said_;
  const auto report = nlohmann::json::parse(read_text(folder_.path() / "report" / "report.json"));
  std::map<std::string, double> errors;
  std::map<std::string, int> bytes;
  for (const auto& picture : report.at("views").at(0).at("pictures")) {
    const auto label = picture.at("label").get<std::string>();
    errors[label] = picture.value("relative_rmse", 0.0);
    bytes[label] = picture.value("bytes", 0);
  }
  ASSERT_EQ(errors.size(), 7U);
  EXPECT_LT(errors.at("zh3 K=2, 8 bits"), errors.at("RNM, vrad"));
  EXPECT_EQ(bytes.at("zh3 K=2, 8 bits"), 6 + 9);
  EXPECT_EQ(bytes.at("RNM, vrad"), 18);
  EXPECT_EQ(bytes.at("Cycles"), 0);
  EXPECT_EQ(errors.at("truth"), 0);
  // What directional lightmaps are for.
  EXPECT_LT(errors.at("RNM, vrad"), errors.at("single lightmap"));
  EXPECT_LT(errors.at("Cycles"), errors.at("RNM, vrad"));
  for (const char* file :
       {"truth.exr", "cycles.exr", "single-lightmap.exr", "rnm-squared.exr", "rnm-linear.exr", "rnm-vrad.exr",
        "zh3-k-2-8-bits.exr", "report.html", "report.csv"})
    EXPECT_TRUE(fs::exists(folder_.path() / "report" / file)) << file;
  // The second must be converted from the first.
  EXPECT_EQ(rnmbake({"render", blend.string(), "--lightmaps", lightmaps, "--lightmaps", lightmaps,
                     "--compare", "-o", path("twice"), "--resolution", "16x10", "--samples", "2"}),
            int(ExitCode::usage));
  EXPECT_NE(said_.find("was not converted"), std::string::npos) << said_;
}

/// A sun without a world lights a white plane that it shines on from 60 degrees above the horizon the same
/// way in both, as nothing bounces. Where this machine has no OpenGL, Blender says so and nothing is written.
TEST_F(Render, EeveeShowsTheLampsAsCyclesDoes) {
  const fs::path blend = bench_.build({"plane_sun", {}});
  const Words size{"--resolution", "32x32", "--samples", "32", "--camera", "fit"};
  const auto by = [&](const char* engine) {
    Words flags = size;
    flags.insert(flags.end(), {"--with", engine});
    return flags;
  };
  const LayeredImage cycles = rendered(blend, "cycles.exr", by("cycles")),
                     eevee = rendered(blend, "eevee.exr", by("eevee"));
  const float expected = cycles.layers.front().pixels.texel(16, 16)[1];
  EXPECT_GT(expected, 0.1F);
  // Cycles' 32 samples of a plane in full sun have no noise; Eevee's soft shadows are no part of it either.
  EXPECT_NEAR(eevee.layers.front().pixels.texel(16, 16)[1], expected, 0.01F * expected);
}

// The .blend itself lacks the UVs that the lightmaps were made for.
TEST_F(Render, TakesTheSceneWithTheNewUvs) {
  const fs::path blend = bench_.build({"plane_sun", {}});
  const std::string lightmaps = path("lightmaps");
  ASSERT_EQ(rnmbake({"reference", blend.string(), "-o", lightmaps, "--resolution", "16", "--samples", "1",
                     "--unwrap", "always"}),
            0)
      << said_;
  const Words flags{"--resolution", "16x9", "--samples", "4"};
  Words decoded = flags, traced = flags;
  decoded.insert(decoded.end(), {"--lightmaps", lightmaps, "--decode", "single"});
  traced.insert(traced.end(), {"--decode", "truth"});
  const LayeredImage lit = rendered(blend, "lit.exr", decoded);
  EXPECT_NE(said_.find(".lightmap-uvs.blend"), std::string::npos) << said_;
  const FloatImage& one = lit.find("")->pixels;
  const LayeredImage truth = rendered(blend, "truth.exr", traced);
  const FloatImage& other = truth.find("")->pixels;
  // One sun and one plane: no noise, only the rounding of 16-bit lightmaps.
  for (std::size_t i = 0; i < one.data().size(); ++i) EXPECT_NEAR(one.data()[i], other.data()[i], 2e-3);
}

TEST_F(Render, SaysWhatIsMissing) {
  const fs::path scene = bench_.exported(bench_.build({"plane_sun", {}}));
  const fs::path other = bench_.exported(bench_.build({"furnace", {}}));
  const std::string lightmaps = path("lightmaps");
  ASSERT_EQ(rnmbake({"reference", scene.string(), "-o", lightmaps, "--resolution", "8", "--samples", "1"}),
            0);
  EXPECT_EQ(rnmbake({"render", other.string(), "--lightmaps", lightmaps, "-o", path("a.exr")}), 3);
  EXPECT_NE(said_.find("no object in common"), std::string::npos) << said_;
  EXPECT_FALSE(fs::exists(path("a.exr")));
  EXPECT_EQ(rnmbake({"render", scene.string(), "--with", "cycles", "-o", path("a.exr")}), 1);
  EXPECT_NE(said_.find(".blend"), std::string::npos) << said_;
  EXPECT_EQ(rnmbake({"render", scene.string(), "--lightmaps", lightmaps, "-o", path("a.png"), "--exposure",
                     "1", "--resolution", "16x8"}),
            0)
      << said_;
  EXPECT_EQ(read_image(path("a.png")).layers.front().pixels.height(), 8);
}

}  // namespace
}  // namespace rnmbake
