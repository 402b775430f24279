// Leaves and panes that let light through: the receiver's bake of the lambert scene against the reference.
// Scene: scenes/see_through_cases.py.
#include "image/layered_exr.h"
#include "with_blender/survey_session.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

LayeredImage run(const std::string& command, const fs::path& scene, const fs::path& out,
                 const std::string& object, const Words& more) {
  ProcessOptions options;
  options.argv = {
      RNMBAKE_BINARY, command,  scene.string(), "-o",    out.string(), "--objects", object,
      "--resolution", "12",     "--depth",      "float", "--dilate",   "0",         "--save-scene",
      "never",        "--quiet"};
  options.argv.insert(options.argv.end(), more.begin(), more.end());
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}: {}", command, result.output);
  return read_image(out / (object + ".exr"));
}

LayeredImage bake(const fs::path& scene, const fs::path& out, const std::string& object,
                  const std::string& seed) {
  return run("bake", scene, out, object,
             {"--materials", "lambert", "--samples", "4096", "--bounces", "64", "--seed", seed});
}

struct Difference {
  double mean = 0, standard_error = 0;
};

Difference difference(const FloatImage& a, const FloatImage& b, std::size_t channel) {
  double sum = 0, squares = 0;
  const auto count = double(a.texels());
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double d = a.texel(x, y)[channel] - b.texel(x, y)[channel];
      sum += d;
      squares += d * d;
    }
  }
  return {sum / count, std::sqrt(squares) / count};
}

class SeeThroughWithBlender : public testing::TestWithParam<const char*> {};

TEST_P(SeeThroughWithBlender, BakesAreWhatTheReferenceSays) {
  SurveySession session;
  const fs::path scene = session.file("scene.blend");
  session.build("see_through_cases.py", {scene.string()});
  const LayeredImage one = bake(scene, session.file("one"), GetParam(), "1");
  const LayeredImage two = bake(scene, session.file("two"), GetParam(), "2");
  const LayeredImage truth =
      run("reference", scene, session.file("truth"), GetParam(), {"--samples", "4096"});
  for (const char* layer : {"", "rnm0", "rnm1", "rnm2"}) {
    ASSERT_NE(truth.find(layer), nullptr);
    const FloatImage &a = one.find(layer)->pixels, &b = two.find(layer)->pixels,
                     &t = truth.find(layer)->pixels;
    double mean = 0;
    for (const float value : t.data()) mean += double(value) / double(t.data().size());
    for (std::size_t channel = 0; channel < 3; ++channel) {
      // Of one bake minus the other: twice that of their mean. The reference has far less.
      const double noise = difference(a, b, channel).standard_error;
      const double error = (difference(a, t, channel).mean + difference(b, t, channel).mean) / 2;
      EXPECT_LT(noise, 0.003 * mean) << "nothing is tested";
      EXPECT_LE(std::abs(error), 2 * noise + 0.001 * mean) << layer << " " << channel << ", mean " << mean;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Objects, SeeThroughWithBlender, testing::Values("floor", "wall", "leaf", "pane"));

}  // namespace
}  // namespace rnmbake
