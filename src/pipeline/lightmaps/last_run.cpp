#include "pipeline/lightmaps/last_run.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/read_file.h"
#include "base/text.h"
#include "base/version.h"
#include "blender/late_blender.h"
#include "config/value.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view assumed_key = "assumed = ";

/// [reference] of a project file is nothing to a bake.
bool has_effect(const Setting& setting, const std::string& command) {
  return setting.has_effect && (command != "bake" || setting.serves(Purpose::bake));
}

std::string line_of(const SettingOverride& one) {
  return fmt::format("{} = {}\n", one.setting->key, to_toml(one.value));
}

std::string settings_text(const ResolvedConfig& config, const std::string& command) {
  std::string text = fmt::format("command = {}\nrnmbake = {}\n", command, version);
  text += fmt::format("file = {}\n", fs::absolute(config.globals.scene.file).lexically_normal().string());
  for (const SettingOverride& one : config.values()) {
    if (has_effect(*one.setting, command)) text += line_of(one);
  }
  for (std::size_t i = 0; i < config.overrides().size(); ++i) {
    const ObjectOverride& override_ = config.overrides()[i];
    std::string objects;
    for (const std::string& pattern : override_.objects) objects += pattern + ",";
    for (const SettingOverride& one : override_.values)
      text += fmt::format("{} (override {} of {})\n", line_of(one).substr(0, line_of(one).size() - 1), i + 1,
                          objects.substr(0, objects.size() - 1));
  }
  return text;
}

/// In the settings of a record: a run without --assume-local has none.
std::string assumed_line(std::size_t lightmaps) {
  return lightmaps == 0 ? "" : fmt::format("{}{}\n", assumed_key, counted(lightmaps, "lightmap"));
}

/// Takes that line out of them; what it says, "" where there was none.
std::string take_assumed(std::string& settings) {
  const std::size_t begin = settings.find(assumed_key);
  if (begin == std::string::npos) return "";
  const std::size_t end = settings.find('\n', begin);
  const std::size_t text = begin + assumed_key.size();
  std::string what = settings.substr(text, end - text);
  settings.erase(begin, end + 1 - begin);
  return what;
}

/// The first reason to run that no scene has to do with.
std::string reason_but_scene(const RunRecord& record, const std::string& settings) {
  RunRecord other{record.settings, {}};
  for (const RunFile& file : record.files) {
    if (file.kind == "program" || file.kind == "blender" || file.kind == "basis file")
      other.files.push_back(file);
  }
  const Reasons reasons = reasons_to_run(other, settings);
  return reasons.empty() ? "" : reasons.front();
}

}  // namespace

std::vector<RunFile> lightmap_files(const fs::path& folder) {
  const fs::path dir = fs::absolute(folder);
  std::vector<RunFile> files{look_at("output", dir / "manifest.json")};
  const json manifest = parse_json(read_text(dir / "manifest.json"), "manifest.json");
  for (const json& object : manifest.at("objects")) {
    const json hashes = object.value("hashes", json::array());  // none where an older program made it
    for (std::size_t i = 0; i < object.at("files").size(); ++i) {
      const std::string hash = i < hashes.size() ? hashes[i].get<std::string>() : "";
      files.push_back(look_at("output", dir / object["files"][i].get<std::string>(), hash));
    }
  }
  if (const auto saved = manifest.value("scene_with_uvs", std::string()); !saved.empty())
    files.push_back(look_at("output", dir / saved));
  return files;
}

LastRun::LastRun(const ResolvedConfig& config, const std::string& command, const Needs& needs)
    : config_(config), settings_(settings_text(config, command)) {
  if (needs.blender) {
    blender_ = blender_of(config.globals);
    settings_ += fmt::format("blender at {}\n", blender_.string());
  }
  if (!fs::exists(record_file())) {
    reasons_.emplace_back("nothing was made there before");
    return;
  }
  auto record = read_record(record_file());
  if (!record) {
    reasons_.emplace_back("the record of the last run cannot be read");
    return;
  }
  const std::string recorded = record->settings;
  const std::string assumed = take_assumed(record->settings);
  other_ = reason_but_scene(*record, settings_);
  reasons_ = reasons_to_run(*record, settings_);
  if (!assumed.empty() && needs.is_settled)
    reasons_.push_back(assumed + " assumed to be as before (--assume-local)");
  files_ = record->files;
  if (!reasons_.empty()) return;
  record->settings = recorded;
  write_record(record_file(), *record);  // with the times of files that were touched
}

std::vector<InputFile> LastRun::inputs() const {
  std::vector<InputFile> inputs;
  for (const RunFile& file : files_) {
    const bool of_program = file.kind == "program" || file.kind == "blender" || file.kind == "output";
    if (!of_program) inputs.push_back({file.kind, file.path, file.size >= 0});
  }
  return inputs;
}

fs::path LastRun::record_in(const fs::path& dir) {
  return dir / ".rnmbake-run.json";
}

fs::path LastRun::record_file() const {
  return record_in(config_.globals.output.dir);
}

fs::path LastRun::digest_file() const {
  return config_.globals.output.dir / ".rnmbake-scene.json";
}

std::optional<PlacedScene> LastRun::scene() const {
  if (!fs::exists(digest_file())) return std::nullopt;
  try {
    return placed_scene_from(parse_json(read_text(digest_file()), digest_file().string()));
  } catch (const Error&) {
    return std::nullopt;  // cut off, or of an older version
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

Reasons LastRun::scene_changes(const SceneDigest& now) const {
  const auto before = scene();
  return before ? differences(before->digest, now) : Reasons{};
}

void LastRun::keep(const std::vector<InputFile>& inputs, const PlacedScene& scene,
                   std::vector<RunFile> outputs, std::size_t assumed) const {
  const BakeSettings& settings = config_.globals;
  RunRecord record{settings_ + assumed_line(assumed),
                   {look_at("program", fs::read_symlink("/proc/self/exe"))}};
  const auto add = [&](const char* kind, const fs::path& path) {
    if (!path.empty()) record.files.push_back(look_at(kind, fs::absolute(path)));
  };
  add("blender", blender_);
  add("project file", config_.project_file);
  add("scene", settings.scene.file);
  add("basis file", settings.bake.basis);
  for (const InputFile& input : inputs) {
    if (input.path != fs::absolute(settings.scene.file)) add(input.kind.c_str(), input.path);
  }
  std::ranges::move(outputs, std::back_inserter(record.files));
  write_atomically(digest_file(), to_json(scene).dump() + "\n");
  write_record(record_file(), record);
}

}  // namespace rnmbake
