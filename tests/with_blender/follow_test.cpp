// What is easily dropped on the way from a scene to the tracer: Cycles' bake and the reference against the
// right value of each. Scenes: scenes/follow_cases.py.
#include "closed_forms/cases.h"
#include "support/pictures.h"
#include "with_blender/survey_session.h"

#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

const Words flags{"--resolution", "24", "--samples", "128", "--bases", "flat"};
const double panel = 1.74083950 / pi;  // a square of half size 1 and radiance 1, one unit above

ColourMeans mean_of(const LayeredImage& lightmap) {
  return covered_means(lightmap.find("")->pixels, lightmap.find("coverage")->pixels);
}

/// The floors are not quite points: the square of their size.
constexpr double finite_size = 1e-3;

void expect(const Baked& baked, const std::string& object, const Vec3& right) {
  const ColourMeans mean = mean_of(baked.lightmap(object));
  for (std::size_t channel = 0; channel < 3; ++channel)
    EXPECT_NEAR(mean.value[channel], right[int(channel)],
                4 * mean.error[channel] + finite_size * std::abs(right[int(channel)]))
        << object << " " << channel;
}

class Follow : public testing::Test {
 protected:
  Follow() { session_.build("follow_cases.py", {session_.file("").string()}); }
  Baked bake(const std::string& scene, Words more = {}) {
    return bench_.bake(session_.file(scene), with(more));
  }
  Baked reference(const std::string& scene) { return bench_.reference(session_.file(scene), flags); }

  static Words with(Words more) {
    more.insert(more.end(), flags.begin(), flags.end());
    return more;
  }
  SurveySession session_;
  Workbench bench_{RNMBAKE_BINARY, {}};
};

void expect_cells(const Baked& baked) {
  expect(baked, "fog", Vec3(1));
  expect(baked, "negative", Vec3(float(1 - panel / 2)));
  expect(baked, "ray", Vec3(float(panel)));
  expect(baked, "property", Vec3(float(panel / 4)));
  expect(baked, "portal", Vec3(1));
  expect(baked, "instance", Vec3(0.9F, 0.1F, 0.3F) * float(panel));
}

TEST_F(Follow, CellsAreWhatTheyMustBe) {
  const Baked own = bake("cells.blend"), lambert = bake("cells.blend", {"--materials", "lambert"}),
              traced = reference("cells.blend");
  for (const Baked* one : {&own, &lambert, &traced}) {
    SCOPED_TRACE(one == &own ? "own materials" : one == &lambert ? "lambert" : "reference");
    expect_cells(*one);
    // All that a lamp of two bounces gives to the walls of a closed room: 1 + r + r^2.
    const ColourMeans room = mean_of(one->lightmap("room"));
    EXPECT_LT(room.error[0], 0.05);  // one bounce more or less is 0.5 or more
    EXPECT_NEAR(room.value[0], 1 + 0.8 + 0.64, 4 * room.error[0]);
    for (const char* object : {"random", "random object"}) {
      const ColourMeans right = mean_of(own.lightmap(object)), mean = mean_of(one->lightmap(object));
      EXPECT_GT(right.value[0], 0.01) << object;
      EXPECT_NEAR(mean.value[0], right.value[0],
                  4 * std::hypot(mean.error[0], right.error[0]) + finite_size * right.value[0])
          << object;
    }
  }
}

TEST_F(Follow, ViewLayersWithoutEnvironmentAndBackgroundSets) {
  for (const auto& [scene, right] : {std::pair("nosky.blend", 1.0F), std::pair("sets.blend", 1.5F)}) {
    SCOPED_TRACE(scene);
    expect(bake(scene, {"--materials", "lambert"}), "floor", Vec3(right));
    expect(reference(scene), "floor", Vec3(right));
  }
}

/// A row of the decomposition of an object, relative to the reference: within four standard errors of
/// `right`.
void expect_row(const nlohmann::json& report, const std::string& subject, const std::string& name,
                double right) {
  for (const auto& decomposition : report.at("decompositions")) {
    for (const auto& row : decomposition.at("bases").at(0).at("rows")) {
      if (decomposition.at("subject") != subject || row.at("name") != name) continue;
      const auto& bias = row.at("relative_bias");
      const double value = bias.at("value"), error = (bias.at("high95").get<double>() - value) / 1.96;
      EXPECT_LT(error, 0.02) << name;
      EXPECT_NEAR(value, right, 4 * error) << name;
      return;
    }
  }
  ADD_FAILURE() << "no row " << name << " of " << subject;
}

TEST_F(Follow, ValidateNamesTheBounceLimitAndWhatIsNotFollowed) {
  const auto folder = session_.file("proof");
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY,
                  "validate",
                  session_.file("judged.blend").string(),
                  "-o",
                  folder.string(),
                  "--resolution",
                  "12",
                  "--samples",
                  "64",
                  "--bounces",
                  "8",
                  "--bases",
                  "flat",
                  "--decompose",
                  "room",
                  "--view",
                  "0",
                  "--quiet"};
  const ProcessResult result = run_process(options);
  ASSERT_TRUE(result.succeeded()) << result.output;
  const auto report = nlohmann::json::parse(read_text(folder / "report.json"));
  EXPECT_EQ(report.at("not_followed"), nlohmann::json({"light 'lamp': node tree"}));
  EXPECT_EQ(report.at("bounce_limit").at("bounces"), 8);
  const std::string finding = report.at("finding");
  EXPECT_NE(finding.find("not followed by the reference: light 'lamp': node tree"), std::string::npos)
      << finding;
  EXPECT_EQ(finding.find("have a bias"), std::string::npos) << finding;
  EXPECT_NE(finding.find("bounce limit of 8"), std::string::npos) << finding;
  // A furnace of albedo r has 1 - r^(n+1) of its light within n bounces.
  expect_row(report, "room", "bounce limit", -std::pow(0.9, 9));
  expect_row(report, "room", "residual", 0);
}

}  // namespace
}  // namespace rnmbake
