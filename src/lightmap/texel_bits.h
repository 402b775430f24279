// lightmap/texel_bits.h - yes or no for each texel of a rectangle, 64 of them in a word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rnmbake {

/// Row by row from the top; bit x % 64 of word x / 64 is texel x. Bits past the width are 0.
class TexelBits {
 public:
  TexelBits() = default;

  /// All texels are "no".
  TexelBits(int width, int height)
      : width_(width),
        height_(height),
        stride_((static_cast<std::size_t>(width) + 63) / 64),
        words_(stride_ * static_cast<std::size_t>(height)) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

  [[nodiscard]] bool at(int x, int y) const { return (row(y)[x / 64] >> (x % 64) & 1) != 0; }
  void set(int x, int y) { words_[stride_ * y + x / 64] |= std::uint64_t{1} << (x % 64); }

  /// Texels that are "yes".
  [[nodiscard]] std::size_t count() const;

  bool operator==(const TexelBits&) const = default;

 private:
  [[nodiscard]] const std::uint64_t* row(int y) const { return &words_[stride_ * y]; }

  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint64_t> words_;
};

/// A rectangle larger by `texels` on each of its sides: those at most `texels` away from one of `bits`, along
/// either axis, which are those that dilate() fills in as many passes, and these themselves.
[[nodiscard]] TexelBits grown(const TexelBits& bits, int texels);

}  // namespace rnmbake
