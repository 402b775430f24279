#include "scene/tangents.h"

#include "base/files.h"
#include "with_blender/survey_session.h"

#include <cmath>
#include <iostream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

/// Angles between our tangents and Blender's, in degrees.
struct Angles {
  double sum = 0, max = 0;
  std::size_t corners = 0, beyond = 0, other_sign = 0;
};

double degrees(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b)) * 180 / pi;
}

Angles compare(const SceneSurvey& survey, const SceneObject& object, const nlohmann::json& theirs) {
  const Mesh& mesh = survey.mesh_of(object);
  const std::vector<Vec2>& uv = mesh.uv_layers.at(static_cast<std::size_t>(mesh.active_uv)).uv;
  const TangentFrames frames = tangent_frames(mesh, uv, object.to_world);
  Angles angles;
  for (std::size_t corner = 0; corner < frames.corners.size(); ++corner) {
    const auto& tangent = theirs.at(mesh.triangle_loops[corner]);
    Vec3d expected;
    object.to_world.multDirMatrix(Vec3d(tangent.at(0), tangent.at(1), tangent.at(2)), expected);
    const double angle = degrees(Vec3d(frames.corners[corner].tangent), expected);
    angles.sum += angle;
    angles.max = std::max(angles.max, angle);
    angles.beyond += angle > 0.1 ? 1 : 0;
    angles.other_sign += frames.corners[corner].sign != tangent.at(3).get<float>() ? 1 : 0;
    ++angles.corners;
  }
  return angles;
}

/// Blender computes MikkTSpace with the reference code, in single precision.
TEST(TangentsWithBlender, AreThoseOfTheReferenceCode) {
  SurveySession session;
  session.build("tangent_cases.py", {session.file("t.blend").string(), session.file("t.json").string()});
  const SceneSurvey survey = session.survey(session.file("t.blend"));
  const auto theirs = nlohmann::json::parse(read_text(session.file("t.json")));
  ASSERT_EQ(survey.objects.size(), 5U);
  for (const SceneObject& object : survey.objects) {
    const Angles angles = compare(survey, object, theirs.at(object.name));
    std::cout << object.name << ": " << angles.corners << " corners, mean "
              << angles.sum / static_cast<double>(angles.corners) << ", max " << angles.max << " degrees, "
              << angles.beyond << " beyond 0.1, " << angles.other_sign << " of the other sign\n";
    EXPECT_EQ(angles.other_sign, 0U) << object.name;
    EXPECT_EQ(angles.beyond, 0U) << object.name;
    EXPECT_GT(angles.corners, 90U) << object.name;
  }
}

}  // namespace
}  // namespace rnmbake
