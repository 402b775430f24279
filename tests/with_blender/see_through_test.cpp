// Leaves and panes that let light through: the receiver's bake of the lambert scene against the reference.
// Scene: scenes/see_through_cases.py.
#include "image/layered_exr.h"
#include "with_blender/survey_session.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

fs::path run(const std::string& command, const fs::path& scene, const fs::path& out, const Words& more) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY, command,   scene.string(), "-o",       out.string(),
                  "--resolution", "12",      "--samples",    "2048",     "--bounces",
                  "64",           "--depth", "float",        "--dilate", "0",
                  "--save-scene", "never",   "--quiet"};
  options.argv.insert(options.argv.end(), more.begin(), more.end());
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "{}: {}", command, result.output);
  return out;
}

struct ChannelDifference {
  double mean = 0, standard_error = 0;
};

/// Over the texels that are numbers in both: about one of Cycles' samples in ten million is NaN here (3.4.1),
/// which the bake warns of and --repair mends.
ChannelDifference difference(const FloatImage& a, const FloatImage& b, std::size_t channel) {
  double sum = 0, squares = 0, count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const double d = a.texel(x, y)[channel] - b.texel(x, y)[channel];
      if (!std::isfinite(d)) continue;
      ++count;
      sum += d;
      squares += d * d;
    }
  }
  EXPECT_GE(count, 0.99 * double(a.texels())) << "texels that are no numbers";
  return {sum / count, std::sqrt(squares) / count};
}

/// Two bakes and two references of one object.
struct Four {
  LayeredImage bakes[2], truths[2];
};

void compare(const Four& of, const std::string& layer) {
  SCOPED_TRACE("layer '" + layer + "'");
  const FloatImage &a = of.bakes[0].find(layer)->pixels, &b = of.bakes[1].find(layer)->pixels;
  const FloatImage &t = of.truths[0].find(layer)->pixels, &u = of.truths[1].find(layer)->pixels;
  double mean = 0;
  for (const float value : t.data()) mean += double(value) / double(t.data().size());
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double error = (difference(a, t, channel).mean + difference(b, u, channel).mean) / 2;
    const double noise =
        std::hypot(difference(a, b, channel).standard_error, difference(t, u, channel).standard_error) / 2;
    EXPECT_LT(noise, 0.005 * mean) << "nothing is tested";
    EXPECT_LE(std::abs(error), 4 * noise + 0.002 * mean) << channel << ", mean " << mean;
  }
}

TEST(SeeThroughWithBlender, BakesAreWhatTheReferenceSays) {
  SurveySession session;
  const fs::path scene = session.file("scene.blend");
  session.build("see_through_cases.py", {scene.string()});
  const auto folder = [&](const char* command, const char* seed, Words more) {
    more.insert(more.end(), {"--seed", seed});
    return run(command, scene, session.file(command + std::string(seed)), more);
  };
  const fs::path bakes[] = {folder("bake", "1", {"--materials", "lambert"}),
                            folder("bake", "2", {"--materials", "lambert"})};
  const fs::path truths[] = {folder("reference", "3", {}), folder("reference", "4", {})};
  for (const char* object : {"floor", "wall", "leaf", "pane", "screen"}) {
    SCOPED_TRACE(object);
    Four four;
    for (std::size_t i = 0; i < 2; ++i) {
      four.bakes[i] = read_image(bakes[i] / (object + std::string(".exr")));
      four.truths[i] = read_image(truths[i] / (object + std::string(".exr")));
    }
    for (const char* layer : {"", "rnm0", "rnm1", "rnm2"}) compare(four, layer);
  }
}

}  // namespace
}  // namespace rnmbake
