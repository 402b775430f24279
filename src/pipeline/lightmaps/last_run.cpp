#include "pipeline/lightmaps/last_run.h"

#include "base/error.h"
#include "base/files.h"
#include "base/json.h"
#include "base/log.h"
#include "base/read_file.h"
#include "base/version.h"
#include "blender/late_blender.h"
#include "config/value.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace rnmbake {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Settings that change how the work is done, and nothing of what comes out.
constexpr std::array<std::string_view, 12> without_effect{
    "file",           "dir",     "keep_temporary", "jobs",        "threads",   "timeout",
    "launch_timeout", "retries", "cache",          "cache_limit", "lock_wait", "memory_max"};

bool has_effect(const Setting& setting) {
  return std::ranges::find(without_effect, setting.key) == without_effect.end();
}

std::string line_of(const SettingOverride& one) {
  return fmt::format("{} = {}\n", one.setting->key, to_toml(one.value));
}

std::string settings_text(const ResolvedConfig& config, const std::string& command) {
  std::string text = fmt::format("command = {}\nrnmbake = {}\n", command, version);
  for (const SettingOverride& one : config.values()) {
    if (has_effect(*one.setting)) text += line_of(one);
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

/// What the manifest lists, with the hashes that it has of lightmaps.
std::vector<RunFile> written_files(const fs::path& dir) {
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

json to_json(const SceneDigest& digest) {
  json entries = json::array();
  for (const DigestEntry& entry : digest.entries) entries.push_back({entry.what, entry.hash});
  return entries;
}

}  // namespace

LastRun::LastRun(const ResolvedConfig& config, std::string command, bool needs_blender)
    : config_(config), settings_(settings_text(config, command)) {
  if (needs_blender) {
    blender_ = blender_of(config.globals);
    settings_ += fmt::format("blender at {}\n", blender_.string());
  }
  if (!fs::exists(record_file())) {
    reasons_.emplace_back("nothing was baked there before");
    return;
  }
  auto record = read_record(record_file());
  if (!record) {
    reasons_.emplace_back("the record of the last run cannot be read");
    return;
  }
  reasons_ = reasons_to_run(*record, settings_);
  files_ = record->files;
  if (!reasons_.empty()) return;
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

Reasons LastRun::scene_changes(const SceneDigest& now) const {
  try {
    if (!fs::exists(digest_file())) return {};
    SceneDigest before;
    for (const json& entry : parse_json(read_text(digest_file()), digest_file().string()))
      before.entries.push_back({entry.at(0).get<std::string>(), entry.at(1).get<std::string>()});
    return differences(before, now);
  } catch (const Error&) {
    return {};
  } catch (const json::exception&) {
    return {};
  }
}

void LastRun::keep(const SceneSurvey& survey) const {
  const BakeSettings& settings = config_.globals;
  RunRecord record{settings_, {look_at("program", fs::read_symlink("/proc/self/exe"))}};
  const auto add = [&](const char* kind, const fs::path& path) {
    if (!path.empty()) record.files.push_back(look_at(kind, fs::absolute(path)));
  };
  add("blender", blender_);
  add("project file", config_.project_file);
  add("scene", settings.scene.file);
  add("basis file", settings.bake.basis);
  for (const InputFile& input : survey.inputs) {
    if (input.path != fs::absolute(settings.scene.file)) add(input.kind.c_str(), input.path);
  }
  for (RunFile& file : written_files(fs::absolute(settings.output.dir)))
    record.files.push_back(std::move(file));
  write_atomically(digest_file(), to_json(survey.digest).dump() + "\n");
  write_record(record_file(), record);
}

}  // namespace rnmbake
