#include "blender/late_blender.h"

#include "base/error.h"
#include "blender/find.h"
#include "blender/probe.h"
#include "blender/sandbox/sandbox.h"

#include <optional>

namespace rnmbake {

namespace fs = std::filesystem;

namespace {

/// The settings' sandbox. Error(environment) where there is none to be had.
LaunchTrust::Sandboxed sandbox_of(const BakeSettings& settings) {
  if (const auto obstacle = sandbox_obstacle()) fail(ExitCode::environment, "--sandbox: {}", *obstacle);
  LaunchTrust::Sandboxed sandbox;
  sandbox.gpu = settings.bake.device != BakingSettings::Device::cpu;
  std::error_code error;
  if (fs::exists(settings.scene.file, error)) {
    const fs::path folder = fs::absolute(settings.scene.file).parent_path();
    refuse_broad_folder(folder, settings.scene.file.string());
    sandbox.read.push_back(folder);
  }
  for (const fs::path& folder : settings.run.sandbox_read) {
    if (!fs::exists(folder, error))
      fail(ExitCode::usage, "--sandbox-read: there is no {}; name a folder that is there", folder.string());
    refuse_broad_folder(folder, "what --sandbox-read names");
    sandbox.read.push_back(folder);
  }
  return sandbox;
}

}  // namespace

std::filesystem::path blender_of(const BakeSettings& settings) {
  const std::string& wanted = settings.run.blender;
  return find_blender(wanted.empty() ? std::nullopt : std::optional(wanted));
}

RealBlender& LateBlender::found() const {
  std::call_once(once_, [this] {
    RealBlender::Options options;
    options.trust.allow_scripts = settings_.scene.allow_scripts;
    if (settings_.run.sandbox) options.trust.sandbox = sandbox_of(settings_);
    if (!settings_.run.scripts.empty()) options.scripts = settings_.run.scripts;
    found_ = std::make_unique<RealBlender>(probe_version(blender_of(settings_)), options);
  });
  return *found_;
}

}  // namespace rnmbake
