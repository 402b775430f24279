#include "trace/lights/light_units.h"

#include "trace/lights/light_support.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

Lamp read_one(const LitScene& scene, const std::string& version) {
  const std::vector<Lamp> lamps = read_lamps(scene.diffuse_scene.survey, version);
  EXPECT_EQ(lamps.size(), 1U);
  return lamps.at(0);
}

/// E/pi straight below a lamp at height 2.
double below(const LitScene& scene, const std::string& version) {
  return irradiance(scene.lights(version), {0, 0, 0}, up, true, 4).mean / pi;
}

TEST(LightUnitsTest, AreasCountTheirPowerAnewSinceFour) {
  LitScene scene;
  LightInfo& lamp = scene.lamp("AREA", 12, {{"size", 2}, {"size_y", 3}});
  lamp.shape = "RECTANGLE";
  EXPECT_NEAR(read_one(scene, "3.4.1").radiance.x, 12.0 / (4 * 6), 1e-6);
  EXPECT_NEAR(read_one(scene, "3.6.0").radiance.x, 12.0 / (4 * 6), 1e-6);
  EXPECT_NEAR(read_one(scene, "4.0.0").radiance.x, 12.0 / (pi * 6), 1e-6);
  EXPECT_NEAR(read_one(scene, "5.2.2").radiance.x, 12.0 / (pi * 6), 1e-6);
  lamp.sizes["normalize"] = 0;
  EXPECT_NEAR(read_one(scene, "5.2.2").radiance.x, 12.0 / pi, 1e-5);
}

TEST(LightUnitsTest, PointsAreDisksSpheresOrNeither) {
  LitScene scene;
  LightInfo& lamp = scene.lamp("POINT", 40, {{"shadow_soft_size", 0.5}});
  lamp.to_world.translate(Vec3d(0, 0, 2));
  EXPECT_EQ(read_one(scene, "3.4.1").kind, Lamp::Kind::disk);
  EXPECT_EQ(read_one(scene, "4.0.0").kind, Lamp::Kind::sphere);
  EXPECT_NEAR(below(scene, "3.4.1"), 40 / (4 * pi * pi * 4.25), 1e-5);
  EXPECT_NEAR(below(scene, "4.0.0"), 40 / (4 * pi * pi * 4), 1e-5);
  lamp.sizes["use_soft_falloff"] = 1;
  EXPECT_NEAR(below(scene, "5.2.2"), 40 / (4 * pi * pi * 4.25), 1e-5);
  lamp.sizes["normalize"] = 0;  // per area of the sphere
  EXPECT_NEAR(below(scene, "5.2.2"), 4 * pi * 0.25 * 40 / (4 * pi * pi * 4.25), 1e-4);
  lamp.sizes["shadow_soft_size"] = 0;
  EXPECT_EQ(read_one(scene, "5.2.2").kind, Lamp::Kind::point);
}

/// (z - c) / ((1 - c) blend) smoothed, where z is the cosine off the axis; 3.4 multiplies by z once more.
TEST(LightUnitsTest, SpotsFadeOverTheirBlend) {
  const double c = std::cos(0.6), z = std::cos(0.5), t = (z - c) / ((1 - c) * 0.8),
               fade = t * t * (3 - 2 * t);
  for (const char* version : {"3.4.1", "5.2.2"}) {
    LitScene scene;
    LightInfo& lamp = scene.lamp("SPOT", 40, {{"spot_size", 1.2}, {"spot_blend", 0.8}});
    lamp.to_world.translate(Vec3d(0, 0, 2));
    lamp.to_world.rotate(Vec3d(0.5, 0, 0));
    const double expected = fade * (version[0] == '3' ? z : 1) * 40 / (4 * pi * pi * 4);
    EXPECT_NEAR(below(scene, version), expected, 1e-5 * expected) << version;
    lamp.to_world.rotate(Vec3d(0.2, 0, 0));
    EXPECT_EQ(below(scene, version), 0) << "outside its cone";
  }
}

TEST(LightUnitsTest, SunsCountTheirStrength) {
  LitScene scene;
  scene.lamp("SUN", 3, {{"angle", 0.3}});
  const double c = std::cos(0.15);
  EXPECT_NEAR(below(scene, "3.4.1"), 3 / pi * 2 * c / (1 + c), 1e-4);
  EXPECT_NEAR(below(scene, "4.3.2"), 3 / pi, 1e-4);
  scene.diffuse_scene.survey.lights[0].sizes["normalize"] = 0;
  EXPECT_NEAR(below(scene, "5.2.2"), 3 * std::sin(0.15) * std::sin(0.15), 1e-5);
}

TEST(LightUnitsTest, LampsWithoutPowerOrSizeGiveNothing) {
  LitScene scene;
  scene.lamp("POINT", 0);
  scene.lamp("AREA", 10, {{"size", 0}});
  scene.lamp("SUN", 3).color = {0, 0, 0};
  EXPECT_TRUE(read_lamps(scene.diffuse_scene.survey, "5.2.2").empty());
}

}  // namespace
}  // namespace rnmbake
