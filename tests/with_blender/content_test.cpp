// What real scenes are made of (scenes/content_cases.py), baked by both recipes in every way.
#include "base/files.h"
#include "blender/find.h"
#include "image/layered_exr.h"
#include "process/run.h"
#include "support/run_words.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

/// A finished bake: its folder and what its manifest says.
struct ContentBaked {
  fs::path folder;
  json manifest;

  [[nodiscard]] const json* find(const std::string& key) const {
    for (const json& entry : manifest["objects"]) {
      if (entry["key"] == key) return &entry;
    }
    return nullptr;
  }
  [[nodiscard]] LayeredImage lightmap(const std::string& key) const {
    return read_image(folder / find(key)->at("files")[0].get<std::string>());
  }
  /// The one layer of `--layout files` with this name.
  [[nodiscard]] FloatImage layer(const std::string& key, const std::string& name) const {
    for (const json& file : find(key)->at("files")) {
      const auto path = folder / file.get<std::string>();
      if (path.stem().extension() == "." + name) return read_image(path).layers.front().pixels;
    }
    return {};
  }
  [[nodiscard]] std::set<std::string> keys() const {
    std::set<std::string> all;
    for (const json& entry : manifest["objects"]) all.insert(entry["key"].get<std::string>());
    return all;
  }
};

class ContentWithBlender : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    const ProcessResult built =
        run_words({find_blender().string(), "-b", "--factory-startup", "-noaudio", "--python-exit-code", "86",
                   "--python", RNMBAKE_SOURCE_DIR "/tests/with_blender/scenes/content_cases.py", "--",
                   folder_->path().string()});
    ASSERT_TRUE(built.succeeded()) << built.output;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static ProcessResult bake_into(const fs::path& folder, const std::string& scene, const Words& flags) {
    Words argv{RNMBAKE_BINARY, "bake", (folder_->path() / scene).string(), "-o", folder.string(), "-v"};
    for (const char* word : {"--save-scene", "never", "--retries", "0"}) argv.emplace_back(word);
    argv.insert(argv.end(), flags.begin(), flags.end());
    return run_words(std::move(argv));
  }

  /// Bakes without an error; every lightmap covers something and holds finite values only.
  static ContentBaked bake(const std::string& name, const Words& flags,
                           const std::string& scene = "content.blend") {
    ContentBaked baked{folder_->path() / name, {}};
    const ProcessResult result = bake_into(baked.folder, scene, flags);
    EXPECT_TRUE(result.succeeded()) << result.output;
    if (!result.succeeded()) return baked;
    baked.manifest = json::parse(read_text(baked.folder / "manifest.json"));
    for (const json& entry : baked.manifest["objects"]) {
      EXPECT_EQ(entry["status"], "baked") << entry["key"];
      EXPECT_GT(entry["texels"]["covered"], 0) << entry["key"];
      EXPECT_EQ(entry["texels"]["non_finite"], 0) << entry["key"];
      for (const json& file : entry["files"])
        EXPECT_TRUE(fs::is_regular_file(baked.folder / file.get<std::string>())) << file;
    }
    return baked;
  }

  static Words both(const Words& common, const std::string& recipe) {
    Words flags{"--recipe", recipe};
    flags.insert(flags.end(), common.begin(), common.end());
    return flags;
  }

  static std::unique_ptr<TempFolder> folder_;
};

std::unique_ptr<TempFolder> ContentWithBlender::folder_;

constexpr const char* recipes[] = {"receiver", "flat-normal-map"};

/// Texels whose neighbours are all covered: both recipes see the same piece of the object there.
struct BorderDifference {
  double mean = 0, standard_error = 0;
  std::size_t texels = 0;
};

bool is_inside(const FloatImage& coverage, int x, int y) {
  if (x < 1 || y < 1 || x + 1 >= coverage.width() || y + 1 >= coverage.height()) return false;
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if (coverage.texel(u, v)[0] < 0.5F) return false;
    }
  }
  return true;
}

BorderDifference difference(const LayeredImage& a, const LayeredImage& b) {
  const FloatImage &first = a.find("")->pixels, &second = b.find("")->pixels;
  const FloatImage& coverage = a.find("coverage")->pixels;
  double sum = 0, squares = 0;
  BorderDifference result;
  for (int y = 0; y < coverage.height(); ++y) {
    for (int x = 0; x < coverage.width(); ++x) {
      if (!is_inside(coverage, x, y)) continue;
      const double d = double(first.texel(x, y)[1]) - second.texel(x, y)[1];
      sum += d;
      squares += d * d;
      ++result.texels;
    }
  }
  const auto n = double(result.texels);
  result.mean = sum / n;
  result.standard_error = std::sqrt(std::max(squares / n - result.mean * result.mean, 0.0) / n);
  return result;
}

TEST_F(ContentWithBlender, IsSelectedAsARenderShowsIt) {
  const ContentBaked baked = bake("selected", {"--resolution", "16", "--samples", "1", "--bases", "flat"});
  const std::set<std::string> keys = baked.keys();
  EXPECT_EQ(keys.size(), 35U);
  for (const char* key :
       {"collection_not_in_viewport", "not_in_viewport", "eye_closed", "edit_mode", "child", "linked_object",
        "instancer_1/part_1#0", "scatter", "scatter/scatter#3", "tube", "text"}) {
    EXPECT_TRUE(keys.count(key)) << key;
  }
  for (const char* key : {"not_in_render", "collection_not_in_render", "mesh_holder"})
    EXPECT_FALSE(keys.count(key)) << key;
}

TEST_F(ContentWithBlender, HasTheSameFlatLightmapByBothRecipes) {
  const Words flags{"--resolution", "32",   "--samples",  "512",   "--dilate",  "0",
                    "--bases",      "flat", "--dispatch", "scene", "--exclude", "array"};
  const ContentBaked receiver = bake("agree_receiver", both(flags, "receiver"));
  const ContentBaked published = bake("agree_published", both(flags, "flat-normal-map"));
  ASSERT_EQ(receiver.keys(), published.keys());
  for (const std::string& key : receiver.keys()) {
    const BorderDifference found = difference(receiver.lightmap(key), published.lightmap(key));
    ASSERT_GT(found.texels, 20U) << key;
    // Texels of one bake share their sampling pattern, so more than the standard error of independent ones.
    EXPECT_LE(std::abs(found.mean), 0.005) << key;
    EXPECT_LE(found.standard_error, 0.002) << key << ": too noisy to tell";
  }
}

TEST_F(ContentWithBlender, SplitsByMaterialAndLoosePart) {
  for (const char* recipe : recipes) {
    const Words small{"--resolution", "32", "--samples", "16", "--bases", "flat", "--dilate", "0"};
    Words flags = both(small, recipe);
    flags.insert(flags.end(), {"--objects", "two_slots_*,several_slots,text", "--split", "material"});
    const ContentBaked slots = bake(std::string("material_") + recipe, flags);
    EXPECT_EQ(slots.keys(), (std::set<std::string>{"several_slots/grey", "several_slots/red",
                                                   "several_slots/slot1", "text/slot0", "two_slots_1/grey",
                                                   "two_slots_1/red", "two_slots_2/grey", "two_slots_2/red"}))
        << recipe;
    flags = both(small, recipe);
    flags.insert(flags.end(), {"--objects", "pieces", "--split", "loose"});
    const ContentBaked parts = bake(std::string("loose_") + recipe, flags);
    ASSERT_EQ(parts.keys().size(), 3U) << recipe;
    for (const std::string& key : parts.keys())
      EXPECT_NEAR(parts.find(key)->at("coverage").get<double>(), 0.3, 0.03) << recipe << key;
  }
}

TEST_F(ContentWithBlender, IsThePartOfTheWholeWhenSplit) {
  for (const char* recipe : recipes) {
    Words flags{"--recipe", recipe, "--resolution", "32", "--samples", "64",
                "--bases",  "flat", "--dilate",     "0",  "--objects", "two_slots_1,pieces"};
    const ContentBaked whole = bake(std::string("whole_") + recipe, flags);
    flags.insert(flags.end(), {"--split", "material"});
    const ContentBaked split = bake(std::string("split_") + recipe, flags);
    for (const auto& [part, object] : std::map<std::string, std::string>{
             {"two_slots_1/red", "two_slots_1"}, {"two_slots_1/grey", "two_slots_1"}}) {
      const BorderDifference found = difference(split.lightmap(part), whole.lightmap(object));
      ASSERT_GT(found.texels, 20U) << part;
      EXPECT_LE(std::abs(found.mean), 4 * found.standard_error + 0.005) << recipe << part;
    }
  }
}

TEST_F(ContentWithBlender, IsDispatchedInEveryWay) {
  for (const char* recipe : recipes) {
    std::vector<ContentBaked> ways;
    for (const char* dispatch : {"basis", "object", "scene"}) {
      ways.push_back(bake(std::string(recipe) + dispatch,
                          {"--recipe", recipe, "--dispatch", dispatch, "--resolution", "32", "--samples",
                           "16", "--bases", "flat,rnm1", "--objects", "mirrored,tube", "--dilate", "0"}));
      EXPECT_EQ(ways.back().manifest["dispatch"], dispatch);
    }
    for (const char* key : {"mirrored", "tube"}) {
      for (const std::size_t other : {1U, 2U}) {
        const BorderDifference found = difference(ways[0].lightmap(key), ways[other].lightmap(key));
        ASSERT_GT(found.texels, 20U) << recipe << key;
        EXPECT_LE(std::abs(found.mean), 4 * found.standard_error + 0.005) << recipe << key;
      }
    }
  }
}

TEST_F(ContentWithBlender, HasAFileForEachBasisAndFrames) {
  for (const char* recipe : recipes) {
    const ContentBaked baked =
        bake(std::string("files_") + recipe,
             {"--recipe", recipe, "--layout", "files", "--frames", "--normalize", "flat", "--resolution",
              "16", "--samples", "4", "--objects", "child,scatter/*,text"});
    ASSERT_EQ(baked.keys().size(), 6U);
    for (const std::string& key : baked.keys()) {
      ASSERT_EQ(baked.find(key)->at("files").size(), 7U) << key;  // flat, rnm0-2, coverage, tangent, normal
      const FloatImage tangent = baked.layer(key, "tangent"), normal = baked.layer(key, "normal");
      const FloatImage coverage = baked.layer(key, "coverage");
      ASSERT_EQ(normal.texels(), 16U * 16U) << key;
      ASSERT_EQ(tangent.texels(), 16U * 16U) << key;
      for (int y = 0; y < coverage.height(); ++y) {
        for (int x = 0; x < coverage.width(); ++x) {
          if (!is_inside(coverage, x, y)) continue;
          const auto n = normal.texel(x, y);
          const auto t = tangent.texel(x, y);
          ASSERT_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 0.01) << key;
          ASSERT_NEAR(n[0] * t[0] + n[1] * t[1] + n[2] * t[2], 0, 0.01) << key;
        }
      }
    }
  }
}

TEST_F(ContentWithBlender, TakesBasesFromAFileAndSettingsByObject) {
  std::ofstream(folder_->path() / "basis.toml")
      << "[[basis]]\nname = \"up\"\ndirection = [0, 0, 1]\n"
         "[[basis]]\nname = \"tilted\"\ndirection = [0.6, 0, 0.8]\n";
  std::ofstream(folder_->path() / "project.toml")
      << "[scene]\nfile = \"content.blend\"\nobjects = [\"shared_*\", \"tube\"]\n"
         "[bake]\nresolution = 16\nsamples = 4\nbasis = \"basis.toml\"\n"
         "[[override]]\nobjects = \"shared_2\"\nresolution = 24\nsamples = 2\nflip_green = true\n";
  for (const char* recipe : recipes) {
    const ContentBaked baked = bake(std::string("basis_") + recipe, {"--recipe", recipe}, "project.toml");
    ASSERT_EQ(baked.keys(), (std::set<std::string>{"shared_1", "shared_2", "tube"}));
    EXPECT_EQ(baked.find("shared_1")->at("width"), 16);
    EXPECT_EQ(baked.find("shared_2")->at("width"), 24);
    EXPECT_EQ(baked.find("shared_2")->at("samples"), 2);
    for (const std::string& key : baked.keys())
      EXPECT_TRUE(baked.lightmap(key).find("tilted") != nullptr) << key;
  }
}

}  // namespace
}  // namespace rnmbake
