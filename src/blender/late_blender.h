// blender/late_blender.h - the settings' Blender, found at its first use.
#pragma once

#include "blender/real_blender.h"
#include "config/bake_settings.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

namespace rnmbake {

/// Where it is, which takes no launch. Throws Error(environment).
[[nodiscard]] std::filesystem::path blender_of(const BakeSettings& settings);

/// Thread-safe. Everything throws Error(environment) where there is no usable Blender.
class LateBlender : public Blender {
 public:
  explicit LateBlender(const BakeSettings& settings) : settings_(settings) {}

  [[nodiscard]] const BlenderInfo& info() const override { return found().info(); }

  LaunchOutcome run(const Launch& launch, const LaunchLimits& limits,
                    const std::function<void(const ProgressEvent&)>& on_progress) override {
    return found().run(launch, limits, on_progress);
  }

 private:
  [[nodiscard]] RealBlender& found() const;

  const BakeSettings& settings_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<RealBlender> found_;
};

}  // namespace rnmbake
