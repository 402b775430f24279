// rnmbake probes on scenes of scenes/probe_rooms.py: who is asked for, what is refused, what comes out.
#include "base/files.h"
#include "image/layered_exr.h"
#include "probes/volume_file.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using Words = std::vector<std::string>;

class ProbeCommandWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = std::make_unique<SurveySession>();
    session_->build("probe_rooms.py", {session_->file("").string()});
  }
  static void TearDownTestSuite() { session_.reset(); }

  static ProcessResult rnmbake(Words words) {
    ProcessOptions options;
    options.argv = {RNMBAKE_BINARY, "-q"};
    options.argv.insert(options.argv.end(), words.begin(), words.end());
    return run_process(options);
  }

  static std::string path(const std::string& name) { return session_->file(name).string(); }

  static StoredVolumes probes(const std::string& scene, Words flags) {
    Words words{"probes", path(scene), "-o", path("out"), "--samples", "64", "--check", "0"};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProcessResult result = rnmbake(words);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_volumes(path("out"));
  }

  /// The one line that it ends with.
  static void expect_refused(const std::string& scene, Words flags, int code, const std::string& says) {
    Words words{"probes", path(scene), "-o", path("refused")};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProcessResult result = rnmbake(words);
    EXPECT_EQ(result.exit_code, code) << result.output;
    EXPECT_NE(result.output.find(says), std::string::npos) << result.output;
    EXPECT_FALSE(std::filesystem::exists(path("refused") + "/probes.json"));
  }

  static std::unique_ptr<SurveySession> session_;
};

std::unique_ptr<SurveySession> ProbeCommandWithBlender::session_;

TEST_F(ProbeCommandWithBlender, TakesBlendersOwnVolume) {
  const StoredVolumes stored = probes("rooms.blend", {"--dynamic", "ball"});
  ASSERT_EQ(stored.volumes.size(), 1U);
  const ProbeVolume& volume = stored.volumes[0];
  EXPECT_EQ(volume.name, "light volume");
  EXPECT_EQ(volume.grid->counts, (std::array{8, 4, 3}));
  EXPECT_LT((volume.grid->place(0, 0, 0) - Vec3d(0.5, 0.5, 0.5)).length(), 1e-5);
  EXPECT_LT((volume.grid->place(7, 3, 2) - Vec3d(7.5, 3.5, 2.5)).length(), 1e-5);
  EXPECT_EQ(stored.about.at("dynamic"), nlohmann::json({"ball"}));
  // The lamp's room is bright, the other one gets what comes through the door.
  const auto flat = [&](int x) { return double(volume.probes[volume.grid->index(x, 0, 1)].irradiance[4].y); };
  EXPECT_GT(flat(1), 5 * flat(6));
  EXPECT_GT(flat(6), 0);
}

TEST_F(ProbeCommandWithBlender, PutsProbesAtEmptiesAndPoints) {
  const StoredVolumes at = probes("rooms.blend", {"--at", "spot*"});
  ASSERT_EQ(at.volumes.size(), 1U);
  ASSERT_EQ(at.volumes[0].probes.size(), 2U);
  EXPECT_FALSE(at.volumes[0].grid);
  EXPECT_EQ(at.volumes[0].probes[1].position, Vec3d(6, 1, 1));
  write_atomically(path("points.csv"), "x,y,z\n1,1,1\n6,1,1\n");
  const StoredVolumes listed = probes("rooms.blend", {"--points", path("points.csv")});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(listed.volumes[0].probes[i].irradiance, at.volumes[0].probes[i].irradiance);
}

TEST_F(ProbeCommandWithBlender, LeavesLampsToTheEngine) {
  const Words box{"--bounds", "0.5,0.5,0.5,3.5,3.5,2", "--spacing", "1"};
  const auto with = [&](const std::string& lights) {
    Words flags = box;
    flags.insert(flags.end(), {"--lights", lights});
    float sum = 0;
    for (const LightProbe& probe : probes("rooms.blend", flags).volumes[0].probes)
      sum += probe.irradiance[4].y;
    return sum;
  };
  const float all = with("all"), without_lamps = with("static"), bounced = with("indirect");
  EXPECT_GT(all, 1.2F * without_lamps);
  EXPECT_GT(without_lamps, 0);
  EXPECT_NEAR(bounced, without_lamps, 0.1 * double(bounced));  // nothing glows, and there is no sky
}

TEST_F(ProbeCommandWithBlender, CyclesAgrees) {
  Words words{"probes",      path("rooms.blend"), "-o",        path("cycles"), "--by",      "blender",
              "--materials", "lambert",           "--samples", "256",          "--dynamic", "ball"};
  const ProcessResult result = rnmbake(words);
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const nlohmann::json check = read_volumes(path("cycles")).about.at("check");
  const nlohmann::json& agreement = check.at("agreement");
  const double bias = agreement.at("bias").get<double>(), error = agreement.at("bias_error").get<double>();
  EXPECT_LT(error, 0.02 * check.at("mean").get<double>()) << "the test is too weak";
  // Cycles' lamps have the same share of rounding as in bakes: a thousandth (docs/accuracy.md).
  EXPECT_LT(std::abs(bias), 4.5 * error + 1e-3 * check.at("mean").get<double>());
}

TEST_F(ProbeCommandWithBlender, RefusesInOneLine) {
  expect_refused("empty.blend", {}, 3, "empty.blend");
  expect_refused("inside_out.blend", {"--spacing", "1"}, 3, "all 64 probes see the backs of faces");
  expect_refused("rooms.blend", {"--spacing", "0.0001"}, 3, "raise --spacing");
  expect_refused("rooms.blend", {"--at", "sport*"}, 1, "--at sport*");
  expect_refused("rooms.blend", {"--dynamic", "bal"}, 1, "did you mean 'ball'?");
  expect_refused("rooms.blend", {"--at", "spot*", "--spacing", "1"}, 1, "exclude each other");
}

TEST_F(ProbeCommandWithBlender, NeedsNoLightmapUvs) {
  EXPECT_EQ(probes("full.blend", {"--spacing", "2"}).volumes[0].probes.size(), 8U);
  const ProcessResult result = rnmbake(
      {"render", path("full.blend"), "--probes", path("out"), "-o", path("lit.exr"), "--resolution", "16x9"});
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST_F(ProbeCommandWithBlender, NeedsLightUnlessToldOtherwise) {
  expect_refused("dark.blend", {}, 3, "pass --allow-dark");
  const StoredVolumes black = probes("dark.blend", {"--spacing", "2", "--allow-dark"});
  EXPECT_EQ(black.volumes[0].probes[0].irradiance[0], Vec3(0));
}

TEST_F(ProbeCommandWithBlender, WarnsWhereProbesAreBlackOrInsideOfThings) {
  const auto said = [](const char* bounds, const char* spacing) {
    ProcessOptions options;
    options.argv = {RNMBAKE_BINARY, "probes", path("inside_out.blend")};
    for (const std::string& word :
         Words{"-o", path("turned"), "--bounds", bounds, "--spacing", spacing, "--samples", "16"})
      options.argv.push_back(word);
    const ProcessResult result = run_process(options);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return result.output;
  };
  constexpr auto most = "most probes see the backs of faces", none = "nothing was checked",
                 black = "all probes are black";
  const std::string four_fifths = said("-2,-2,-2,3,2,2", "1"), third = said("-2,-2,-2,10,2,2", "1");
  EXPECT_NE(four_fifths.find(most), std::string::npos) << four_fifths;
  EXPECT_EQ(third.find(most), std::string::npos) << third;
  EXPECT_EQ(third.find(none), std::string::npos) << third;
  // All probes move up through the roof, and between their places there is only the inside.
  const std::string roof = said("-1,-1,1.8,1,1,2.1", "0.3");
  EXPECT_NE(roof.find(none), std::string::npos) << roof;
  EXPECT_EQ(roof.find(black), std::string::npos) << roof;
  const std::string shadow = said("-1,-1,-4,1,1,-2.2", "1");  // the sun stands straight above
  EXPECT_NE(shadow.find(black), std::string::npos) << shadow;
}

/// The ball stands in what the probes left out; each way to light it comes with its error.
TEST_F(ProbeCommandWithBlender, LightsWhatMoves) {
  (void)probes("rooms.blend", {"--dynamic", "ball", "--samples", "256"});
  const ProcessResult result = rnmbake({"render", path("rooms.blend"), "--probes", path("out"), "--compare",
                                        "-o", path("report"), "--resolution", "96x54", "--samples", "64"});
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto report = nlohmann::json::parse(read_text(path("report") + "/report.json"));
  std::size_t pictures = 0;
  for (const auto& picture : report.at("views")[0].at("pictures")) {
    if (picture.at("label") == "truth") continue;
    ++pictures;
    EXPECT_GT(picture.at("relative_rmse").get<double>(), 0) << picture.at("label");
    EXPECT_LT(picture.at("relative_rmse").get<double>(), 1) << picture.at("label");
  }
  EXPECT_EQ(pictures, 7U);
}

/// Everything is lit by look-ups alone, spheres by their own probe: the picture has no noise.
TEST_F(ProbeCommandWithBlender, ShowsProbesAsSpheres) {
  (void)probes("rooms.blend", {"--dynamic", "ball"});
  const auto picture = [&](const std::string& name, const Words& flags) {
    Words words{"render",   path("rooms.blend"), "--probes", path("out"), "-o",
                path(name), "--resolution",      "96x54",    "--samples", "4"};
    words.insert(words.end(), flags.begin(), flags.end());
    const ProcessResult result = rnmbake(words);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return read_image(path(name)).find("albedo")->pixels;
  };
  const FloatImage with = picture("spheres.exr", {"--spheres"}), without = picture("plain.exr", {});
  std::size_t red = 0, differ = 0;
  for (int y = 0; y < with.height(); ++y) {
    for (int x = 0; x < with.width(); ++x) {
      const Vec3 colour = vec3_at(with, x, y);
      if (colour != vec3_at(without, x, y)) ++differ;
      if (colour.x > 0.5F && colour.y < 0.4F) ++red;  // filled ones
    }
  }
  EXPECT_GT(differ, 100U);
  EXPECT_EQ(red > 0,
            std::ranges::any_of(read_volumes(path("out")).volumes[0].probes, [](const LightProbe& probe) {
              return probe.state == LightProbe::State::filled;
            }));
}

}  // namespace
}  // namespace rnmbake
