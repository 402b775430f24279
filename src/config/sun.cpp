#include "config/sun.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

namespace rnmbake {

std::optional<Sun> sun_of(const std::string& text) {
  std::array<double, 3> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::from_chars_result read = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == numbers.size();
    if (read.ec != std::errc() || !std::isfinite(numbers[i])) return std::nullopt;
    if (last ? read.ptr != end : read.ptr == end || *read.ptr != ',') return std::nullopt;
    at = read.ptr + 1;
  }
  const auto [azimuth, elevation, strength] = numbers;
  if (std::abs(azimuth) > 360 || std::abs(elevation) > 90 || strength <= 0) return std::nullopt;
  return Sun{azimuth, elevation, strength};
}

}  // namespace rnmbake
