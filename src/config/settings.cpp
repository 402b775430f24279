#include "config/settings.h"

#include "config/settings_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace rnmbake {

namespace {

std::string with_dashes(std::string_view key) {
  std::string text(key);
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

}  // namespace

std::string Setting::flag() const {
  return key == "dir" ? "--output" : "--" + with_dashes(key);
}

std::string Setting::flag_names() const {
  if (key == "dir") return "-o,--output";
  return kind == SettingKind::boolean ? flag() + ",!--no-" + with_dashes(key) : flag();
}

std::string Setting::environment() const {
  std::string name = "RNMBAKE_";
  for (const char c : key) name += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

bool Setting::serves(Purpose purpose) const {
  return purposes.empty() || std::find(purposes.begin(), purposes.end(), purpose) != purposes.end();
}

SettingValue Setting::default_value() const {
  return slot.get(BakeSettings{});
}

const std::vector<Setting>& settings() {
  static const std::vector<Setting> table = make_settings_table();
  return table;
}

std::span<const SettingTable> setting_tables() {
  static constexpr std::array<SettingTable, 5> tables{{
      {"scene", "What is baked"},
      {"bake", "How it is baked"},
      {"reference", "How the reference is traced"},
      {"output", "What is written"},
      {"run", "How Blender is run"},
  }};
  return tables;
}

const Setting* find_setting(std::string_view key) {
  for (const Setting& setting : settings()) {
    if (setting.key == key) return &setting;
  }
  return nullptr;
}

}  // namespace rnmbake
