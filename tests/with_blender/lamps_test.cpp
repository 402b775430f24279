// Every kind of lamp: what the Blender at hand bakes on tiny quads against what Lights gives there.
#include "survey_session.h"
#include "trace/lights/lights.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;

/// E/pi on a plane that nothing shades: the mean over an even grid of samples, whose error is far below a
/// bake's.
Vec3d lit(const Lights& lights, const Vec3& point, const Vec3& normal) {
  constexpr int grid = 160;
  Vec3d sum(0, 0, 0);
  for (int i = 0; i < grid; ++i) {
    for (int j = 0; j < grid; ++j) {
      const Vec3 u(0.5F, (static_cast<float>(i) + 0.5F) / grid, (static_cast<float>(j) + 0.5F) / grid);
      const LightSample sample = lights.sample(point, normal, u);
      const float cosine = sample.direction.dot(normal);
      if (sample.pdf > 0 && cosine > 0) sum += Vec3d(sample.radiance) * (double(cosine) / sample.pdf);
    }
  }
  return sum / (pi * grid * grid);
}

Vec3 vector_of(const json& values) {
  return {values.at(0).get<float>(), values.at(1).get<float>(), values.at(2).get<float>()};
}

TEST(LampsWithBlender, EachGivesWhatABakeShows) {
  SurveySession session;
  session.build("lamp_cases.py", {session.file("lamps.blend").string(), session.file("lamps.json").string()});
  const SceneSurvey survey = session.survey(session.file("lamps.blend"));
  const json measured = json::parse(read_text(session.file("lamps.json")));
  const json& quads = measured.at("quads");
  ASSERT_EQ(measured.at("lamps").size(), survey.lights.size());
  for (const json& lamp : measured.at("lamps")) {
    const std::string name = lamp.at("name");
    const auto info = std::find_if(survey.lights.begin(), survey.lights.end(),
                                   [&](const LightInfo& light) { return light.name == name; });
    ASSERT_NE(info, survey.lights.end()) << name;
    EXPECT_TRUE(info->outside_model.empty()) << name;
    DiffuseScene scene;
    scene.survey.lights = {*info};
    const Triangles nothing;
    const Lights lights(scene, nothing, survey.blender_version);
    for (std::size_t q = 0; q < quads.size(); ++q) {
      const Vec3d ours = lit(lights, vector_of(quads[q][0]), vector_of(quads[q][1]).normalized());
      const json& seen = lamp.at("quads")[q];
      const double error = seen.at("error");
      for (int c = 0; c < 3; ++c) {
        const double theirs = seen.at("mean")[std::size_t(c)];
        // Where the two differ by rounding alone, a bake's own precision is what is left.
        const double allowed = std::max({3.5 * error, 0.003 * theirs, 1e-6});
        EXPECT_NEAR(ours[c], theirs, allowed) << name << ", quad " << q << ", standard error " << error;
      }
    }
  }
}

}  // namespace
}  // namespace rnmbake
