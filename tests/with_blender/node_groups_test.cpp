// rnmbake shaders --engine blender: what Cycles makes of each group is what `rnmbake decode` makes of the
// same files. Rendered by scenes/node_group_views.py.
#include "pipeline/shaders/node_groups.h"

#include "encoding/codecs/make_codec.h"
#include "encoding/direction_sets.h"
#include "encoding/encodings.h"
#include "image/layered_exr.h"
#include "lightmap/metadata.h"
#include "sampling/splitmix64.h"
#include "with_blender/survey_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int size = 24;
constexpr double tolerance = 1e-4;

Vec3 tilted(SplitMix64& random, float least_z) {
  const float z = least_z + (1 - least_z) * float(random.next_double());
  const float azimuth = 2 * std::numbers::pi_v<float> * float(random.next_double()), r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

void run(const std::vector<std::string>& words) {
  ProcessOptions options;
  options.argv = {RNMBAKE_BINARY};
  options.argv.insert(options.argv.end(), words.begin(), words.end());
  const ProcessResult result = run_process(options);
  if (!result.succeeded()) fail(ExitCode::tasks_failed, "rnmbake {}: {}", words.front(), result.output);
}

/// Flat, the basis and what else the encodings are fitted to.
const BasisSet& directions() {
  static const BasisSet set = direction_set("sh3").value();
  return set;
}

/// Two suns over a sky for each colour and texel; the first texel is dark.
LayeredImage baked() {
  SplitMix64 random(3);
  LayeredImage image;
  for (const BasisDirection& basis : directions().directions)
    image.layers.push_back({exr_layer(basis.name), {"R", "G", "B"}, FloatImage(size, size, 3)});
  for (std::size_t i = 3; i < image.layers[0].pixels.data().size(); ++i) {
    const std::array<Vec3, 2> suns{tilted(random, 0), tilted(random, 0)};
    std::array<float, 3> strengths{};
    for (float& strength : strengths) strength = float(random.next_double());
    for (std::size_t layer = 0; layer < image.layers.size(); ++layer) {
      const Vec3 normal = directions().directions[layer].direction;
      float light = strengths[2] * (1 + normal.z) / 2;
      for (std::size_t sun = 0; sun < 2; ++sun)
        light += strengths[sun] * std::max(0.0F, normal.dot(suns[sun]));
      image.layers[layer].pixels.data()[i] = light;
    }
  }
  LightmapMetadata metadata;
  metadata.bases = directions().directions;
  metadata.object = "floor";
  write_metadata(metadata, image);
  return image;
}

/// Numbers at which a lobe's formula changes: a = 0, a below 0 or just above, v = 0, |v| beyond 2a. In the
/// last row.
void add_limits(LayeredImage& image) {
  constexpr std::array<std::array<float, 4>, 6> limits{{{0, 0.3F, 0.1F, 0.2F},
                                                        {-0.2F, 0.1F, 0.3F, 0.1F},
                                                        {0.7F, 0, 0, 0},
                                                        {0.4F, 0.9F, -0.3F, 0.2F},
                                                        {5e-3F, 3e-3F, 2e-3F, 4e-3F},
                                                        {0, 0, 0, 0}}};
  for (std::size_t i = 0; i < limits.size(); ++i) {
    for (std::size_t layer = 0; layer < 4; ++layer)
      std::ranges::fill(image.layers[layer].pixels.texel(int(i), size - 1), limits[i][layer]);
  }
}

/// A directionality below the least that the decode divides by.
void add_least_directionality(LayeredImage& image) {
  for (Layer& layer : image.layers)
    if (layer.name == "directionality") std::ranges::fill(layer.pixels.texel(0, size - 1), 5e-5F);
}

/// Of the whole sphere and of any length, as a map's colours 0 to 1.
LayeredImage normal_map() {
  SplitMix64 random(5);
  LayeredImage image;
  image.layers.push_back({"", {"R", "G", "B"}, FloatImage(size, size, 3)});
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vec3 normal = tilted(random, -1) * (0.5F + 0.5F * float(random.next_double()));
      std::ranges::copy(std::array{normal.x / 2 + 0.5F, normal.y / 2 + 0.5F, normal.z / 2 + 0.5F},
                        image.layers[0].pixels.texel(x, y).begin());
    }
  }
  return image;
}

/// Greatest difference, as a share of the value or of a hundredth of the greatest number that goes in.
double error_of(const FloatImage& got, const FloatImage& wanted, const FloatImage& inputs) {
  double worst = got.data().size() == wanted.data().size() ? 0 : INFINITY;
  for (std::size_t i = 0; worst < INFINITY && i < wanted.data().size(); ++i) {
    const double difference = std::abs(double(got.data()[i]) - wanted.data()[i]);
    const double measure = std::max<double>(std::abs(wanted.data()[i]), inputs.data()[i] / 100);
    if (std::isnan(difference)) return INFINITY;
    if (difference > 0) worst = std::max(worst, measure > 0 ? difference / measure : INFINITY);
  }
  return worst;
}

/// What is fed to a group beside the layers.
struct Normals {
  const char* name;
  bool has_map, flip;
};
constexpr Normals mapped{"mapped", true, false}, flipped{"flipped", true, true},
    unconnected{"unconnected", false, false};

/// The files of all groups, and Cycles' pictures of them, made once.
class NodeGroups : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    session_ = new SurveySession;
    write_exr(file("baked.exr"), baked(), Depth::full);
    write_exr(file("normals.exr"), normal_map(), Depth::full);
    run({"shaders", "--engine", "blender", "-o", file("nodes").string(), "-q"});
    json views = json::array();
    for (const std::string& name : codec_names()) {
      write_lightmap(name);
      for (const Normals& normals : {mapped, flipped, unconnected}) views.push_back(view(name, normals));
    }
    std::ofstream(file("views.json")) << views;
    session_->build("node_group_views.py",
                    {file("nodes/rnmbake_nodes.blend").string(), file("views.json").string()});
  }

  static void TearDownTestSuite() {
    delete session_;
    session_ = nullptr;
  }

  static fs::path file(const std::string& name) { return session_->file(name); }
  static fs::path lightmap(const std::string& name) { return file(name + ".exr"); }
  static fs::path picture(const std::string& name, const Normals& normals) {
    return file(name + "-" + normals.name + ".exr");
  }

  /// The bakes in that encoding, and its layers as files of their own, which image textures can read.
  static void write_lightmap(const std::string& name) {
    run({"convert", file("baked.exr").string(), "--to", name, "--depth", "float", "-o", file(name).string(),
         "-q"});
    LayeredImage image = read_image(file(name) / "baked.exr");
    if (image.find("l1x")) add_limits(image);
    add_least_directionality(image);
    write_exr(lightmap(name), image, Depth::full);
    for (const Layer& layer : image.layers) {
      LayeredImage alone;
      alone.layers.push_back({"", layer.channels, layer.pixels});
      write_exr(layer_file(name, layer.name), alone, Depth::full);
    }
  }

  static fs::path layer_file(const std::string& name, const std::string& layer) {
    return file(name + "-layer-" + (layer.empty() ? "flat" : layer) + ".exr");
  }

  static std::vector<std::string> layers_of(const std::string& name) {
    return make_codec({name}, directions())->layers();
  }

  static json view(const std::string& name, const Normals& normals) {
    json pictures = json::object();
    for (const std::string& layer : layers_of(name)) pictures[layer] = layer_file(name, layer).string();
    if (normals.has_map) pictures["Normal Map"] = file("normals.exr").string();
    return {{"group", "rnmbake " + name},
            {"pictures", pictures},
            {"flip_green", normals.flip ? 1 : 0},
            {"size", size},
            {"render", picture(name, normals).string()}};
  }

  static FloatImage decoded(const std::string& name, const Normals& normals) {
    const fs::path lit = file(name + "-decoded.exr");
    std::vector<std::string> words{"decode", lightmap(name).string(), "-o", lit.string(), "-q"};
    if (normals.has_map) {
      words.insert(words.end(), {"--normal", file("normals.exr").string()});
    } else {
      words.insert(words.end(), {"--normal-vector", "0,0,1"});
    }
    if (normals.flip) words.emplace_back("--flip-green");
    run(words);
    return read_image(lit).layers.at(0).pixels;
  }

  /// Of each value, the greatest number among the layers.
  static FloatImage inputs(const std::string& name) {
    FloatImage greatest(size, size, 3);
    for (const std::string& layer : layers_of(name)) {
      const FloatImage values = read_image(layer_file(name, layer)).layers.at(0).pixels;
      for (std::size_t i = 0; i < values.data().size(); ++i)
        greatest.data()[i] = std::max(greatest.data()[i], std::abs(values.data()[i]));
    }
    return greatest;
  }

  /// Of Cycles' picture from what decode makes of the same files.
  static double error(const std::string& name, const Normals& normals) {
    const FloatImage rendered = read_image(picture(name, normals)).layers.at(0).pixels;
    return error_of(rendered, decoded(name, normals), inputs(name));
  }

  inline static SurveySession* session_ = nullptr;
};

TEST_F(NodeGroups, ReturnWhatDecodeReturns) {
  for (const std::string& name : codec_names()) {
    const double error = NodeGroups::error(name, mapped);
    EXPECT_LE(error, tolerance) << name;
    RecordProperty(name, std::to_string(error));
  }
}

TEST_F(NodeGroups, FlipGreenIsDecodesOwn) {
  for (const std::string& name : codec_names()) {
    EXPECT_LE(error(name, flipped), tolerance) << name;
    const double by_flip = error_of(decoded(name, mapped), decoded(name, flipped), inputs(name));
    EXPECT_TRUE(name == "flat" ? by_flip == 0 : by_flip > 0.1) << name << ": " << by_flip;
  }
}

TEST_F(NodeGroups, TakeAFlatNormalWhereNoMapIsConnected) {
  for (const std::string& name : codec_names()) EXPECT_LE(error(name, unconnected), tolerance) << name;
}

}  // namespace
}  // namespace rnmbake
