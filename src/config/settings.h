// config/settings.h - the one table of settings, from which project file, flags, environment, help and docs
// come.
#pragma once

#include "config/setting.h"

#include <span>
#include <string_view>
#include <vector>

namespace rnmbake {

/// Ordered as they are shown.
[[nodiscard]] const std::vector<Setting>& settings();
[[nodiscard]] std::span<const SettingTable> setting_tables();

/// nullptr where no setting has that key.
[[nodiscard]] const Setting* find_setting(std::string_view key);

}  // namespace rnmbake
