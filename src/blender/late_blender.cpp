#include "blender/late_blender.h"

#include "blender/find.h"
#include "blender/probe.h"

#include <optional>

namespace rnmbake {

RealBlender& LateBlender::found() const {
  std::call_once(once_, [this] {
    RealBlender::Options options;
    options.trust.allow_scripts = settings_.scene.allow_scripts;
    if (!settings_.run.scripts.empty()) options.scripts = settings_.run.scripts;
    const std::string& wanted = settings_.run.blender;
    const auto executable = find_blender(wanted.empty() ? std::nullopt : std::optional(wanted));
    found_ = std::make_unique<RealBlender>(probe_version(executable), options);
  });
  return *found_;
}

}  // namespace rnmbake
