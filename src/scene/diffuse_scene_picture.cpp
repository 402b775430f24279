#include "scene/diffuse_scene_parts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <half.h>

namespace rnmbake {
namespace {

using nlohmann::json;

// As Blender turns bytes into numbers, so that its 8-bit pictures come through unchanged.
constexpr float byte_step = 1.0F / 255;

constexpr std::size_t largest_side = 1 << 16;

float linear_from_srgb(float value) {
  return value <= 0.04045F ? value / 12.92F : std::pow((value + 0.055F) / 1.055F, 2.4F);
}

/// Texels of one of the three forms, each channel through `number`.
template <typename T, typename Number>
void read_texels(const json& entry, Blob& data, const Owner& owner, Texture& picture, Number number) {
  const std::size_t count = std::size_t(picture.width) * picture.height;
  const std::vector<T> values = data.cut<T>(entry, "offset", 3 * count, owner);
  picture.texels.resize(count);
  for (std::size_t i = 0; i < count; ++i)
    picture.texels[i] = Vec3(number(values[3 * i]), number(values[3 * i + 1]), number(values[3 * i + 2]));
}

void check_texels(const Texture& picture, const Owner& owner) {
  const auto bad = std::find_if_not(picture.texels.begin(), picture.texels.end(), [](const Vec3& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
  });
  if (bad == picture.texels.end()) return;
  const auto place = static_cast<int>(bad - picture.texels.begin());
  fail(ExitCode::invalid_input,
       "{}texel ({}, {}) is ({}, {}, {}); mend the picture, or the nodes that make it", owner(),
       place % picture.width, place / picture.width, bad->x, bad->y, bad->z);
}

std::optional<float> as_byte(float value) {
  if (!(value >= 0 && value <= 1)) return std::nullopt;
  const float byte = std::round(value * 255);
  return byte * byte_step == value ? std::optional(byte) : std::nullopt;
}

bool fits_half(float value) {
  return std::abs(value) <= HALF_MAX && float(half(value)) == value;
}

template <typename Test>
bool every_channel(const Texture& picture, Test test) {
  return std::all_of(picture.texels.begin(), picture.texels.end(),
                     [&](const Vec3& c) { return test(c.x) && test(c.y) && test(c.z); });
}

template <typename T, typename Code>
void append_texels(const Texture& picture, std::string& data, Code code) {
  std::vector<T> values;
  values.reserve(3 * picture.texels.size());
  for (const Vec3& c : picture.texels) {
    for (const float value : {c.x, c.y, c.z}) values.push_back(code(value));
  }
  data.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

}  // namespace

Texture parse_picture(const json& entry, Blob& data) {
  const auto name = entry.at("name").get<std::string>();
  const Owner owner = [&] { return "picture '" + name + "': "; };
  const std::size_t width = count_at(entry, "width"), height = count_at(entry, "height");
  if (width < 1 || height < 1 || width > largest_side || height > largest_side) {
    fail(ExitCode::invalid_input, "{}its size is {} x {}; a side has 1 to {} texels", owner(), width, height,
         largest_side);
  }
  Texture picture{static_cast<int>(width), static_cast<int>(height), {}, name};
  const auto form = entry.at("form").get<std::string>();
  if (form == "u8") {
    read_texels<std::uint8_t>(entry, data, owner, picture, [](std::uint8_t v) { return v * byte_step; });
  } else if (form == "f16") {
    read_texels<std::uint16_t>(entry, data, owner, picture, [](std::uint16_t bits) {
      half value;
      value.setBits(bits);
      return float(value);
    });
  } else if (form == "f32") {
    read_texels<float>(entry, data, owner, picture, [](float v) { return v; });
  } else {
    fail(ExitCode::invalid_input, "{}its form is '{}'; known are u8, f16 and f32", owner(), form);
  }
  if (entry.value("srgb", false)) {
    for (Vec3& c : picture.texels)
      c = Vec3(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z));
  }
  check_texels(picture, owner);
  return picture;
}

json store_picture(const Texture& picture, std::string& data) {
  json entry{
      {"name", picture.name}, {"width", picture.width}, {"height", picture.height}, {"offset", data.size()}};
  if (every_channel(picture, [](float v) { return as_byte(v).has_value(); })) {
    entry["form"] = "u8";
    append_texels<std::uint8_t>(picture, data, [](float v) { return std::uint8_t(*as_byte(v)); });
  } else if (every_channel(picture, fits_half)) {
    entry["form"] = "f16";
    append_texels<std::uint16_t>(picture, data, [](float v) { return half(v).bits(); });
  } else {
    entry["form"] = "f32";
    append_texels<float>(picture, data, [](float v) { return v; });
  }
  return entry;
}

}  // namespace rnmbake
