#include "scene/survey_parse.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/read_file.h"
#include "base/text.h"
#include "scene/survey_meshes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace rnmbake {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr int survey_format = 1;

SceneObject read_object(const json& entry, std::size_t meshes) {
  SceneObject object;
  object.key = entry.at("key").get<std::string>();
  object.name = entry.at("name").get<std::string>();
  object.instancer = entry.at("instancer").get<std::string>();
  object.type = entry.at("type").get<std::string>();
  object.mesh = index_at(entry, "mesh");
  object.to_world = read_matrix(entry.at("matrix"), "object '" + object.key + "'");
  object.slots = entry.at("slots").get<std::vector<std::string>>();
  object.light_group = entry.at("light_group").get<std::string>();
  object.visible_to_camera = entry.at("visible_to_camera").get<bool>();
  object.visible_to_bounces = entry.value("visible_to_bounces", true);
  if (object.mesh < 0 || static_cast<std::size_t>(object.mesh) >= meshes) {
    fail(ExitCode::invalid_input, "object '{}': mesh {} of {} does not exist", object.key, object.mesh,
         meshes);
  }
  return object;
}

MaterialInfo read_material(const std::string& name, const json& entry) {
  return {name, entry.at("normal_mapped").get<bool>(), entry.at("emissive").get<bool>(),
          entry.at("outside_model").get<std::vector<std::string>>(), entry.value("even", false)};
}

GatherNotes read_gather_notes(const json& entry) {
  return {entry.at("refused").get<std::vector<std::string>>(),
          entry.at("unshared").get<std::vector<std::string>>()};
}

LightInfo read_light(const json& entry) {
  LightInfo light;
  light.name = entry.at("name").get<std::string>();
  light.type = entry.at("type").get<std::string>();
  light.energy = entry.at("energy").get<double>();
  light.color = entry.at("color").get<std::array<double, 3>>();
  light.shape = entry.at("shape").get<std::string>();
  light.max_bounces = entry.value("max_bounces", light.max_bounces);
  light.sizes = entry.at("sizes").get<std::map<std::string, double>>();
  light.to_world = read_matrix(entry.at("matrix"), "light '" + light.name + "'");
  light.outside_model = entry.at("outside_model").get<std::vector<std::string>>();
  return light;
}

ProbePlace read_probe_place(const json& entry) {
  ProbePlace place{entry.at("name").get<std::string>(), {}, entry.at("counts").get<std::array<int, 3>>()};
  place.to_world = read_matrix(entry.at("matrix"), "'" + place.name + "'");
  const bool is_empty = place.counts == std::array<int, 3>{};
  for (const int count : place.counts) {
    if (!is_empty && (count < 1 || count > 4096))
      fail(ExitCode::invalid_input, "'{}': a volume of {} light probes", place.name, count);
  }
  return place;
}

void read_world(const json& entry, SceneSurvey& survey) {
  survey.world = entry.at("kind").get<std::string>();
  survey.world_strength = entry.at("strength").get<double>();
  survey.world_color = entry.at("color").get<std::array<double, 3>>();
}

void read_objects(const json& content, SceneSurvey& survey) {
  std::set<std::string> keys;
  for (const json& entry : content.at("objects")) {
    survey.objects.push_back(read_object(entry, content.at("meshes").size()));
    if (!keys.insert(survey.objects.back().key).second) {
      fail(ExitCode::invalid_input, "object '{}': listed twice in the survey", survey.objects.back().key);
    }
  }
}

void read_meshes(const json& content, Blob& data, SceneSurvey& survey) {
  for (const json& entry : content.at("meshes")) {
    const int index = static_cast<int>(survey.meshes.size());
    const auto owner = [&]() -> std::string {  // users know their objects, not the meshes
      for (const SceneObject& object : survey.objects) {
        if (object.mesh == index) {
          return "object '" + object.key + "': ";
        }
      }
      return "mesh '" + entry.at("name").get<std::string>() + "': ";
    };
    survey.meshes.push_back(read_mesh(entry, data, owner));
  }
}

SceneSurvey read_content(const json& content, const fs::path& folder) {
  const std::string data = read_data(data_file(content, folder));
  if (data.size() != count_at(content, "data_bytes")) {
    fail(ExitCode::invalid_input, "{}: survey.bin has {} bytes, {} were written; is the disk full?",
         folder.string(), data.size(), count_at(content, "data_bytes"));
  }
  Blob blob(data.data(), data.size());
  return parse_survey(content, blob);
}

}  // namespace

Mat44 read_matrix(const json& values, const std::string& owner) {
  if (values.size() != 16) {
    fail(ExitCode::invalid_input, "{}: its matrix has {}, not 16", owner, counted(values.size(), "number"));
  }
  Mat44 matrix;  // Blender writes rows of a matrix that multiplies columns; Imath multiplies rows
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const json& value = values.at(4 * row + column);
      // Python writes NaN and Infinity, which are no JSON numbers and make the parser refuse the file.
      matrix[column][row] = value.get<double>();
    }
  }
  return matrix;
}

json to_json(const SceneDigest& digest) {
  json list = json::array();
  for (const DigestEntry& entry : digest.entries)
    list.push_back({{"what", entry.what}, {"hash", entry.hash}, {"uses", entry.uses}});
  return list;
}

SceneDigest read_digest(const json& list) {
  SceneDigest digest;
  for (const json& entry : list)
    digest.entries.push_back({entry.at("what").get<std::string>(), entry.at("hash").get<std::string>(),
                              entry.value("uses", std::vector<std::string>{})});
  std::ranges::sort(digest.entries, {}, &DigestEntry::what);
  const auto twice = std::ranges::adjacent_find(digest.entries, {}, &DigestEntry::what);
  if (twice != digest.entries.end())
    fail(ExitCode::invalid_input, "{}: twice in the digest of the scene", twice->what);
  return digest;
}

std::vector<InputFile> read_inputs(const json& list) {
  std::vector<InputFile> files;
  for (const json& entry : list) {
    files.push_back({entry.at("kind").get<std::string>(), entry.at("path").get<std::string>(),
                     entry.at("there").get<bool>()});
  }
  return files;
}

SceneSurvey parse_survey(const json& content, Blob& data) {
  if (content.at("format") != survey_format || content.at("byte_order") != "little") {
    fail(ExitCode::unsupported, "written by scripts of another rnmbake (format {}, {} endian)",
         brief(content.at("format")), brief(content.at("byte_order")));
  }
  SceneSurvey survey;
  survey.scene_file = content.at("scene_file").get<std::string>();
  survey.scene_name = content.at("scene_name").get<std::string>();
  survey.blender_version = content.at("blender_version").get<std::string>();
  read_objects(content, survey);
  read_meshes(content, data, survey);
  for (const auto& [name, entry] : content.at("materials").items()) {
    survey.materials[name] = read_material(name, entry);
  }
  for (const json& entry : content.at("lights")) {
    survey.lights.push_back(read_light(entry));
  }
  for (const json& entry : content.value("probe_places", json::array()))  // files of older versions have none
    survey.probe_places.push_back(read_probe_place(entry));
  read_world(content.at("world"), survey);
  if (content.contains("gather")) survey.gather = read_gather_notes(content["gather"]);  // of a bake's scene
  survey.digest = read_digest(content.value("digest", json::array()));  // scenes for the tracer have neither
  survey.inputs = read_inputs(content.value("inputs", json::array()));
  survey.warnings = content.at("warnings").get<std::vector<std::string>>();
  return survey;
}

fs::path data_file(const json& content, const fs::path& folder) {
  const auto& name = content.at("data").get_ref<const std::string&>();
  const auto file = file_inside(folder, name);
  if (!file)
    fail(ExitCode::invalid_input, "'data' is {}, which is no plain file name", brief(content["data"]));
  return *file;
}

SceneSurvey read_survey(const fs::path& json_file) {
  const std::string text = read_text(json_file);
  try {
    return read_content(parse_json(text, json_file.string()), json_file.parent_path());
  } catch (const json::exception& error) {
    fail(ExitCode::invalid_input, "{}: not a survey that this rnmbake can read: {}", json_file.string(),
         brief(error));
  }
}

}  // namespace rnmbake
