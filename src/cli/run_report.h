// cli/run_report.h - what a run made and from what: --json for scripts, --depfile for builds.
#pragma once

#include "config/resolve.h"
#include "scene/scene_digest.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace CLI {
class App;
}  // namespace CLI

namespace rnmbake {

/// Filled in by a command while it runs.
struct RunReport {
  std::filesystem::path output;                                    // folder
  std::filesystem::path main_file;                                 // target of the depfile; appears last
  std::vector<std::filesystem::path> inputs;                       // files that were read
  std::vector<std::string> files;                                  // that were written, names in `output`
  nlohmann::ordered_json more = nlohmann::ordered_json::object();  // entries of this command (docs/json.md)
};

/// --json and --depfile of a command. Must live as long as `command`.
class RunFlags {
 public:
  explicit RunFlags(CLI::App& command);
  RunFlags(const RunFlags&) = delete;
  RunFlags& operator=(const RunFlags&) = delete;

  /// Does `work`, which returns the exit code. After it the depfile is written, unless the run failed as a
  /// whole; last the object goes to stdout, with the error where there was one. Throws what `work` throws.
  int run(const std::function<int(RunReport&)>& work) const;

  [[nodiscard]] bool json() const { return json_; }
  [[nodiscard]] bool wants_depfile() const { return !depfile_.empty(); }

 private:
  void print(const RunReport& report, int code, double seconds, const std::string& error) const;

  std::string command_;
  bool json_ = false;
  std::filesystem::path depfile_;
};

/// Output folder with its manifest.json, and what was read: scene, project file and basis file.
[[nodiscard]] RunReport made_from(const ResolvedConfig& config);

/// Adds the files that the scene read and that are there.
void add_scene_inputs(const std::vector<InputFile>& inputs, RunReport& report);

/// Adds one of several scenes to what was made in `all.output`: its files and keys get its folder's path in
/// there in front.
void add_scene(const RunReport& scene, RunReport& all);

/// Adds a scene that failed as a whole.
void add_failed_scene(const std::filesystem::path& folder, const std::string& reason, RunReport& all);

/// Reads the manifest.json that a run wrote into `report.output`: its files, counts, failed objects.
void add_lightmaps(RunReport& report);

}  // namespace rnmbake
