#include "pipeline/study/encoding_study.h"

#include "base/error.h"
#include "base/files.h"
#include "encoding/random_light.h"
#include "image/layered_exr.h"
#include "lightmap/metadata.h"
#include "pipeline/study/study_lights.h"
#include "support/pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

std::map<std::string, EncodingErrors> by_label(const std::vector<EncodingErrors>& errors) {
  std::map<std::string, EncodingErrors> found;
  for (const EncodingErrors& one : errors) found[one.label] = one;
  return found;
}

const std::vector<Vec3>& tested_normals() {
  static const std::vector<Vec3> normals = [] {
    std::vector<Vec3> all;
    for (const Vec3d& normal : spread_over_hemisphere(64)) all.emplace_back(normal);
    return all;
  }();
  return normals;
}

/// E/pi = 1 + v.n is what SH-2 holds exactly, and a plain lightmap is off by v.n - v.z.
TEST(EncodingStudy, LinearLightIsExactInSh2AndKnownInFlat) {
  const Vec3 v(0.3F, -0.2F, 0.4F);
  const auto light = [&](const Vec3& n) { return Vec3(1 + v.dot(n)); };
  const BasisSet fed = flat_and_rnm();
  EncodingStudy study(fed, tested_normals());
  std::vector<Vec3> at_fed, at_normals;
  for (const BasisDirection& basis : fed.directions) at_fed.push_back(light(basis.direction));
  double squares = 0, sum = 0, count = 0;
  for (const Vec3& n : tested_normals()) {
    at_normals.push_back(light(n));
    if (n.z < std::cos(60 * pi / 180)) continue;
    const double error = double(v.z) - v.dot(n);
    squares += error * error;
    sum += error;
    ++count;
  }
  study.add(at_fed, at_normals);
  const auto errors = by_label(study.errors());
  constexpr double roundings = 64 * std::numeric_limits<float>::epsilon();
  for (std::size_t band = 0; band < tilt_limits.size(); ++band)
    EXPECT_LT(errors.at("sh2").rms[band], roundings);
  EXPECT_NEAR(errors.at("flat").rms[2], std::sqrt(squares / count) / 1.4, roundings);
  EXPECT_NEAR(errors.at("flat").bias[2], sum / count / 1.4, roundings);
  EXPECT_NEAR(errors.at("rnm").flat_bias, (1 + v.z / std::sqrt(3.0)) / 1.4 - 1, roundings);
}

/// The order that docs/encodings.md states holds for each of eight sets of random lights.
TEST(EncodingStudy, OrderOfEncodingsHoldsForEverySetOfLights) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const auto errors = by_label(study_random(50, seed).errors());
    for (const std::size_t band : {0U, 1U, 2U}) {
      EXPECT_GT(errors.at("flat").rms[band], errors.at("rnm-vrad").rms[band]) << seed;
      EXPECT_GT(errors.at("rnm-vrad").rms[band], errors.at("sh2").rms[band]) << seed;
      EXPECT_GT(errors.at("sh2").rms[band], errors.at("zh3").rms[band]) << seed;
    }
    EXPECT_GT(errors.at("sh2").rms[2], errors.at("geomerics").rms[2]) << seed;
  }
}

TEST(EncodingStudy, PartsAddUpToTheWhole) {
  const BasisSet fed = flat_and_rnm();
  std::mt19937 random(3);
  EncodingStudy whole(fed, tested_normals()), parts(fed, tested_normals());
  for (int i = 0; i < 6; ++i) {
    const Hemisphere light = random_hemisphere(random);
    std::vector<Vec3> at_normals;
    for (const Vec3& n : tested_normals()) at_normals.emplace_back(float(irradiance(light, Vec3d(n))));
    whole.add(bakes(light, fed), at_normals);
    EncodingStudy part = whole.another();
    part.add(bakes(light, fed), at_normals);
    parts.merge(part);
  }
  EXPECT_EQ(whole.lights(), parts.lights());
  const auto a = whole.errors(), b = parts.errors();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t band = 0; band < tilt_limits.size(); ++band)
      EXPECT_NEAR(a[i].rms[band], b[i].rms[band], 1e-12);
}

class StudyLightmaps : public testing::Test {
 protected:
  /// One texel row of each light, with a texel that is not covered.
  [[nodiscard]] std::filesystem::path written(bool with_tested) const {
    LightmapMetadata metadata;
    metadata.bases = flat_and_rnm().directions;
    if (with_tested) {
      for (std::size_t i = 0; i < tested_normals().size(); ++i)
        metadata.bases.push_back({"t" + std::to_string(i), tested_normals()[i]});
    }
    LayeredImage image;
    for (const BasisDirection& basis : metadata.bases) {
      FloatImage pixels(width, 70, 3);  // more than a band of rows
      for (int y = 0; y < 70; ++y) {
        for (int x = 0; x < width; ++x) {
          const float value = float(irradiance(lights_[std::size_t(x)], Vec3d(basis.direction)));
          std::ranges::fill(pixels.texel(x, y), x == width - 1 ? 1e6F : value);
        }
      }
      image.layers.push_back({basis.name == "flat" ? "" : basis.name, {"R", "G", "B"}, std::move(pixels)});
    }
    FloatImage coverage = filled(width, 70, 1, 1);
    for (int y = 0; y < 70; ++y) coverage.texel(width - 1, y)[0] = 0;
    image.layers.push_back({"coverage", {""}, std::move(coverage)});
    write_metadata(metadata, image);
    write_exr(folder_.path() / "lights.exr", image, Depth::full);
    return folder_.path() / "lights.exr";
  }

  static constexpr int width = 5;
  std::vector<Hemisphere> lights_ = [] {
    std::mt19937 random(11);
    std::vector<Hemisphere> lights;
    for (int i = 0; i < width; ++i) lights.push_back(random_hemisphere(random));
    return lights;
  }();
  TempFolder folder_;
};

TEST_F(StudyLightmaps, AgreesWithTheSameLightsByThemselves) {
  const EncodingStudy studied = study_lightmaps(written(true));
  EXPECT_EQ(studied.lights(), 70U * (width - 1));
  const BasisSet fed = flat_and_rnm();
  EncodingStudy direct(fed, tested_normals());
  for (int i = 0; i < width - 1; ++i) {
    const Hemisphere& light = lights_[std::size_t(i)];
    std::vector<Vec3> at_normals;
    for (const Vec3& n : tested_normals()) at_normals.emplace_back(float(irradiance(light, Vec3d(n))));
    direct.add(bakes(light, fed), at_normals);
  }
  const auto a = studied.errors(), b = direct.errors();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t band = 0; band < tilt_limits.size(); ++band)
      EXPECT_NEAR(a[i].rms[band], b[i].rms[band], 1e-6 * (1 + b[i].rms[band])) << a[i].label;
}

TEST_F(StudyLightmaps, WantsDirectionsToTestAt) {
  try {
    (void)study_lightmaps(written(false));
    FAIL() << "was studied";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unsupported);
    EXPECT_NE(std::string(error.what()).find("--basis"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace rnmbake
