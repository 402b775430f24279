#include "report/pack.h"

#include "base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <half.h>
#include <zlib.h>

namespace rnmbake {
namespace {

constexpr std::uint16_t not_anumber = 0x7e00;
constexpr int mantissa_bits = 10;
constexpr float largest_half = 65504;

/// Rounds to nearest; values beyond the largest half become the largest.
std::uint16_t half_bits(float value, int kept_bits) {
  if (std::isnan(value)) return not_anumber;
  const Imath::half exact(std::clamp(value, -largest_half, largest_half));
  const int dropped = mantissa_bits - kept_bits;
  if (dropped <= 0) return exact.bits();
  const auto mask = static_cast<std::uint16_t>(0xffffU << dropped);
  const auto rounded = static_cast<std::uint16_t>((exact.bits() + (1U << (dropped - 1))) & mask);
  return (rounded & 0x7c00U) == 0x7c00U ? static_cast<std::uint16_t>(exact.bits() & mask) : rounded;
}

void append_plane(const std::vector<std::uint16_t>& plane, std::string& bytes) {
  for (const std::uint16_t value : plane) bytes += static_cast<char>(value & 0xffU);
  for (const std::uint16_t value : plane) bytes += static_cast<char>(value >> 8U);
}

void append_picture(const PackedPicture& picture, std::string& bytes) {
  const FloatImage& image = *picture.image;
  const auto channels = static_cast<std::size_t>(image.channels());
  std::vector<std::uint16_t> first(image.texels()), plane(image.texels());
  for (std::size_t c = 0; c < channels; ++c) {
    for (std::size_t i = 0; i < image.texels(); ++i) {
      const std::uint16_t bits = half_bits(image.data()[i * channels + c], picture.kept_bits);
      plane[i] = static_cast<std::uint16_t>(c == 0 ? bits : bits - first[i]);
    }
    append_plane(plane, bytes);
    if (c == 0) first = plane;
  }
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), 6);
  if (result != Z_OK) fail(ExitCode::io, "cannot compress a picture of the report: zlib error {}", result);
  out.resize(size);
  return out;
}

}  // namespace

std::string base64(std::string_view bytes) {
  static constexpr std::string_view letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[three >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

std::string pack(const std::vector<PackedPicture>& pictures) {
  std::string bytes;
  for (const PackedPicture& picture : pictures) append_picture(picture, bytes);
  return base64(compressed(bytes));
}

}  // namespace rnmbake
