#include "ssbump/map/encode.h"

#include "ssbump/map/weights.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace rnmbake {
namespace {

/// Places of right, upper left and lower left in the file.
std::array<std::size_t, 3> places(Handed handed) {
  return handed == Handed::right ? std::array<std::size_t, 3>{0, 1, 2} : std::array<std::size_t, 3>{0, 2, 1};
}

std::size_t alpha_channel(SsbumpAlpha alpha) {
  return alpha == SsbumpAlpha::up ? SsbumpWeights::up : SsbumpWeights::ambient;
}

/// An integer hash with full avalanche, as share of 1 (24 bits).
float chance(std::uint32_t seed, std::uint32_t x, std::uint32_t y, std::uint32_t channel) {
  std::uint32_t h = seed * 0x9E3779B9U + x * 0x85EBCA6BU + y * 0xC2B2AE35U + channel * 0x27D4EB2FU;
  h = (h ^ (h >> 16)) * 0x7FEB352DU;
  h = (h ^ (h >> 15)) * 0x846CA68BU;
  h ^= h >> 16;
  return static_cast<float>(h >> 8) * 0x1p-24F;
}

float dithered(float value, float steps, float chance) {
  const float wanted = std::clamp(value, 0.0F, 1.0F) * steps, nearest = std::nearbyint(wanted);
  constexpr float on_step = 1e-3F;  // what 1/3 as a float is beside 85/255
  const float step = std::abs(wanted - nearest) < on_step ? nearest : std::floor(wanted + chance);
  return std::min(step, steps) / steps;
}

}  // namespace

FloatImage encode(const FloatImage& weights, const SsbumpEncoding& encoding) {
  assert(weights.channels() == SsbumpWeights::channels);
  const bool has_alpha = encoding.alpha != SsbumpAlpha::none;
  const std::size_t alpha = encoding.alpha == SsbumpAlpha::up ? SsbumpWeights::up : SsbumpWeights::ambient;
  const float flat = flat_value(encoding.scale);
  const auto place = places(encoding.handed);
  FloatImage stored(weights.width(), weights.height(), has_alpha ? 4 : 3);
  const float* from = weights.data().data();
  for (float* to = stored.data().data(); to != stored.data().data() + stored.data().size();
       to += stored.channels(), from += SsbumpWeights::channels) {
    for (std::size_t i = 0; i < 3; ++i) to[place[i]] = flat * from[i];
    if (has_alpha) to[3] = from[alpha];
  }
  return stored;
}

FloatImage decode_weights(const FloatImage& stored, const SsbumpEncoding& encoding) {
  const bool has_alpha = encoding.alpha != SsbumpAlpha::none;
  assert(stored.channels() >= (has_alpha ? 4 : 3));
  const std::size_t alpha = alpha_channel(encoding.alpha);
  const float scale = 1 / flat_value(encoding.scale);
  const auto place = places(encoding.handed);
  FloatImage weights(stored.width(), stored.height(), SsbumpWeights::channels);
  const float* from = stored.data().data();
  for (float* to = weights.data().data(); to != weights.data().data() + weights.data().size();
       to += SsbumpWeights::channels, from += stored.channels()) {
    for (std::size_t i = 0; i < 3; ++i) to[i] = scale * from[place[i]];
    to[SsbumpWeights::up] = to[SsbumpWeights::ambient] = 1;
    if (has_alpha) to[alpha] = from[3];
  }
  return weights;
}

void dither(FloatImage& rows, Storage storage, std::uint32_t seed, int first_row) {
  if (storage != Storage::u8 && storage != Storage::u16) return;
  const float steps = storage == Storage::u8 ? 255 : 65535;
  for (int y = 0; y < rows.height(); ++y) {
    for (int x = 0; x < rows.width(); ++x) {
      std::uint32_t channel = 0;
      for (float& value : rows.texel(x, y)) {
        value = dithered(value, steps,
                         chance(seed, static_cast<std::uint32_t>(x),
                                static_cast<std::uint32_t>(first_row + y), channel++));
      }
    }
  }
}

}  // namespace rnmbake
