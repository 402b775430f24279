// config/value.h - values of settings from text and to text, checked against their setting.
#pragma once

#include "config/settings.h"

#include <string>
#include <string_view>

namespace rnmbake {

/// From a flag or the environment: numbers, true/false/yes/no/on/off/1/0, choices in any case, lists with
/// commas. `where` opens the message of Error(usage): "flag --samples", "RNMBAKE_SAMPLES".
[[nodiscard]] SettingValue parse_value(const Setting& setting, std::string_view text,
                                       const std::string& where);

/// `value` if it lies in the setting's range or choices, with a choice's own spelling. Throws Error(usage).
[[nodiscard]] SettingValue checked(const Setting& setting, SettingValue value, const std::string& where);

/// As TOML writes it; this is also how help and messages show a value.
[[nodiscard]] std::string to_toml(const SettingValue& value);

/// What a user may give: "4 to 16384", "half or float", "true or false", "text".
[[nodiscard]] std::string accepted(const Setting& setting);

}  // namespace rnmbake
