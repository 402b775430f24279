#include "pipeline/study/probe.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/codecs/ambient_cube_fit.h"
#include "image/layered_exr.h"
#include "pipeline/study/study_lights.h"
#include "pipeline/study/study_spheres.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

constexpr int rows = 64;

/// A texel is taken for a source in its middle: of functions of order 2, the error of the sum is below the
/// square of its size, pi / rows.
constexpr double quadrature = (pi / rows) * (pi / rows);

FloatImage painted(const std::function<Vec3(const Vec3&)>& radiance, int height = rows) {
  FloatImage picture(2 * height, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < 2 * height; ++x) {
      const Vec3 colour = radiance(probe_direction(x, y, 2 * height, height));
      std::ranges::copy(std::array{colour.x, colour.y, colour.z}, picture.texel(x, y).begin());
    }
  }
  return picture;
}

std::map<std::string, ProbeErrors> by_label(const ProbeTable& table) {
  std::map<std::string, ProbeErrors> found;
  for (const ProbeErrors& one : table.errors) found[one.label] = one;
  return found;
}

TEST(Probe, RowsRunFromTheTopAndColumnsFromBehindTowardsTheRight) {
  const Vec3 top = probe_direction(0, 0, 2048, 1024), front = probe_direction(1024, 511, 2048, 1024),
             right = probe_direction(1536, 511, 2048, 1024);
  constexpr float texel = float(pi) / 1024;
  EXPECT_LT((top - Vec3(0, 0, 1)).length(), texel);
  EXPECT_LT((front - Vec3(1, 0, 0)).length(), texel);
  EXPECT_LT((right - Vec3(0, -1, 0)).length(), texel);
}

TEST(Probe, SourcesAddUpToTheSkyHoweverTheyAreSummed) {
  const FloatImage sky = painted([](const Vec3&) { return Vec3(1, 2, 3); }, 96);
  for (const int kept : {96, 64, 7}) {
    const DistantLight light = probe_light(sky, kept);
    EXPECT_EQ(light.directions.size(), std::size_t(2 * kept * kept));
    Vec3d sum(0);
    for (const Vec3& power : light.powers) sum += Vec3d(power);
    EXPECT_NEAR(sum.x, 4, 1e-5);  // 4 pi over pi; of floats, each rounded
    EXPECT_NEAR(sum.z, 12, 3e-5);
  }
}

TEST(Probe, SurfaceBlocksWhatIsBehindIt) {
  DistantLight light;
  light.add(Vec3(0, 0, 1), Vec3(1));
  light.add(Vec3(1, 0, 0), Vec3(2));
  const std::array normals{Vec3(0, 0, 1), Vec3(0.6F, 0, 0.8F)};
  const auto all = irradiance(light, Vec3(0), normals);
  EXPECT_FLOAT_EQ(all[0].x, 1);
  EXPECT_FLOAT_EQ(all[1].x, 0.8F + 2 * 0.6F);
  const auto above = irradiance(light, Vec3(-0.6F, 0, 0.8F), normals);
  EXPECT_FLOAT_EQ(above[1].x, 0.8F);
}

/// Each encoding holds an even sky; orthonormal coefficients in place of means are 2 / sqrt pi too bright.
TEST(Probe, EvenSkyIsExactInEveryEncodingButOneThatIsFedWrongly) {
  const ProbeTable table = study_probe_sphere(probe_light(painted([](const Vec3&) { return Vec3(1); })), 32);
  EXPECT_NEAR(table.mean, 1, quadrature);
  for (const ProbeErrors& one : table.errors) {
    const bool is_wrong = one.label == "geomerics, as Probulator feeds it";
    EXPECT_NEAR(one.bias, is_wrong ? 2 / std::sqrt(pi) - 1 : 0, 4 * quadrature) << one.label;
    EXPECT_NEAR(one.by_angle, std::abs(one.bias), 4 * quadrature) << one.label;
  }
}

/// L = 2 + D.z has E/pi = 2 + 2/3 n.z; of L = 1 + (3 z^2 - 1)/2 bands 0 and 2 survive: 1 + (3 z^2 - 1)/8.
TEST(Probe, HarmonicsAreExactForTheLightThatTheyHold) {
  const auto linear =
      by_label(study_probe_sphere(probe_light(painted([](const Vec3& d) { return Vec3(2 + d.z); })), 32));
  EXPECT_LT(linear.at("sh2").by_angle, 4 * quadrature);
  EXPECT_LT(linear.at("sh3").by_angle, 4 * quadrature);
  const auto quadratic = by_label(study_probe_sphere(
      probe_light(painted([](const Vec3& d) { return Vec3(1 + (3 * d.z * d.z - 1) / 2); })), 32));
  EXPECT_LT(quadratic.at("sh3").by_angle, 4 * quadrature);
  // The mean over the sphere of (3 z^2 - 1)^2 is 4/5.
  EXPECT_NEAR(quadratic.at("sh2").by_angle, std::sqrt(0.8) / 8, 4 * quadrature);
}

TEST(Probe, OtherPicturesAreRefusedByName) {
  const TempFolder folder;
  const auto refused = [&](const FloatImage& picture, const std::string& word) {
    const auto file = folder.path() / "probe.exr";
    LayeredImage image;
    std::vector<std::string> channels{"R", "G", "B"};
    channels.resize(std::size_t(picture.channels()));
    image.layers.push_back({"", channels, picture});
    write_exr(file, image, Depth::full);
    try {
      (void)read_probe(file);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("probe.exr"), std::string::npos) << error.what();
    }
  };
  refused(FloatImage(30, 30, 3), "twice as wide as high");
  refused(FloatImage(8, 4, 1), "no colours");
  FloatImage broken = painted([](const Vec3&) { return Vec3(1); }, 4);
  broken.texel(5, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  refused(broken, "texel 5, 2");
}

/// Under an even sky E/pi = (1 + n.z)/2 of every surface, which is linear. The surface's horizon cuts a ring
/// of texels, each by up to half.
TEST(StudyProbe, EvenSkyIsLinearForEverySurface) {
  const EncodingStudy study = study_probe(probe_light(painted([](const Vec3&) { return Vec3(1); })), 40, 1);
  EXPECT_EQ(study.lights(), 40U);
  constexpr double ring = pi / rows;
  for (const EncodingErrors& one : study.errors()) {
    if (one.label == "sh2" || one.label == "sh3" || one.label == "h6") {
      EXPECT_LT(one.rms[3], ring) << one.label;
    }
    if (one.label == "rnm") {
      EXPECT_NEAR(one.flat_bias, (1 + 1 / std::sqrt(3.0)) / 2 - 1, ring);
    }
  }
}

TEST(StudyProbe, IsTheSameForTheSameSeed) {
  const DistantLight light =
      probe_light(painted([](const Vec3& d) { return Vec3(1 + d.x, 1, 1 - d.y); }, 16));
  const auto errors = [&](std::uint64_t seed) {
    return study_json(study_probe(light, 70, seed).errors(), 70);
  };
  EXPECT_EQ(errors(4), errors(4));
  EXPECT_NE(errors(4), errors(5));
}

TEST(AmbientCubeFit, FindsTheCubeThatGaveTheValues) {
  AmbientCube cube;
  for (std::size_t side = 0; side < 6; ++side) cube[side] = Vec3(float(side), 6 - float(side), 0.5F);
  std::vector<Vec3> normals, values;
  std::vector<float> weights;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      normals.push_back(probe_direction(x, y, 16, 8));
      values.push_back(ambient_cube_decode(cube, normals.back()));
      weights.push_back(float(1 + x));
    }
  }
  for (const auto& found : {fit_ambient_cube(normals, values), fit_ambient_cube(normals, values, weights)})
    for (std::size_t side = 0; side < 6; ++side)
      EXPECT_LT((found[side] - cube[side]).length(), 1e-5F) << side;
}

TEST(AmbientCubeFit, SidesThatNoNormalFacesAreDark) {
  const std::array normals{Vec3(0, 0, 1), Vec3(0, 0.6F, 0.8F)};
  const std::array values{Vec3(2), Vec3(2 * 0.64F + 0.36F)};
  const AmbientCube cube = fit_ambient_cube(normals, values);
  EXPECT_NEAR(cube[4].x, 2, 1e-5F);
  EXPECT_NEAR(cube[2].x, 1, 1e-5F);
  for (const std::size_t side : {0U, 1U, 3U, 5U}) EXPECT_NEAR(cube[side].x, 0, 1e-6F);
}

TEST(StudySpheres, TruthComesFirstAndHarmonicsAreNearerThanOneColour) {
  const auto pictures = sphere_pictures(sky_and_lamps(), 32);
  ASSERT_EQ(pictures.front().label, "truth");
  EXPECT_EQ(pictures.front().rms, 0);
  std::map<std::string, double> rms;
  for (const SpherePicture& picture : pictures) {
    rms[picture.label] = picture.rms;
    EXPECT_EQ(picture.pixels.texel(0, 0)[0], 0) << picture.label;   // beside the sphere
    EXPECT_GT(picture.pixels.texel(10, 8)[1], 0) << picture.label;  // in the light of the bright lamp
  }
  EXPECT_GT(rms.at("flat"), rms.at("rnm-vrad"));
  EXPECT_GT(rms.at("rnm-vrad"), rms.at("sh2"));
  EXPECT_GT(rms.at("sh2"), rms.at("sh3"));
  EXPECT_TRUE(rms.contains("zh3 K=2, 8 bits, mono"));
  EXPECT_FALSE(rms.contains("zh3 K=4, 8 bits"));
}

}  // namespace
}  // namespace rnmbake
