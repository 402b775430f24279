// rnmbake validate on a small scene: the report says what it must, and its parts add up.
#include "base/files.h"
#include "blender/find.h"
#include "process/run.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Ended {
  int exit_code = 0;
  std::string output;
};

class Validate : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    scene_ = folder_->path() / "cornell.blend";
    const std::string blender = find_blender().string();
    const Ended built =
        run({blender, "-b", "--factory-startup", "-noaudio", "--python-exit-code", "86", "--python",
             RNMBAKE_SOURCE_DIR "/scenes/make.py", "--", "cornell", scene_.string()});
    ASSERT_EQ(built.exit_code, 0) << built.output;
    validated_ = validate("report", {"--study", "split", "--objects", "floor,tall,ball", "--view", "64"});
    ASSERT_EQ(validated_.exit_code, 0) << validated_.output;
    report_ = json::parse(read_text(folder_->path() / "report" / "report.json"));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static Ended run(std::vector<std::string> argv) {
    ProcessOptions options;
    options.argv = std::move(argv);
    const ProcessResult result = run_process(options);
    return {result.exit_code, result.output};
  }

  static Ended validate(const std::string& name, const std::vector<std::string>& flags) {
    std::vector<std::string> argv{
        RNMBAKE_BINARY, "validate", scene_.string(), "-o", (folder_->path() / name).string(),
        "--resolution", "16",       "--samples",     "64"};
    argv.insert(argv.end(), flags.begin(), flags.end());
    return run(argv);
  }

  static const json& decomposition(const std::string& subject) {
    for (const json& one : report_.at("decompositions")) {
      if (one.at("subject") == subject) return one;
    }
    throw std::runtime_error("no decomposition of " + subject);
  }

  static std::unique_ptr<TempFolder> folder_;
  static fs::path scene_;
  static Ended validated_;
  static json report_;
};
std::unique_ptr<TempFolder> Validate::folder_;
fs::path Validate::scene_;
Ended Validate::validated_;
json Validate::report_;

TEST_F(Validate, ComparesEveryObjectInEveryBasis) {
  std::set<std::string> keys;
  for (const json& object : report_.at("objects")) {
    keys.insert(object.at("key").get<std::string>());
    ASSERT_EQ(object.at("bases").size(), 4U);
    for (const json& basis : object.at("bases")) EXPECT_GT(basis.at("texels").get<int>(), 100);
  }
  EXPECT_EQ(keys, (std::set<std::string>{"floor", "tall", "ball"}));
}

// Beyond four standard errors and 1 % something is wrong; the noise of 64 samples allows no less.
TEST_F(Validate, TheReceiverHasNoBias) {
  for (const json& object : report_.at("objects")) {
    for (const json& basis : object.at("bases")) {
      const json& bias = basis.at("relative_bias");
      const double value = bias.at("value"), error = (bias.at("high95").get<double>() - value) / 1.96;
      EXPECT_LE(std::abs(value), std::max(0.01, 4 * error)) << object.at("key") << " " << basis.at("basis");
    }
  }
}

TEST_F(Validate, ThePartsAddUp) {
  for (const char* subject : {"scene", "floor", "tall", "ball"}) {
    for (const json& basis : decomposition(subject).at("bases")) {
      double sum = 0;
      std::set<std::string> names;
      for (const json& row : basis.at("rows")) {
        sum += row.at("bias").at("value").get<double>();
        names.insert(row.at("name").get<std::string>());
      }
      EXPECT_NEAR(sum, basis.at("total").at("bias").at("value").get<double>(), 1e-5)
          << subject << " " << basis.at("basis");
      for (const char* name : {"bump shadowing", "self-reflection", "light from below", "noise", "residual"})
        EXPECT_TRUE(names.contains(name)) << name;
    }
  }
}

TEST_F(Validate, TheFlatBasisHasNoFaults) {
  for (const json& basis : decomposition("scene").at("bases")) {
    if (basis.at("basis") != "flat") continue;
    for (const json& row : basis.at("rows")) {
      const json& bias = row.at("relative_bias");
      EXPECT_LE(bias.at("low95").get<double>(), 0.005) << row.at("name");
      EXPECT_GE(bias.at("high95").get<double>(), -0.005) << row.at("name");
    }
  }
}

TEST_F(Validate, TheStudyCountsItsTargets) {
  const json& points = report_.at("study");
  ASSERT_GE(points.size(), 2U);
  EXPECT_EQ(points.at(0).at("name"), "whole");
  EXPECT_EQ(points.at(0).at("targets"), 3);
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_GT(points.at(i).at("targets").get<int>(), points.at(i - 1).at("targets").get<int>());
  for (const json& point : points) EXPECT_GT(point.at("seconds").get<double>(), 0);
}

TEST_F(Validate, ShowsTheCamerasView) {
  ASSERT_EQ(report_.at("views").size(), 1U);
  std::set<std::string> labels;
  for (const json& picture : report_.at("views").at(0).at("pictures"))
    labels.insert(picture.at("label").get<std::string>());
  for (const char* label : {"truth", "Cycles", "single lightmap", "RNM, squared"})
    EXPECT_TRUE(labels.contains(label)) << label;
}

TEST_F(Validate, KeepsEveryStepAndSaysHowToRepeatIt) {
  const fs::path dir = folder_->path() / "report";
  for (const char* name : {"receiver/1", "receiver/2", "flat-normal-map/1", "flat-normal-map/2", "reference",
                           "emulation/2-bump-shadowing"})
    EXPECT_TRUE(fs::exists(dir / name / "manifest.json")) << name;
  EXPECT_TRUE(fs::exists(dir / "report.html"));
  EXPECT_TRUE(fs::exists(dir / "flat-normal-map" / "report.html"));
  const std::string command = report_.at("command");
  EXPECT_NE(command.find("rnmbake validate"), std::string::npos);
  EXPECT_NE(command.find("--samples 64"), std::string::npos) << command;
  EXPECT_NE(command.find("--study split"), std::string::npos) << command;
  EXPECT_NE(report_.at("finding").get<std::string>().find("flat-normal-map: "), std::string::npos);
}

TEST_F(Validate, TakesApartOnlyTheObjectsAskedFor) {
  const Ended some =
      validate("some", {"--objects", "floor,tall", "--bases", "flat", "--view", "0", "--decompose", "floor"});
  EXPECT_EQ(some.exit_code, 0) << some.output;
  const json report = json::parse(read_text(folder_->path() / "some" / "report.json"));
  EXPECT_EQ(report.at("objects").size(), 2U);
  ASSERT_EQ(report.at("decompositions").size(), 2U);  // the scene's, the floor's
  EXPECT_EQ(report.at("decompositions").at(1).at("subject"), "floor");
  EXPECT_NE(report.at("command").get<std::string>().find("--decompose floor"), std::string::npos);

  const Ended none =
      validate("none", {"--objects", "floor", "--bases", "flat", "--view", "0", "--decompose", "none"});
  EXPECT_EQ(none.exit_code, 0) << none.output;
  EXPECT_TRUE(json::parse(read_text(folder_->path() / "none" / "report.json")).at("decompositions").empty());
  EXPECT_FALSE(fs::exists(folder_->path() / "none" / "flat-normal-map"));

  const Ended wrong = validate("wrong", {"--objects", "floor", "--decompose", "flor"});
  EXPECT_EQ(wrong.exit_code, 1) << wrong.output;
  EXPECT_NE(wrong.output.find("floor"), std::string::npos) << wrong.output;
}

TEST_F(Validate, AThresholdThatIsExceededIsExitCode7) {
  const Ended strict = validate(
      "strict", {"--objects", "floor", "--bases", "flat", "--view", "0", "--fail-above", "max=0.0001%"});
  EXPECT_EQ(strict.exit_code, 7) << strict.output;
  const json report = json::parse(read_text(folder_->path() / "strict" / "report.json"));
  EXPECT_EQ(report.at("thresholds").at("exceeded").at(0).at("object"), "floor");
}

TEST_F(Validate, AWrongLimitIsSaidBeforeTheWork) {
  const Ended wrong = validate("wrong_limit", {"--fail-above", "sharpness=2%"});
  EXPECT_EQ(wrong.exit_code, 1) << wrong.output;
  EXPECT_FALSE(fs::exists(folder_->path() / "wrong_limit"));
}

}  // namespace
}  // namespace rnmbake
