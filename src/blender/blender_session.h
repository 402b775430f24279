// blender/blender_session.h - settings, Blender and private folder of one command's launches.
#pragma once

#include "base/files.h"
#include "blender/launch.h"
#include "config/resolve.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

#include <nlohmann/json.hpp>

namespace rnmbake {

/// One command's launches: the settings they follow, the Blender that runs them, a private folder for their
/// files.
class BlenderSession {
 public:
  /// The private folder lies in `parent`, or where TMPDIR points.
  BlenderSession(const ResolvedConfig& config, Blender& blender, const std::filesystem::path& parent = {});

  [[nodiscard]] const ResolvedConfig& config() const { return config_; }
  [[nodiscard]] const BakeSettings& settings() const { return config_.globals; }
  [[nodiscard]] Blender& blender() const { return blender_; }

  /// New folder for one launch, named after its purpose.
  [[nodiscard]] std::filesystem::path new_folder(const std::string& purpose);

  [[nodiscard]] LaunchLimits limits() const;
  /// Threads for one of `jobs` Blenders at a time.
  [[nodiscard]] int threads(int jobs) const;

  /// Runs a launch without which the command cannot go on. Throws the Error of its failure.
  [[nodiscard]] nlohmann::json run(Launch launch);

 private:
  const ResolvedConfig& config_;
  Blender& blender_;
  TempFolder folder_;
  std::atomic<int> launches_ = 0;
};

/// One line: step, failure and remedy.
[[nodiscard]] std::string describe(const LaunchFailure& failure);

/// Throws the script's own refusal, Error(tasks_failed), or Interrupted.
[[noreturn]] void throw_failure(const LaunchFailure& failure);

/// The user stopped the program; not an Error, since nothing is wrong.
struct Interrupted {
  int signal = 0;
};

}  // namespace rnmbake
