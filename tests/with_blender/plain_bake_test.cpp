// A flat receiver bake against Blender's own plain bake of the same diffuse scene: two independent estimates
// of one irradiance, so they differ by noise alone.
#include "base/files.h"
#include "image/layered_exr.h"
#include "process/run.h"
#include "support/run_words.h"
#include "survey_session.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int side = 32, samples = 64, bounces = 8;

struct PlainBaked {
  std::string name;
  LayeredImage lightmap;
};

struct PlainDifference {
  std::size_t texels = 0;
  double mean = 0, plain_mean = 0, standard_error = 0;
};

/// Over the texels that both cover, mean of the three colours.
PlainDifference compare(const LayeredImage& lightmap, const std::string& plain_bytes) {
  const FloatImage& flat = lightmap.find("")->pixels;
  const FloatImage& coverage = lightmap.find("coverage")->pixels;
  std::vector<float> plain(plain_bytes.size() / sizeof(float));
  std::memcpy(plain.data(), plain_bytes.data(), plain_bytes.size());
  PlainDifference result;
  double squares = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float* texel = &plain[(std::size_t(side - 1 - y) * side + std::size_t(x)) * 4];
      if (coverage.texel(x, y)[0] < 1 || texel[3] < 0.5F) continue;
      double difference = 0, value = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        difference += (flat.texel(x, y)[c] - texel[c]) / 3.0;
        value += texel[c] / 3.0;
      }
      ++result.texels;
      result.mean += difference;
      result.plain_mean += value;
      squares += difference * difference;
    }
  }
  const auto n = static_cast<double>(std::max<std::size_t>(result.texels, 1));
  result.mean /= n;
  result.plain_mean /= n;
  result.standard_error = std::sqrt(std::max(squares / n - result.mean * result.mean, 0.0) / n);
  return result;
}

class PlainBakeWithBlender : public testing::Test {
 protected:
  [[nodiscard]] fs::path file(const std::string& name) const { return session_.file(name); }

  /// The scene with every material replaced by its albedo and emission: the model that both sides share.
  fs::path lambert(const fs::path& scene) {
    const LaunchOutcome outcome = session_.launch(scene, "lambert_entry.py");
    if (const auto* failure = std::get_if<LaunchFailure>(&outcome)) {
      ADD_FAILURE() << failure->message << failure->details;
      return {};
    }
    return session_.last_folder() / std::get<Finished>(outcome).result.at("blend").get<std::string>();
  }

  /// The objects with the most covered texels, by rnmbake; leaves the scene with its UVs beside them.
  std::vector<PlainBaked> bake(const fs::path& scene, std::size_t most) {
    const fs::path folder = file("baked");
    const ProcessResult result = run_words({RNMBAKE_BINARY,
                                            "bake",
                                            scene.string(),
                                            "-o",
                                            folder.string(),
                                            "--bases",
                                            "flat",
                                            "--samples",
                                            std::to_string(samples),
                                            "--bounces",
                                            std::to_string(bounces),
                                            "--resolution",
                                            std::to_string(side),
                                            "--unwrap",
                                            "always",
                                            "--dilate",
                                            "0",
                                            "--depth",
                                            "float",
                                            "--save-scene",
                                            "always"});
    EXPECT_TRUE(result.succeeded()) << result.output;
    if (!result.succeeded()) return {};
    json manifest = json::parse(read_text(folder / "manifest.json"));
    scene_with_uvs_ = folder / manifest["scene_with_uvs"].get<std::string>();
    json objects = manifest["objects"];
    std::stable_sort(objects.begin(), objects.end(), [](const json& a, const json& b) {
      return a["texels"]["covered"].get<int>() > b["texels"]["covered"].get<int>();
    });
    std::vector<PlainBaked> baked;
    for (const json& object : objects) {
      if (baked.size() == most) break;
      baked.push_back({object["object"], read_image(folder / object["files"][0].get<std::string>())});
    }
    return baked;
  }

  /// Every object's mean must agree within four standard errors of the paired difference, or 0.3 % where
  /// noise is less than that: jittered texels at chart edges see slightly other points.
  void agree(const fs::path& scene, std::size_t most) {
    const std::vector<PlainBaked> baked = bake(lambert(scene), most);
    ASSERT_FALSE(baked.empty());
    const fs::path folder = file("plain");
    fs::create_directory(folder);
    std::vector<std::string> argv{session_.info().executable.string(),
                                  "-b",
                                  "--factory-startup",
                                  "-noaudio",
                                  "--python-exit-code",
                                  "86",
                                  scene_with_uvs_.string(),
                                  "--python",
                                  RNMBAKE_SOURCE_DIR "/tests/with_blender/scenes/plain_bake.py",
                                  "--",
                                  folder.string(),
                                  std::to_string(side),
                                  std::to_string(samples),
                                  std::to_string(bounces)};
    for (const PlainBaked& one : baked) argv.push_back(one.name);
    const ProcessResult plain = run_words(std::move(argv));
    ASSERT_TRUE(plain.succeeded()) << plain.output;
    int compared = 0;
    for (std::size_t i = 0; i < baked.size(); ++i) {
      const PlainDifference difference =
          compare(baked[i].lightmap, read_text(folder / (std::to_string(i) + ".f32")));
      EXPECT_GT(difference.texels, 50U) << baked[i].name;
      if (difference.plain_mean == 0) continue;  // black: Blender divides by the albedo and returns nothing
      ++compared;
      const double allowed = std::max(4 * difference.standard_error, 0.003 * difference.plain_mean);
      EXPECT_LE(std::abs(difference.mean), allowed) << baked[i].name << ": plain " << difference.plain_mean
                                                    << ", receiver differs by " << difference.mean;
      std::printf("%-24s plain %.5f  receiver %+.5f  (standard error %.5f, %zu texels)\n",
                  baked[i].name.c_str(), difference.plain_mean, difference.mean, difference.standard_error,
                  difference.texels);
    }
  }

  void agree_on_shared(const std::string& name, std::size_t most) {
    const fs::path scene = fs::path(RNMBAKE_SOURCE_DIR) / "../shared/scenes" / name;
    if (!fs::exists(scene)) GTEST_SKIP() << "SKIPPED: no " << scene << " (scenes by others are not shipped)";
    agree(fs::canonical(scene), most);
  }

  SurveySession session_;
  fs::path scene_with_uvs_;
};

TEST_F(PlainBakeWithBlender, CornellAgreesWithBlendersOwnBake) {
  const fs::path scene = file("cornell.blend");
  const ProcessResult made = run_words(
      {session_.info().executable.string(), "-b", "--factory-startup", "-noaudio", "--python-exit-code", "86",
       "--python", RNMBAKE_SOURCE_DIR "/scenes/make.py", "--", "cornell", scene.string()});
  ASSERT_TRUE(made.succeeded()) << made.output;
  agree(scene, 8);
}

TEST_F(PlainBakeWithBlender, CornellBoxByOthersAgrees) {
  agree_on_shared("cornell_box/cornell_box.blend", 8);
}
TEST_F(PlainBakeWithBlender, Staircase2ByOthersAgrees) {
  agree_on_shared("staircase2/staircase2.blend", 12);
}
TEST_F(PlainBakeWithBlender, LivingRoomByOthersAgrees) {
  agree_on_shared("living_room/living_room.blend", 5);
}

}  // namespace
}  // namespace rnmbake
