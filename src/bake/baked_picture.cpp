#include "bake/baked_picture.h"

#include "base/bytes.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace rnmbake {
namespace {

bool is_covered(const FloatImage& picture, std::size_t texel) {
  return picture.data()[4 * texel + 3] > 0.5F;
}

const FloatImage& any_half(const BakedPicture& picture) {
  return picture.samples[0] > 0 ? picture.halves[0] : picture.halves[1];
}

/// The mean of two pictures' colours, of which `other` has that share.
void blend(FloatImage& picture, const FloatImage& other, double share) {
  auto& values = picture.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 4 != 3) values[i] = float(double(values[i]) * (1 - share) + double(other.data()[i]) * share);
  }
}

struct PictureHead {
  std::int32_t width = 0, height = 0;
  HalfSamples samples{0, 0};
};

void put_picture(std::string& bytes, const BakedPicture& picture) {
  const FloatImage& any = any_half(picture);
  put(bytes, PictureHead{any.width(), any.height(), picture.samples});
  for (std::size_t first = 0; first < any.texels(); first += 8) {
    unsigned char covered = 0;
    for (std::size_t i = first; i < std::min(first + 8, any.texels()); ++i)
      covered |= static_cast<unsigned char>(is_covered(any, i) << (i - first));
    put(bytes, covered);
  }
  for (std::size_t half = 0; half < 2; ++half) {
    if (picture.samples[half] == 0) continue;
    const auto& data = picture.halves[half].data();
    for (std::size_t i = 0; i < any.texels(); ++i) {
      if (is_covered(any, i)) bytes.append(reinterpret_cast<const char*>(&data[4 * i]), 3 * sizeof(float));
    }
  }
}

bool take_picture(ByteReader& in, BakedPicture& picture) {
  PictureHead head;
  if (!in.take(head) || head.width < 0 || head.height < 0 || head.samples[0] < 0 || head.samples[1] < 0)
    return false;
  const std::size_t texels = std::size_t(head.width) * std::size_t(head.height);
  if (in.left() < (texels + 7) / 8) return false;
  std::vector<bool> covered(texels);
  for (std::size_t first = 0; first < texels; first += 8) {
    unsigned char bits = 0;
    if (!in.take(bits)) return false;
    for (std::size_t i = first; i < std::min(first + 8, texels); ++i)
      covered[i] = (bits >> (i - first) & 1) != 0;
  }
  picture.samples = head.samples;
  for (std::size_t half = 0; half < 2; ++half) {
    if (head.samples[half] == 0) continue;
    FloatImage& image = picture.halves[half] = FloatImage(head.width, head.height, 4);
    for (std::size_t i = 0; i < texels; ++i) {
      if (!covered[i]) continue;
      std::array<float, 3> color{};
      if (!in.take(color)) return false;
      std::copy(color.begin(), color.end(), &image.data()[4 * i]);
      image.data()[4 * i + 3] = 1;
    }
  }
  return true;
}

}  // namespace

void BakedPicture::add(int half, FloatImage pass, int count) {
  const auto h = std::size_t(half);
  const double all = samples[h] + count, share = count / all;
  if (samples[h] == 0) {
    halves[h] = std::move(pass);
  } else {
    blend(halves[h], pass, share);
  }
  samples[h] += count;
}

FloatImage BakedPicture::mean() const {
  FloatImage result = any_half(*this);
  if (!has_error()) return result;
  blend(result, halves[1], double(samples[1]) / all_samples());
  return result;
}

double BakedPicture::variance_factor() const {
  const double all = all_samples();
  return all > 0 ? double(samples[0]) * samples[1] / (all * all) : 0;
}

void NoiseSums::add(const BakedPicture& picture) {
  if (!picture.has_error()) return;
  const double factor = picture.variance_factor(), share = double(picture.samples[1]) / picture.all_samples();
  const auto &a = picture.halves[0].data(), &b = picture.halves[1].data();
  for (std::size_t texel = 0; texel < picture.halves[0].texels(); ++texel) {
    if (!is_covered(picture.halves[0], texel)) continue;
    for (std::size_t c = 4 * texel; c < 4 * texel + 3; ++c) {
      const double difference = double(a[c]) - b[c];
      squares += factor * difference * difference;
      values += double(a[c]) * (1 - share) + double(b[c]) * share;
      ++count;
    }
  }
}

double NoiseSums::relative() const {
  if (count == 0 || !(values > 0)) return 0;
  return std::sqrt(squares / double(count)) / (values / double(count));
}

std::string to_bytes(std::span<const BakedPicture> pictures) {
  std::string bytes;
  put(bytes, std::uint64_t(pictures.size()));
  for (const BakedPicture& picture : pictures) put_picture(bytes, picture);
  return bytes;
}

std::optional<std::vector<BakedPicture>> from_bytes(std::string_view bytes) {
  ByteReader in(bytes);
  std::uint64_t count = 0;
  if (!in.take(count) || count > bytes.size()) return std::nullopt;
  std::vector<BakedPicture> pictures(count);
  for (BakedPicture& picture : pictures) {
    if (!take_picture(in, picture)) return std::nullopt;
  }
  return in.left() == 0 ? std::optional(std::move(pictures)) : std::nullopt;
}

}  // namespace rnmbake
