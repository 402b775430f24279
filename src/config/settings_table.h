// config/settings_table.h - the lines of the table; config/settings.h is what others read.
#pragma once

#include "config/setting.h"

#include <vector>

namespace rnmbake {

[[nodiscard]] std::vector<Setting> make_settings_table();

}  // namespace rnmbake
