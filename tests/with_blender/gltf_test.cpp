// glTF as it is meant (scenes/gltf_cases.py), baked against closed forms.
#include "base/files.h"
#include "blender/find.h"
#include "blender/probe.h"
#include "image/layered_exr.h"
#include "process/run.h"
#include "support/pictures.h"
#include "support/run_words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

class GltfWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    const ProcessResult built = run_words(
        {"python3", RNMBAKE_SOURCE_DIR "/tests/with_blender/scenes/gltf_cases.py", folder_->path().string()});
    ASSERT_TRUE(built.succeeded()) << built.output;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  /// The plain lightmaps of all but `exclude`, without bounces.
  static ProcessResult bake(const std::string& scene, const std::string& samples,
                            const std::string& exclude) {
    Words argv{RNMBAKE_BINARY, "bake", (folder_->path() / scene).string(), "-o", out(scene).string()};
    for (const std::string& word :
         {std::string("--blender"), find_blender().string(), std::string("--uv"), std::string("UVMap"),
          std::string("--samples"), samples, std::string("--exclude"), exclude})
      argv.push_back(word);
    for (const char* word :
         {"--resolution", "4", "--bounces", "0", "--bases", "flat", "--depth", "float", "--dilate", "0"})
      argv.emplace_back(word);
    return run_words(std::move(argv));
  }
  static fs::path out(const std::string& scene) { return folder_->path() / (scene + ".out"); }
  static json manifest(const std::string& scene) {
    return json::parse(read_text(out(scene) / "manifest.json"));
  }

  static std::unique_ptr<TempFolder> folder_;
};

std::unique_ptr<TempFolder> GltfWithBlender::folder_;

constexpr double lumens_per_watt = 683;

/// E/pi of a lamp of 100 cd that hangs `height` above a plane, `beside` away from the point below it.
double bulb(double height = 1, double beside = 0) {
  return 100 / lumens_per_watt / std::numbers::pi * height / std::pow(height * height + beside * beside, 1.5);
}

/// Cycles before 3.5 dims spots by the cosine of the angle to their axis.
bool is_old_spot() {
  return probe_version(find_blender()).version < BlenderVersion{3, 5, 0};
}

/// Cycles' falloff from the cone's edge (0) to where it is full (1).
double smoothstep(double share) {
  return share * share * (3 - 2 * share);
}

constexpr double other_cells = 1e-7;  // what reaches a floor from lamps 200 m away, grazing, is less

/// The floors of a bake, held against their values.
class Floors {
 public:
  Floors(const fs::path& folder, const json& manifest) {
    for (const json& object : manifest["objects"]) {
      EXPECT_EQ(object["status"], "baked") << object;
      if (object["status"] != "baked") continue;
      const LayeredImage lightmap = read_image(folder / object["files"][0].get<std::string>());
      means_[object["key"]] = covered_means(lightmap.find("")->pixels, lightmap.find("coverage")->pixels);
    }
  }
  [[nodiscard]] std::size_t count() const { return means_.size(); }

  /// `share`: of the value, may it be off beside its noise.
  void expect(const std::string& key, const std::array<double, 3>& wanted, double share) const {
    const auto found = means_.find(key);
    ASSERT_TRUE(found != means_.end()) << key;
    for (std::size_t c = 0; c < 3; ++c) {
      const double noise = 4.5 * found->second.error[c];  // one false alarm in 10,000 runs of all
      EXPECT_NEAR(found->second.value[c], wanted[c], noise + share * wanted[c] + other_cells)
          << key << " " << c;
    }
  }
  void expect(const std::string& key, double wanted, double share) const {
    expect(key, {wanted, wanted, wanted}, share);
  }

 private:
  std::map<std::string, ColourMeans> means_;
};

TEST_F(GltfWithBlender, MeansUnderASunWhatItSays) {
  const ProcessResult baked = bake("sunlit.glb", "16", "panel*,moving*,quantized*,strip*");
  ASSERT_TRUE(baked.succeeded()) << baked.output;
  const json said = manifest("sunlit.glb");
  const Floors floors(out("sunlit.glb"), said);
  const double sun = 1000 / lumens_per_watt / std::numbers::pi;  // one light without a size: no noise
  for (const char* clear :
       {"sun", "mask below", "mask picture below", "mask corners below", "mask with a factor", "unlit",
        "no strip", "beside 0", "beside 1", "beside 2", "under a hidden node", "of this scene", "at rest"})
    floors.expect(clear, sun, 1e-5);
  for (const char* solid : {"mask above", "mask at its cutoff", "mask picture above", "mask corners above",
                            "opaque", "single-sided", "under 0", "under 1", "under 2", "under quantized"})
    floors.expect(solid, 0, 0);
  floors.expect("blend", 0.75 * sun, 1e-5);
  floors.expect("glass", {sun / 2, sun / 4, sun / 8}, 1e-5);
  EXPECT_EQ(floors.count(), 25U);

  const auto warnings = said["warnings"].get<Words>();
  for (const char* words : {"animations are not followed (1)", "it holds 2 scenes", "left out (2)",
                            "KHR_nobody_knows is not followed", "unlit (material 'unlit')",
                            "attributes of instances are not followed: _ID", "without a material"}) {
    EXPECT_TRUE(
        std::ranges::any_of(warnings, [&](const std::string& line) { return line.find(words) != line.npos; }))
        << words << "\nin " << said["warnings"].dump(1);
    EXPECT_NE(baked.output.find(words), std::string::npos) << words;
  }
  EXPECT_EQ(warnings.size(), 7U) << said["warnings"].dump(1);
}

TEST_F(GltfWithBlender, MeansOfLampsAndGlowWhatItSays) {
  const ProcessResult baked = bake("lit.glb", "4096", "box*");
  ASSERT_TRUE(baked.succeeded()) << baked.output;
  const Floors floors(out("lit.glb"), manifest("lit.glb"));
  // Floors are 2 cm wide: their means are off the value in the middle by at most 1.5 (r / h)^2, r^2 = 2e-4
  // / 3. Receivers lie off them by a millionth of the distance to the origin, 1.2 mm for the last lamp: 2 x /
  // h more.
  constexpr double near = 5e-3, far = 2.6e-3;
  floors.expect("point", bulb(0.2), near);
  floors.expect("no intensity", bulb(0.2) / 100, near);
  floors.expect("coloured", {bulb(), bulb() / 2, bulb() / 4}, far);
  const auto dimmed = [](double angle) { return is_old_spot() ? std::cos(angle) : 1.0; };
  floors.expect("in the cone", dimmed(0.25) * bulb(1, std::tan(0.25)), far);
  const double share = (std::cos(0.36) - std::cos(0.5)) / (std::cos(0.3) - std::cos(0.5));
  floors.expect("on its edge", dimmed(0.36) * smoothstep(share) * bulb(1, std::tan(0.36)), 5e-3);
  floors.expect("beside the cone", 0, 0);
  floors.expect("inner cone alone", bulb(), far);
  floors.expect("no such lamp", 0, 0);
  floors.expect("glow", {1, 0.5, 0.25}, 1e-4);
  floors.expect("strong glow", {4, 2, 1}, 1e-4);
  floors.expect("glowing picture", {4, 0, 0}, 1e-4);
  floors.expect("placed picture", {4, 2, 1}, 1e-4);
  floors.expect("second UVs", {4, 2, 1}, 1e-4);
}

TEST_F(GltfWithBlender, IsValidatedWithItsOwnMaterials) {
  const ProcessResult validated = run_words(
      {RNMBAKE_BINARY, "validate", (folder_->path() / "glossy.glb").string(), "-o",
       out("glossy.glb").string(), "--blender", find_blender().string(), "--uv", "UVMap", "--resolution", "4",
       "--samples", "16", "--bases", "flat", "--decompose", "none", "--view", "0"});
  ASSERT_TRUE(validated.succeeded()) << validated.output;
  const fs::path own = out("glossy.glb") / "receiver-own-materials" / "1";
  const json baked = json::parse(read_text(own / "manifest.json"));
  EXPECT_EQ(baked["materials"], "full");
  EXPECT_EQ(baked["objects"].size(), 2U);
  const json report = json::parse(read_text(out("glossy.glb") / "report.json"));
  const std::string range = "lamp 'short': its range of 3 m is not followed";
  for (const json& lines : {baked["warnings"], report["notes"]})
    EXPECT_NE(lines.dump().find(range), std::string::npos) << lines.dump(1);
}

}  // namespace
}  // namespace rnmbake
