#include "config/document.h"

#include "config/value.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

constexpr std::size_t comment_column = 40;

std::string line(std::string_view key, const SettingValue& value, std::string_view comment) {
  const std::string assignment = fmt::format("{} = {}", key, to_toml(value));
  return fmt::format("{:<{}} # {}\n", assignment, comment_column, comment);
}

std::string print_override(const ResolvedConfig& config, const ObjectOverride& override_) {
  std::string text = fmt::format("\n{:<{}} # {}\n", "[[override]]", comment_column, override_.where);
  text += fmt::format("objects = {}\n", to_toml(override_.objects));
  for (const SettingOverride& given : override_.values) {
    const Setting& setting = *given.setting;
    const std::string comment = config.fixed_for_all(setting) ? fmt::format("{}, but {} wins", given.where,
                                                                            config.provenance(setting.key))
                                                              : given.where;
    text += line(setting.key, given.value, comment);
  }
  return text;
}

std::string range_text(const Setting& setting) {
  switch (setting.kind) {
    case SettingKind::boolean:
      return "true, false";
    case SettingKind::integer:
    case SettingKind::real:
      return fmt::format("{} to {}", setting.low, setting.high);
    case SettingKind::choice:
      return fmt::format("{}", fmt::join(setting.choices, ", "));
    case SettingKind::text:
      return "text";
    case SettingKind::text_list:
      return "list of texts";
    case SettingKind::path_list:
      return "list of paths";
    case SettingKind::path:
      return "path";
    case SettingKind::program:
      break;
  }
  return "path or name";
}

bool is_numeric(const Setting& setting) {
  return setting.kind == SettingKind::integer || setting.kind == SettingKind::real;
}

/// "0: off", "": the active-render layer".
std::string meaning(const Setting& setting) {
  if (setting.empty_means.empty()) return "";
  const std::string_view empty = setting.is_list() ? "[]" : "\"\"";
  return fmt::format("`{}`: {}", is_numeric(setting) ? "0" : empty, setting.empty_means);
}

std::string markdown_row(const Setting& setting) {
  std::string help(setting.help);
  if (const std::string special = meaning(setting); !special.empty()) help += "; " + special;
  std::string range = range_text(setting);
  if (!setting.unit.empty()) range += fmt::format(" ({})", setting.unit);
  return fmt::format("| `{}` | {} | `{}` | {} | {} | `{}` |\n", setting.key, range,
                     to_toml(setting.default_value()), setting.per_object ? "yes" : "", help,
                     setting.flag() + (setting.key == "dir" ? "`, `-o" : ""));
}

/// A default as a shell user would type it; "" where the empty value needs no mention.
std::string plain_default(const Setting& setting) {
  const SettingValue value = setting.default_value();
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* list = std::get_if<std::vector<std::string>>(&value)) {
    return fmt::format("{}", fmt::join(*list, ","));
  }
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{}", *real);
  return std::get_if<bool>(&value) != nullptr && !std::get<bool>(value) ? "" : to_toml(value);
}

}  // namespace

std::string print_config(const ResolvedConfig& config, Purpose purpose) {
  std::string text;
  for (const SettingTable& table : setting_tables()) {
    std::string lines;
    for (const SettingOverride& given : config.values()) {
      if (given.setting->table == table.name && given.setting->serves(purpose))
        lines += line(given.setting->key, given.value, given.where);
    }
    if (!lines.empty()) text += fmt::format("{}[{}]\n{}", text.empty() ? "" : "\n", table.name, lines);
  }
  for (const ObjectOverride& override_ : config.overrides()) text += print_override(config, override_);
  return text;
}

std::string settings_reference() {
  std::string text;
  for (const SettingTable& table : setting_tables()) {
    text += fmt::format("{}### [{}]: {}\n\n", text.empty() ? "" : "\n", table.name, table.help);
    text += "| key | values | default | per object | meaning | flag |\n|---|---|---|---|---|---|\n";
    for (const Setting& setting : settings()) {
      if (setting.table == table.name) text += markdown_row(setting);
    }
  }
  return text;
}

std::string help_text(const Setting& setting) {
  std::vector<std::string> notes;
  if (is_numeric(setting)) notes.push_back(range_text(setting));
  if (!setting.unit.empty() && is_numeric(setting)) notes.back() += fmt::format(" {}", setting.unit);
  if (setting.kind == SettingKind::choice) notes.push_back(range_text(setting));
  const std::string usual = plain_default(setting);
  const std::string special = setting.empty_means.empty() ? "" : std::string(setting.empty_means);
  if (!usual.empty() && usual != "0") {
    notes.push_back(fmt::format("default {}", usual));
  } else if (!special.empty()) {
    notes.push_back(fmt::format("default: {}", special));
  } else if (usual == "0") {
    notes.emplace_back("default 0");
  }
  std::string text(setting.help);
  if (!notes.empty()) text += fmt::format(" ({})", fmt::join(notes, "; "));
  return text;
}

}  // namespace rnmbake
