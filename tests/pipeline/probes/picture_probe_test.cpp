// Light probes out of pictures: axes of cube maps, and what ambient cubes make of them.
#include "pipeline/probes/picture_probe.h"

#include "base/error.h"
#include "base/files.h"
#include "image/layered_exr.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

class PictureProbe : public testing::Test {
 protected:
  std::filesystem::path picture(const std::string& name, int width, int height,
                                const std::function<Vec3(int, int)>& colour) {
    FloatImage pixels(width, height, 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) set_vec3(pixels, x, y, colour(x, y));
    LayeredImage image;
    image.layers.push_back({"", {"R", "G", "B"}, pixels});
    const auto file = folder_.path() / name;
    write_exr(file, image, Depth::full);
    return file;
  }

  /// Even faces of these greys.
  DistantLight cube_map(const std::array<float, 6>& greys) {
    std::vector<std::filesystem::path> files;
    for (std::size_t face = 0; face < 6; ++face)
      files.push_back(picture("face" + std::to_string(face) + ".exr", 16, 16,
                              [&](int, int) { return Vec3(greys[face]); }));
    return read_light(files);
  }

  TempFolder folder_;
};

TEST_F(PictureProbe, EvenLightIsEven) {
  const LightProbe probe = probe_of(cube_map({1, 1, 1, 1, 1, 1}));
  for (const Vec3& light : probe.irradiance) EXPECT_NEAR(light.x, 1, 5e-3);  // of 16 x 16 texels
  EXPECT_NEAR(probe.harmonics[0].x, std::sqrt(4 * pi), 1e-4);
  EXPECT_NEAR(probe.harmonics[1].x, 0, 1e-5);
}

/// Faces of a cube map whose y points up: +y is Blender's z, +z is Blender's -y.
TEST_F(PictureProbe, FacesAreOnTheirSides) {
  const std::array<std::size_t, 6> side_of_face{0, 1, 4, 5, 3, 2};
  for (std::size_t face = 0; face < 6; ++face) {
    std::array<float, 6> greys{};
    greys[face] = 1;
    const PictureCubes cubes = cubes_of(cube_map(greys));
    for (std::size_t side = 0; side < 6; ++side) {
      const bool is_bright = side == side_of_face[face];
      EXPECT_NEAR(cubes.faces[side].x, is_bright ? 1 : 0, 2e-3) << face << side;
      // A face seen square on gives F = 4 / pi (1 / sqrt 2) atan(1 / sqrt 2) = 0.554 of its radiance (half
      // size 1 at distance 1: 1.74083950 / pi).
      if (!is_bright) continue;
      EXPECT_NEAR(cubes.exact[side].x, 1.74083950 / pi, 2e-3) << face;
    }
  }
}

/// A place within a face: the picture's first row is up on the side faces.
TEST_F(PictureProbe, RowsAndColumnsOfFaces) {
  std::vector<std::filesystem::path> files;
  for (std::size_t face = 0; face < 6; ++face) {
    files.push_back(picture("face" + std::to_string(face) + ".exr", 16, 16, [&](int x, int y) {
      return Vec3(face == 4 && y < 4 ? 1.0F : 0.0F, face == 4 && x < 4 ? 1.0F : 0.0F, 0);
    }));
  }
  Vec3 red(0), green(0);
  const DistantLight light = read_light(files);
  for (std::size_t i = 0; i < light.directions.size(); ++i) {
    red += light.directions[i] * light.powers[i].x;
    green += light.directions[i] * light.powers[i].y;
  }
  EXPECT_GT(red.z, 0);  // up
  EXPECT_NEAR(red.x, 0, 1e-5);
  EXPECT_LT(red.y, 0);    // the face +z of a cube map is Blender's -y
  EXPECT_LT(green.x, 0);  // its left is -x
  EXPECT_NEAR(green.z, 0, 1e-5);
}

/// Facts of a sky over the upper half: E is pi above, pi / 2 at the sides, 0 below. Face means are right
/// there by symmetry; of a small sun they are not: straight above it covers a texel of 1 / 4 sr or so of one
/// face.
TEST_F(PictureProbe, HemisphereAndSun) {
  const auto sky = picture("sky.exr", 128, 64, [](int, int y) { return Vec3(y < 32 ? 1.0F : 0.0F); });
  const PictureCubes cubes = cubes_of(read_light({sky}));
  const double truth[] = {pi / 2, pi / 2, pi / 2, pi / 2, pi, 0};
  for (std::size_t side = 0; side < 6; ++side) EXPECT_NEAR(cubes.exact[side].x * pi, truth[side], 2e-3);
  DistantLight sun;
  sun.add(Vec3(0, 0, 1), Vec3(1));
  EXPECT_NEAR(cubes_of(sun).exact[4].x, 1, 1e-6);
  EXPECT_NEAR(cubes_of(sun).faces[4].x, pi / 4, 1e-6);  // radiance x solid angle over the face's area
}

TEST_F(PictureProbe, RefusesOtherShapes) {
  const auto wide = picture("wide.exr", 16, 8, [](int, int) { return Vec3(1); });
  const auto square = picture("square.exr", 8, 8, [](int, int) { return Vec3(1); });
  const auto other = picture("other.exr", 4, 4, [](int, int) { return Vec3(1); });
  const auto nan = picture("nan.exr", 8, 8, [](int x, int) { return Vec3(x == 3 ? std::nanf("") : 1.0F); });
  EXPECT_NO_THROW((void)read_light({wide}));
  EXPECT_THROW((void)read_light({square}), Error);
  EXPECT_THROW((void)read_light({square, square}), Error);
  EXPECT_THROW((void)read_light({square, square, square, square, square, other}), Error);
  EXPECT_THROW((void)read_light({square, square, square, square, square, wide}), Error);
  EXPECT_THROW((void)read_light({square, square, square, square, square, nan}), Error);
  EXPECT_NO_THROW((void)read_light({square, square, square, square, square, square}));
}

}  // namespace
}  // namespace rnmbake
