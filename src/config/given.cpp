#include "config/given.h"

#include "config/value.h"

#include <cstdlib>

namespace rnmbake {

EnvironmentLookup process_environment() {
  return [](const std::string& name) -> std::optional<std::string> {
    const char* text = std::getenv(name.c_str());
    return text == nullptr ? std::nullopt : std::optional<std::string>(text);
  };
}

std::vector<SettingOverride> read_environment(const EnvironmentLookup& environment) {
  std::vector<SettingOverride> given;
  for (const Setting& setting : settings()) {
    const std::string name = setting.environment();
    const auto text = environment(name);
    if (!text || text->empty()) continue;
    SettingOverride one{&setting, parse_value(setting, *text, name), SettingSource::environment, name};
    given.push_back(std::move(one));
  }
  return given;
}

}  // namespace rnmbake
