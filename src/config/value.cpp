#include "config/value.h"

#include "base/error.h"
#include "base/names.h"
#include "base/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include <spdlog/fmt/ranges.h>

namespace rnmbake {

namespace {

bool same_but_case(std::string_view a, std::string_view b) {
  return lower_case(std::string(a)) == lower_case(std::string(b));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <typename T>
std::optional<T> number(std::string_view text) {
  text = trimmed(text);
  T value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<bool> truth(std::string_view text) {
  static constexpr std::array<std::string_view, 4> yes{"true", "yes", "on", "1"};
  static constexpr std::array<std::string_view, 4> no{"false", "no", "off", "0"};
  const auto is = [&](std::string_view word) { return same_but_case(trimmed(text), word); };
  if (std::any_of(yes.begin(), yes.end(), is)) return true;
  if (std::any_of(no.begin(), no.end(), is)) return false;
  return std::nullopt;
}

std::vector<std::string> items(std::string_view text) {
  std::vector<std::string> list;
  while (!text.empty()) {
    const auto comma = std::min(text.find(','), text.size());
    if (const auto item = trimmed(text.substr(0, comma)); !item.empty()) list.emplace_back(item);
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return list;
}

[[noreturn]] void does_not_fit(const Setting& setting, std::string_view shown, const std::string& where) {
  fail(ExitCode::usage, "{}: {} does not fit '{}'; give {}", where, shown, setting.key, accepted(setting));
}

std::string choice_in(const Setting& setting, const std::string& text, const std::string& where) {
  for (const std::string_view choice : setting.choices) {
    if (same_but_case(choice, text)) return std::string(choice);
  }
  const std::vector<std::string> names(setting.choices.begin(), setting.choices.end());
  fail(ExitCode::usage, "{}: '{}' does not fit '{}'; give {}{}", where, text, setting.key, accepted(setting),
       did_you_mean(text, names));
}

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

/// The shortest text that reads back as the same number, with a point so that it stays a real.
std::string real_text(double value) {
  std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

/// "0.5%" for a setting in percent is 0.5.
std::string_view without_unit(const Setting& setting, std::string_view text) {
  const std::string_view rest = trimmed(text);
  return setting.unit == "percent" && rest.ends_with('%') ? rest.substr(0, rest.size() - 1) : text;
}

}  // namespace

SettingValue parse_value(const Setting& setting, std::string_view text, const std::string& where) {
  const auto take = [&](const auto& value) -> SettingValue {
    if (!value) does_not_fit(setting, fmt::format("'{}'", text), where);
    return *value;
  };
  switch (setting.kind) {
    case SettingKind::boolean:
      return take(truth(text));
    case SettingKind::integer:
      return checked(setting, take(number<std::int64_t>(text)), where);
    case SettingKind::real:
      return checked(setting, take(number<double>(without_unit(setting, text))), where);
    case SettingKind::text_list:
    case SettingKind::path_list:
      return items(text);
    case SettingKind::choice:
      return choice_in(setting, std::string(trimmed(text)), where);
    case SettingKind::text:
    case SettingKind::path:
    case SettingKind::program:
      break;
  }
  return std::string(text);
}

SettingValue checked(const Setting& setting, SettingValue value, const std::string& where) {
  const auto low = static_cast<double>(setting.low), high = static_cast<double>(setting.high);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    if (*whole < setting.low || *whole > setting.high) does_not_fit(setting, to_toml(value), where);
  } else if (const auto* real = std::get_if<double>(&value)) {
    if (!(*real >= low && *real <= high)) does_not_fit(setting, to_toml(value), where);  // NaN too
  } else if (setting.kind == SettingKind::choice) {
    return choice_in(setting, std::get<std::string>(value), where);
  }
  return value;
}

std::string to_toml(const SettingValue& value) {
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return real_text(*real);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_text(*text);
  std::vector<std::string> list;
  for (const std::string& item : std::get<std::vector<std::string>>(value)) list.push_back(toml_text(item));
  return fmt::format("[{}]", fmt::join(list, ", "));
}

std::string accepted(const Setting& setting) {
  switch (setting.kind) {
    case SettingKind::boolean:
      return "true or false";
    case SettingKind::integer:
      return fmt::format("a whole number from {} to {}", setting.low, setting.high);
    case SettingKind::real:
      return fmt::format("a number from {} to {}", setting.low, setting.high);
    case SettingKind::text:
      return "text";
    case SettingKind::text_list:
      return "a list of texts";
    case SettingKind::path_list:
      return "a list of paths";
    case SettingKind::path:
      return "a path";
    case SettingKind::program:
      return "a path or a name in PATH";
    case SettingKind::choice:
      break;
  }
  std::string all;
  for (std::size_t i = 0; i < setting.choices.size(); ++i) {
    if (i > 0) all += i + 1 == setting.choices.size() ? " or " : ", ";
    all += setting.choices[i];
  }
  return all;
}

}  // namespace rnmbake
