#include "base/error.h"
#include "scene/survey_parse.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

namespace rnmbake {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A survey of one triangle, as the script writes it, in a folder of its own; edit, write, read.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("rnmbake-survey-" + std::to_string(getpid()))) {
    fs::create_directories(path_);
    json mesh{{"name", "Mesh"}, {"vertices", 3}, {"loops", 3}, {"polygons", 1}, {"triangles", 1}};
    mesh["positions"] = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});
    mesh["loop_vertex"] = ints({0, 1, 2});
    mesh["loop_normal"] = floats({0, 0, 1, 0, 0, 1, 0, 0, 1});
    mesh["triangle_loops"] = ints({0, 1, 2});
    mesh["triangle_polygon"] = ints({0});
    mesh["polygon_start"] = ints({0});
    mesh["polygon_size"] = ints({3});
    mesh["polygon_slot"] = ints({-1});
    mesh["uv_layers"] = json::array({{{"name", "UVMap"}, {"offset", floats({0, 0, 1, 0, 0, 1})}}});
    mesh["active_uv"] = mesh["render_uv"] = 0;
    content = {{"format", 1},           {"byte_order", "little"},     {"scene_file", "a.blend"},
               {"scene_name", "Scene"}, {"blender_version", "3.4.1"}, {"data", "survey.bin"},
               {"meshes", {mesh}},      {"warnings", {"hm"}}};
    content["objects"] = json::array({object("Wall"), object("Säule/柱")});
    content["objects"][0]["matrix"] = {1, 0, 0, 5, 0, 2, 0, 6, 0, 0, 3, 7, 0, 0, 0, 1};
    content["materials"] = {
        {"red", {{"normal_mapped", true}, {"emissive", false}, {"outside_model", {"glossy"}}}}};
    content["lights"] = json::array({{{"name", "sun"},
                                      {"type", "SUN"},
                                      {"energy", 2.5},
                                      {"color", {1, 0.5, 0.25}},
                                      {"shape", ""},
                                      {"sizes", {{"angle", 0.01}}},
                                      {"matrix", identity()},
                                      {"outside_model", json::array()}}});
    content["world"] = {{"kind", "constant"}, {"strength", 0.5}, {"color", {1, 1, 1}}};
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] SceneSurvey read() {
    content["data_bytes"] = declared_bytes.value_or(data.size());
    std::ofstream(path_ / "survey.json") << content;
    std::ofstream(path_ / "survey.bin", std::ios::binary).write(data.data(), std::streamsize(data.size()));
    return read_survey(path_ / "survey.json");
  }

  [[nodiscard]] std::string refusal(ExitCode code) {
    try {
      (void)read();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    return "it was read";
  }

  json& mesh() { return content["meshes"][0]; }
  void put(const char* what, std::size_t index, float value) {
    std::memcpy(&data[mesh()[what].get<std::size_t>() + 4 * index], &value, 4);
  }
  void put(const char* what, std::size_t index, std::int32_t value) {
    std::memcpy(&data[mesh()[what].get<std::size_t>() + 4 * index], &value, 4);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

  json content;
  std::vector<char> data;
  std::optional<std::size_t> declared_bytes;

 private:
  static json identity() { return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }
  static json object(const std::string& key) {
    return {{"key", key},           {"name", key},       {"instancer", ""},
            {"type", "MESH"},       {"mesh", 0},         {"matrix", identity()},
            {"slots", {"red", ""}}, {"light_group", ""}, {"visible_to_camera", true}};
  }
  template <typename T>
  std::size_t append(const std::vector<T>& values) {
    const std::size_t offset = data.size();
    data.resize(offset + values.size() * sizeof(T));
    std::memcpy(&data[offset], values.data(), values.size() * sizeof(T));
    return offset;
  }
  std::size_t floats(const std::vector<float>& values) { return append(values); }
  std::size_t ints(const std::vector<std::int32_t>& values) { return append(values); }

  fs::path path_;
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(SceneSurvey, HoldsTheDigestSortedAndTheInputs) {
  Folder folder;
  EXPECT_TRUE(folder.read().digest.empty());  // a scene for the tracer
  folder.content["digest"] = {{{"what", "object 'Wall'"}, {"hash", "2"}},
                              {{"what", "mesh 'Wall'"}, {"hash", "1"}}};
  folder.content["inputs"] = {{{"kind", "picture"}, {"path", "/wall.png"}, {"there", false}}};
  const SceneSurvey survey = folder.read();
  EXPECT_EQ(survey.digest.entries, (std::vector<DigestEntry>{{"mesh 'Wall'", "1"}, {"object 'Wall'", "2"}}));
  EXPECT_EQ(survey.inputs, (std::vector<InputFile>{{"picture", "/wall.png", false}}));
  folder.content["digest"].push_back({{"what", "mesh 'Wall'"}, {"hash", "3"}});
  EXPECT_EQ(folder.refusal(ExitCode::invalid_input), "mesh 'Wall': twice in the digest of the scene");
}

TEST(SceneSurvey, HoldsWhatWasWritten) {
  const SceneSurvey survey = Folder().read();
  EXPECT_EQ(survey.scene_file, "a.blend");
  EXPECT_EQ(survey.blender_version, "3.4.1");
  ASSERT_EQ(survey.objects.size(), 2U);
  EXPECT_EQ(survey.objects[1].key, "Säule/柱");
  EXPECT_EQ(survey.objects[0].slots, (std::vector<std::string>{"red", ""}));
  Vec3d place;
  survey.objects[0].to_world.multVecMatrix(Vec3d(1, 1, 1), place);
  EXPECT_EQ(place, Vec3d(6, 8, 10));
  const Mesh& mesh = survey.mesh_of(survey.objects[0]);
  EXPECT_EQ(mesh.positions[1], Vec3(1, 0, 0));
  EXPECT_EQ(mesh.uv_layers.at(0).uv[2], Vec2(0, 1));
  EXPECT_EQ(mesh.polygon_slot[0], 0U);  // -1 is read as Cycles reads it
  EXPECT_TRUE(survey.materials.at("red").normal_mapped);
  EXPECT_EQ(survey.lights.at(0).energy, 2.5);
  EXPECT_EQ(survey.lights[0].sizes.at("angle"), 0.01);
  EXPECT_EQ(survey.world, "constant");
  EXPECT_EQ(survey.world_strength, 0.5);
  EXPECT_EQ(survey.warnings, std::vector<std::string>{"hm"});
}

TEST(SceneSurvey, NamesTheObjectWithANaNVertex) {
  Folder folder;
  folder.put("positions", 4, nan);
  const std::string message = folder.refusal(ExitCode::invalid_input);
  EXPECT_NE(message.find("object 'Wall': vertex 1"), std::string::npos) << message;
}

TEST(SceneSurvey, NamesTheLayerWithAnInfiniteUv) {
  Folder folder;
  const float infinity = std::numeric_limits<float>::infinity();
  std::memcpy(&folder.data[folder.mesh()["uv_layers"][0]["offset"].get<std::size_t>()], &infinity, 4);
  const std::string message = folder.refusal(ExitCode::invalid_input);
  EXPECT_NE(message.find("object 'Wall': UV layer 'UVMap': corner 0"), std::string::npos) << message;
}

TEST(SceneSurvey, ReplacesUselessNormalsByTheFaces) {
  Folder folder;
  folder.put("loop_normal", 3, nan);
  folder.put("loop_normal", 8, 0.0F);
  const SceneSurvey survey = folder.read();
  EXPECT_EQ(survey.meshes[0].loop_normal[1], Vec3(0, 0, 1));
  EXPECT_EQ(survey.meshes[0].loop_normal[2], Vec3(0, 0, 1));
}

TEST(SceneSurvey, RefusesIndicesThatPointNowhere) {
  for (const char* what : {"loop_vertex", "triangle_loops", "triangle_polygon"}) {
    for (const std::int32_t index : {3, -1}) {
      Folder folder;
      folder.put(what, 0, index);
      EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("object 'Wall'"), std::string::npos) << what;
    }
  }
  Folder folder;
  folder.put("polygon_size", 0, 4);
  EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("face 0"), std::string::npos);
}

TEST(SceneSurvey, RefusesAMeshThatDoesNotExist) {
  Folder folder;
  folder.content["objects"][1]["mesh"] = 1;
  EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("Säule/柱"), std::string::npos);
}

TEST(SceneSurvey, RefusesTwoObjectsWithOneKey) {
  Folder folder;
  folder.content["objects"][1]["key"] = "Wall";
  EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("twice"), std::string::npos);
}

TEST(SceneSurvey, RefusesUvLayersThatAreNotThere) {
  Folder folder;
  folder.mesh()["active_uv"] = 1;
  EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("active UV layer"), std::string::npos);
}

TEST(SceneSurvey, RefusesDataThatEndsEarly) {
  Folder cut;
  cut.declared_bytes = cut.data.size();
  cut.data.resize(cut.data.size() - 1);
  EXPECT_NE(cut.refusal(ExitCode::invalid_input).find("survey.bin"), std::string::npos);
  Folder beyond;
  beyond.mesh()["positions"] = std::numeric_limits<std::size_t>::max() - 3;
  EXPECT_NE(beyond.refusal(ExitCode::invalid_input).find("positions"), std::string::npos);
  Folder huge;
  huge.mesh()["vertices"] = std::numeric_limits<std::size_t>::max() / 2;
  EXPECT_NE(huge.refusal(ExitCode::invalid_input).find("positions"), std::string::npos);
}

TEST(SceneSurvey, RefusesAnotherFormat) {
  Folder folder;
  folder.content["format"] = 2;
  EXPECT_NE(folder.refusal(ExitCode::unsupported).find("format 2"), std::string::npos);
}

TEST(SceneSurvey, RefusesWhatIsNoSurvey) {
  Folder folder;
  folder.content["objects"][0].erase("slots");
  EXPECT_NE(folder.refusal(ExitCode::invalid_input).find("survey.json"), std::string::npos);
  std::ofstream(folder.path() / "broken.json") << "{";
  EXPECT_THROW((void)read_survey(folder.path() / "broken.json"), Error);
  EXPECT_THROW((void)read_survey(folder.path() / "missing.json"), Error);
}

}  // namespace
}  // namespace rnmbake
