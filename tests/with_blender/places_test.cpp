// Where and how a receiver stands: light along its face, scenes far from the origin, small and large ones,
// faces that glow. Scenes: scenes/place_cases.py, scenes/glow_cases.py.
#include "image/layered_exr.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Places : public testing::Test {
 protected:
  fs::path build(const std::string& what) {
    const fs::path scene = session_.file(what + ".blend");
    session_.build("place_cases.py", {what, scene.string()});
    return scene;
  }
  fs::path run(const std::string& command, const fs::path& scene, const Words& more) {
    const fs::path out = session_.file(command);
    ProcessOptions options;
    options.argv = {RNMBAKE_BINARY, command, scene.string(), "-o", out.string(), "--bounces",    "0",
                    "--depth",      "float", "--dilate",     "0",  "--quiet",    "--save-scene", "never"};
    options.argv.insert(options.argv.end(), more.begin(), more.end());
    const ProcessResult result = run_process(options);
    if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}: {}", command, result.output);
    return out;
  }

  SurveySession session_;
};

/// Values of one colour, row 0 on top.
class Channel {
 public:
  Channel(const fs::path& file, const std::string& layer, std::size_t channel) {
    const FloatImage pixels = read_image(file).find(layer)->pixels;
    width_ = pixels.width();
    for (std::size_t i = 0; i < pixels.texels(); ++i)
      values_.push_back(double(pixels.data()[i * std::size_t(pixels.channels()) + channel]));
  }
  [[nodiscard]] double largest() const { return *std::ranges::max_element(values_); }
  [[nodiscard]] double mean() const { return mean(values_.size()); }
  /// Of the first rows.
  [[nodiscard]] double mean_of_rows(int rows) const { return mean(std::size_t(rows * width_)); }
  [[nodiscard]] double standard_error(std::size_t texels) const {
    double squares = 0;
    for (const double value : values_) squares += (value - mean()) * (value - mean());
    return std::sqrt(squares / double(values_.size() - 1) / double(texels));
  }
  [[nodiscard]] const std::vector<double>& values() const { return values_; }
  [[nodiscard]] int width() const { return width_; }

 private:
  [[nodiscard]] double mean(std::size_t count) const {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += values_[i];
    return sum / double(count);
  }
  std::vector<double> values_;
  int width_ = 0;
};

void expect_mean(const Channel& map, double expected, const std::string& what) {
  EXPECT_NEAR(map.mean(), expected, 4 * map.standard_error(map.values().size()) + 1e-3) << what;
}

constexpr double root2 = 1.41421356, root3 = 1.73205081;

/// rnm1 leans up and rnm2 down the wall. Red: a sun whose light falls straight down. Green: one as wide as
/// 0.02, half of it above an upright wall. Blue: a lamp in the plane of some walls.
void expect_grazed(const fs::path& maps) {
  const double tilts[] = {0, 1e-7, -1e-7, 1e-5, -1e-5, 1e-4, -1e-4, 1e-3, -1e-3, 1e-2, -1e-2};
  for (std::size_t i = 0; i < std::size(tilts); ++i) {
    const fs::path file = maps / ("wall" + std::to_string(i) + ".exr");
    const double tilt = tilts[i];
    SCOPED_TRACE("tilt " + std::to_string(tilt * 1e6) + "e-6");
    const Channel up(file, "rnm1", 0), down(file, "rnm2", 0);
    EXPECT_EQ(down.largest(), 0);
    if (tilt < 1e-6) {
      EXPECT_EQ(up.largest(), 0);
    } else {
      expect_mean(up, std::cos(tilt) / root2 + std::sin(tilt) / root3, "red");
    }
  }
  for (const char* wall : {"wall0", "strips", "turned", "grid"}) {
    const fs::path file = maps / (std::string(wall) + ".exr");
    SCOPED_TRACE(wall);
    EXPECT_EQ(Channel(file, "rnm1", 0).largest(), 0);
    const Channel half(file, "rnm1", 1);  // and 4/3 pi of the disk's radius over the wall, on average
    const double expected = 0.5 / root2 + 0.5 * 0.01 * 4 / (3 * pi) / root3;
    expect_mean(half, expected, "green");
    const auto row = std::size_t(half.width());
    EXPECT_NEAR(half.mean_of_rows(1), expected, 4 * half.standard_error(row) + 1e-3) << "under the rim";
    if (std::string(wall) == "turned") continue;
    for (const char* layer : {"", "rnm0", "rnm1", "rnm2"})
      EXPECT_EQ(Channel(file, layer, 2).largest(), 0) << "blue " << layer;
  }
  EXPECT_EQ(Channel(maps / "far.exr", "rnm1", 0).largest(), 0);
  EXPECT_EQ(Channel(maps / "shadowless.exr", "rnm1", 0).largest(), 0);
  const Channel box(maps / "box.exr", "rnm1", 0);  // its roof is a fifth of the map
  expect_mean(box, 0.2 / root3, "roof");
}

TEST_F(Places, LightAlongAFaceDoesNotReachIt) {
  const fs::path scene = build("grazing");
  expect_grazed(run("bake", scene, {"--samples", "64", "--resolution", "20"}));
  expect_grazed(run("reference", scene, {"--samples", "64", "--resolution", "20"}));
}

/// The same floor elsewhere: texels may differ by what moves over their borders when it shifts by `shift`
/// texels, of footprints of half a texel, and each by two of its samples, as the noise is another; so does
/// the mean, by four of its standard errors.
void expect_same(const Channel& map, const Channel& here, double shift, int samples,
                 const std::string& what) {
  double worst = 0, sum = 0, squares = 0;
  for (std::size_t i = 0; i < map.values().size(); ++i) {
    const double difference = map.values()[i] - here.values()[i];
    worst = std::max(worst, std::abs(difference));
    sum += difference;
    squares += difference * difference;
  }
  EXPECT_LE(worst, 2 * shift + 4.0 / samples) << what;
  EXPECT_LE(std::abs(sum), shift / 16 * double(map.values().size()) + 4 * std::sqrt(squares)) << what;
}

TEST_F(Places, AScenesPlaceAndSizeDoNotShow) {
  const fs::path scene = build("places");
  const fs::path maps = run("bake", scene, {"--samples", "16", "--resolution", "32"});
  for (const char* object : {"floor", "post"}) {
    for (const char* layer : {"", "rnm0", "rnm1", "rnm2"}) {
      const auto channel = [&](const std::string& place) {
        return Channel(maps / (std::string(object) + " " + place + ".exr"), layer, 0);
      };
      const Channel here = channel("here");
      const auto what = [&](const std::string& place) { return object + (" " + place + " ") + layer; };
      // Half a float step of 300, 1500 and 30000, and 8 of a receiver's height, over a texel of 1/16.
      expect_same(channel("km"), here, 0.01, 16, what("km"));
      expect_same(channel("5km"), here, 0.03, 16, what("5km"));
      expect_same(channel("tiny"), here, 1e-3, 16, what("tiny"));
      expect_same(channel("huge"), here, 1e-3, 16, what("huge"));
    }
  }
}

/// Green: strips whose first quarter glows, 2 strong, and what faces that part from one unit above. Red: a
/// sun.
TEST_F(Places, AGlowingFaceLightsOthersAndNotItself) {
  const fs::path scene = session_.file("glow.blend");
  session_.build("glow_cases.py", {scene.string()});
  const fs::path maps = run("bake", scene, {"--samples", "256", "--resolution", "16"});
  for (const std::string place : {"here", "turned", "km", "far"}) {
    const fs::path file = maps / ("strip " + place + ".exr");
    for (const char* layer : {"", "rnm0", "rnm1", "rnm2"})
      EXPECT_LE(Channel(file, layer, 1).largest(), 1e-8) << place << " " << layer;
    if (place == "here") expect_mean(Channel(file, "rnm2", 0), 1 / root3, "sun");
    if (place == "far") continue;  // floats are too coarse there for what is to face it
    const fs::path speck = maps / ("speck " + place + ".exr");
    expect_mean(Channel(speck, "", 1), 2 * 0.75227469 / pi, place + " flat");
    for (const char* layer : {"rnm0", "rnm1", "rnm2"})
      expect_mean(Channel(speck, layer, 1), 2 * 0.43432599 / pi, place + " " + layer);
  }
}

}  // namespace
}  // namespace rnmbake
