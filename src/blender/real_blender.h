// blender/real_blender.h - the Blender that is installed, started headless and believed only with proof.
#pragma once

#include "blender/launch.h"
#include "blender/scripts.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rnmbake {

struct LaunchTrust {
  bool allow_scripts = false;  // scripts and scripted drivers inside the .blend may run (-y instead of -Y)
  /// Launches run in a sandbox (blender/sandbox/) that may read these beside the scene's folder; none: as we
  /// do.
  struct Sandboxed {
    std::vector<std::filesystem::path> read;
    bool gpu = false;
  };
  std::optional<Sandboxed> sandbox = std::nullopt;
};

/// The command line of one launch. Options come before the file and the script: after them Blender ignores
/// --python-exit-code, and what an old Blender does not know it takes for a file name.
std::vector<std::string> launch_argv(const BlenderInfo& info, const ScriptFolder& scripts,
                                     const LaunchTrust& trust, const Launch& launch);

/// One launch to its end. An answer counts only if result.json holds this launch's nonce and Blender returned
/// 0.
LaunchOutcome launch_blender(const BlenderInfo& info, const ScriptFolder& scripts, const LaunchTrust& trust,
                             const Launch& launch, const LaunchLimits& limits,
                             const std::function<void(const ProgressEvent&)>& on_progress);

/// May be used from several threads at once, each launch with its own folder.
class RealBlender : public Blender {
 public:
  struct Options {
    LaunchTrust trust;
    std::optional<std::filesystem::path> scripts;  // none: the embedded ones
  };

  /// `info` from probe_version(find_blender(...)).
  RealBlender(BlenderInfo info, const Options& options);

  [[nodiscard]] const BlenderInfo& info() const override { return info_; }

  /// Completes info() with devices, numpy and denoiser; launches Blender the first time. Not while others
  /// run.
  const BlenderInfo& complete_info();

  LaunchOutcome run(const Launch& launch, const LaunchLimits& limits,
                    const std::function<void(const ProgressEvent&)>& on_progress) override;

 private:
  BlenderInfo info_;
  LaunchTrust trust_;
  ScriptFolder scripts_;
};

/// Fills in devices, numpy and denoiser by one headless launch (1-2 s). Error(environment) if it fails.
void probe_devices(BlenderInfo& info, const ScriptFolder& scripts);

}  // namespace rnmbake
