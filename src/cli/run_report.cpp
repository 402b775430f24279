#include "cli/run_report.h"

#include "base/clock.h"
#include "base/error.h"
#include "cli/flags/command_line.h"
#include "jobs/depfile.h"
#include "pipeline/lightmaps/manifest_file.h"

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

namespace rnmbake {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

namespace {

constexpr int json_schema_version = 1;  // docs/json.schema.json

/// "hall/": of a scene among several.
std::string folder_in(const fs::path& folder, const RunReport& all) {
  const fs::path relative = folder.lexically_normal().lexically_relative(all.output);
  return (relative.empty() ? folder : relative).string() + "/";
}

void add_counts(RunReport& all) {
  if (all.more.empty()) all.more = {{"lightmaps", 0}, {"failed", ordered_json::array()}};
}

}  // namespace

RunFlags::RunFlags(CLI::App& command) : command_(command.get_name()) {
  command.add_flag("--json", json_, "print what was done as one JSON object, last of all (docs/json.md)");
  command
      .add_option("--depfile", depfile_,
                  "write the files that this run read, as a rule for make and Ninja (docs/builds.md)")
      ->type_name("FILE");
}

int RunFlags::run(const std::function<int(RunReport&)>& work) const {
  const double start = steady_clock().now();
  const auto seconds = [&] { return steady_clock().now() - start; };
  RunReport report;
  try {
    const int code = work(report);
    if (report.main_file.empty()) return code;  // --print-config
    if (!depfile_.empty()) write_depfile(depfile_, report.main_file.lexically_normal(), report.inputs);
    print(report, code, seconds(), "");
    return code;
  } catch (const Error& error) {
    print(report, static_cast<int>(error.code()), seconds(), error.what());
    throw;
  }
}

void RunFlags::print(const RunReport& report, int code, double seconds, const std::string& error) const {
  if (!json_) return;
  ordered_json object{{"schema_version", json_schema_version}, {"command", command_}, {"exit_code", code}};
  if (!error.empty()) object["error"] = error;
  object["seconds"] = seconds;
  if (error.empty()) {
    object["output"] = report.output.string();
    object["files"] = report.files;
    object.update(report.more);
  }
  std::cout << object.dump(2, ' ', false, ordered_json::error_handler_t::replace) << std::endl;
}

RunReport made_from(const ResolvedConfig& config) {
  RunReport report;
  report.output = config.globals.output.dir;
  report.main_file = report.output / "manifest.json";
  report.inputs.push_back(config.globals.scene.file);
  if (const fs::path project = project_of(config); !project.empty()) report.inputs.push_back(project);
  if (!config.globals.bake.basis.empty()) report.inputs.push_back(config.globals.bake.basis);
  return report;
}

void add_scene_inputs(const std::vector<InputFile>& inputs, RunReport& report) {
  std::vector<fs::path> known;  // the user's own words for some of them
  for (const fs::path& input : report.inputs) known.push_back(fs::absolute(input).lexically_normal());
  for (const InputFile& input : inputs) {
    if (input.was_there && std::ranges::find(known, input.path) == known.end())
      report.inputs.push_back(input.path);
  }
}

void add_scene(const RunReport& scene, RunReport& all) {
  if (scene.main_file.empty()) return;  // a plan
  all.main_file = scene.main_file;
  const std::string folder = folder_in(scene.output, all);
  for (const std::string& file : scene.files) all.files.push_back(folder + file);
  add_counts(all);
  all.more["lightmaps"] =
      all.more["lightmaps"].get<std::size_t>() + scene.more.at("lightmaps").get<std::size_t>();
  for (ordered_json failed : scene.more.at("failed")) {
    failed["key"] = folder + failed.at("key").get<std::string>();
    all.more["failed"].push_back(std::move(failed));
  }
}

void add_failed_scene(const fs::path& folder, const std::string& reason, RunReport& all) {
  all.main_file = folder / "manifest.json";
  add_counts(all);
  all.more["failed"].push_back({{"key", folder_in(folder, all)}, {"reason", reason}});
}

void add_lightmaps(RunReport& report) {
  const nlohmann::json manifest = read_manifest(report.output / "manifest.json");
  std::size_t baked = 0;
  ordered_json failed = ordered_json::array();
  for (const auto& entry : manifest.at("objects")) {
    if (entry.contains("earlier")) continue;
    if (entry.at("status") == "failed") {
      failed.push_back({{"key", entry.at("key")}, {"reason", entry.at("error")}});
      continue;
    }
    ++baked;
    for (const auto& file : entry.at("files")) report.files.push_back(file.get<std::string>());
  }
  if (const auto saved = manifest.at("scene_with_uvs").get<std::string>(); !saved.empty())
    report.files.push_back(saved);
  report.files.insert(report.files.end(), {"timings.json", "manifest.json"});
  report.more["lightmaps"] = baked;
  report.more["failed"] = std::move(failed);
}

}  // namespace rnmbake
