// Meshes finer than their lightmap: most receiver triangles hold no texel's centre and are not sent to
// Blender (bake/texel_centres.h). Each texel must be lit as the triangle is that holds its centre.
// Scene: scenes/dense_cases.py.
#include "image/layered_exr.h"
#include "scene/uv_raster.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;

/// The sheet's triangles, which are flat-shaded: their normals are those of their receivers, exactly.
struct DenseSheet {
  std::vector<Vec2> uv;        // three each
  std::vector<Vec3d> normals;  // unit
  Vec3d to_sun;
};

DenseSheet dense_sheet(const SceneSurvey& survey) {
  DenseSheet sheet;
  const Mesh& mesh = survey.mesh_of(survey.objects.at(0));
  const std::vector<Vec2>& uv = mesh.uv_layers.at(0).uv;
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) sheet.uv.push_back(uv[mesh.triangle_loops[3 * t + k]]);
    sheet.normals.emplace_back(mesh.loop_normal[mesh.triangle_loops[3 * t]]);
  }
  const Mat44& sun = survey.lights.at(0).to_world;
  sheet.to_sun = Vec3d(sun[2][0], sun[2][1], sun[2][2]).normalized();
  return sheet;
}

LayeredImage bake_dense(const fs::path& scene, const fs::path& out, int side) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY,
                  "bake",
                  scene.string(),
                  "-o",
                  out.string(),
                  "--resolution",
                  std::to_string(side),
                  "--samples",
                  "1",
                  "--bounces",
                  "0",
                  "--depth",
                  "float",
                  "--dilate",
                  "0",
                  "--quiet",
                  "--save-scene",
                  "never"};
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}", result.output);
  return read_image(out / "sheet.exr");
}

TEST(DenseWithBlender, TexelsAreLitAsTheTrianglesThatHoldTheirCentres) {
  SurveySession session;
  const fs::path scene = session.file("dense.blend");
  session.build("dense_cases.py", {scene.string()});
  const DenseSheet sheet = dense_sheet(session.survey(scene));
  for (const int side : {16, 64, 152}) {
    const LayeredImage map = bake_dense(scene, session.file("maps" + std::to_string(side)), side);
    const UvRaster raster = rasterize(sheet.uv, side, side);
    const FloatImage& flat = map.find("")->pixels;
    const FloatImage& coverage = map.find("coverage")->pixels;
    ASSERT_EQ(flat.width(), side);
    std::size_t covered = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const std::int32_t owner = raster.at(x, y).triangle;
        EXPECT_EQ(coverage.texel(x, y)[0], owner >= 0 ? 1 : 0) << x << ", " << y << " of " << side;
        if (owner < 0) continue;
        ++covered;
        const double expected = std::max(0.0, sheet.normals[std::size_t(owner)].dot(sheet.to_sun));
        EXPECT_NEAR(flat.texel(x, y)[1], expected, 2e-4) << x << ", " << y << " of " << side;
      }
    }
    // A tenth of the sheet is missing.
    EXPECT_GT(covered, std::size_t(side * side) * 8 / 10);
    EXPECT_LT(covered, std::size_t(side * side));
  }
}

}  // namespace
}  // namespace rnmbake
