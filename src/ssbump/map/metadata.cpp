#include "ssbump/map/metadata.h"

#include "base/error.h"
#include "base/version.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <spdlog/fmt/fmt.h>

namespace rnmbake {
namespace {

constexpr std::string_view prefix = "rnmbake:";
constexpr const char* convention = "self-shadowed bump map";
constexpr std::array scales{SsbumpScale::third, SsbumpScale::ndotb, SsbumpScale::mod2x};
constexpr std::array hands{Handed::right, Handed::left};
constexpr std::array alpha_kinds{SsbumpAlpha::none, SsbumpAlpha::up, SsbumpAlpha::ao};

using Parts = std::vector<std::pair<std::string, std::string>>;

Parts parts_of(const SsbumpMetadata& metadata) {
  return {{"convention", convention},
          {"scale", name_of(metadata.scale)},
          {"handedness", name_of(metadata.handed)},
          {"alpha", name_of(metadata.alpha)},
          {"power", fmt::format("{}", metadata.power)},
          {"order", metadata.handed == Handed::right ? "right, upper left, lower left"
                                                     : "right, lower left, upper left"},
          {"flat", fmt::format("{:.6f}", flat_value(metadata.scale))},
          {"colour", "data"},
          {"method", metadata.method},
          {"settings", metadata.settings}};
}

/// "scale=third" of "...; scale=third; ..." for each part; what is no such pair is passed over.
std::map<std::string, std::string> parsed(std::string description) {
  std::erase(description, '\n');  // TGA breaks it after every 80 characters
  std::map<std::string, std::string> parts;
  for (std::size_t begin = 0; begin < description.size();) {
    const std::size_t end = std::min(description.find(';', begin), description.size());
    std::string_view part(&description[begin], end - begin);
    while (part.starts_with(' ')) part.remove_prefix(1);
    if (const auto equals = part.find('='); equals != std::string_view::npos)
      parts.emplace(part.substr(0, equals), part.substr(equals + 1));
    begin = end + 1;
  }
  return parts;
}

std::map<std::string, std::string> found_in(const std::map<std::string, Attribute>& attributes) {
  std::map<std::string, std::string> parts;
  const auto description = attributes.find("ImageDescription");
  if (description != attributes.end()) {
    if (const auto* text = std::get_if<std::string>(&description->second)) parts = parsed(*text);
  }
  for (const auto& [name, value] : attributes) {
    const auto* text = std::get_if<std::string>(&value);
    if (text != nullptr && name.starts_with(prefix)) parts[name.substr(prefix.size())] = *text;
  }
  return parts;
}

template <typename Value, std::size_t count>
std::optional<Value> named(const std::string& name, const std::array<Value, count>& values) {
  for (const Value value : values)
    if (name == name_of(value)) return value;
  return std::nullopt;
}

double number_of(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : NAN;
}

}  // namespace

float flat_value(SsbumpScale scale) {
  if (scale == SsbumpScale::third) return 1.0F / 3;
  const double n_dot_b = std::sqrt(1.0 / 3);
  return static_cast<float>(scale == SsbumpScale::ndotb ? n_dot_b : n_dot_b / 2);
}

const char* name_of(SsbumpScale scale) {
  return scale == SsbumpScale::third ? "third" : scale == SsbumpScale::ndotb ? "ndotb" : "mod2x";
}
const char* name_of(Handed handed) {
  return handed == Handed::right ? "right" : "left";
}
const char* name_of(SsbumpAlpha alpha) {
  return alpha == SsbumpAlpha::none ? "none" : alpha == SsbumpAlpha::up ? "up" : "ao";
}

std::optional<SsbumpScale> scale_named(const std::string& name) {
  return named(name, scales);
}
std::optional<Handed> handed_named(const std::string& name) {
  return named(name, hands);
}
std::optional<SsbumpAlpha> alpha_named(const std::string& name) {
  return named(name, alpha_kinds);
}

std::map<std::string, Attribute> attributes_of(const SsbumpMetadata& metadata) {
  std::map<std::string, Attribute> attributes;
  std::string description;
  for (const auto& [name, value] : parts_of(metadata)) {
    if (value.empty()) continue;
    attributes[std::string(prefix) + name] = value;
    description += fmt::format("{}{}={}", description.empty() ? "" : "; ", name, value);
  }
  attributes["ImageDescription"] = description;
  attributes["Software"] = std::string("rnmbake ") + version;
  return attributes;
}

std::optional<SsbumpMetadata> ssbump_metadata(const std::map<std::string, Attribute>& attributes,
                                              const std::string& file) {
  const auto parts = found_in(attributes);
  const auto part = [&](const char* name) {
    const auto found = parts.find(name);
    return found == parts.end() ? std::string() : found->second;
  };
  if (part("convention") != convention) return std::nullopt;
  const auto checked = [&]<typename Value>(const char* name, const std::optional<Value>& value) {
    if (!value) {
      fail(ExitCode::invalid_input, "{}: rnmbake:{} is '{}', which does not exist; make the map again", file,
           name, part(name));
    }
    return *value;
  };
  SsbumpMetadata metadata;
  metadata.scale = checked("scale", scale_named(part("scale")));
  metadata.handed = checked("handedness", handed_named(part("handedness")));
  metadata.alpha = checked("alpha", alpha_named(part("alpha")));
  const double power = number_of(part("power"));
  metadata.power = checked("power", power > 0 ? std::optional(power) : std::nullopt);
  metadata.method = part("method");
  metadata.settings = part("settings");
  return metadata;
}

}  // namespace rnmbake
