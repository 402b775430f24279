// encoding/sh_rotation.h - spherical harmonics as seen from another space.
#pragma once

#include "encoding/texel_frame.h"

#include <array>
#include <span>

namespace rnmbake {

/// Coefficients of encoding/sh.h, of three bands, turned from tangent space to that of the frame: band 1 as a
/// vector, band 2 as the symmetric, traceless matrix M whose n^T M n it is.
inline void rotate_sh3(std::span<Vec3> sh, const TexelFrame& frame) {
  constexpr double y2 = 1.09254843, y20 = 0.31539157;
  const std::array<Vec3d, 3> axes{Vec3d(frame.tangent), Vec3d(frame.bitangent), Vec3d(frame.normal)};
  for (int c = 0; c < 3; ++c) {
    const Vec3d vector = frame.stored(Vec3d(sh[3][c], sh[1][c], sh[2][c]));
    const double mean = y20 * sh[6][c], half = y2 / 2;
    const double m[3][3] = {{half * sh[8][c] - mean, half * sh[4][c], half * sh[7][c]},
                            {half * sh[4][c], -half * sh[8][c] - mean, half * sh[5][c]},
                            {half * sh[7][c], half * sh[5][c], 2 * mean}};
    const auto turned = [&](int row, int column) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) sum += axes[i][row] * m[i][j] * axes[j][column];
      return sum;
    };
    const std::array<double, 8> found{vector.y,
                                      vector.z,
                                      vector.x,
                                      turned(0, 1) / half,
                                      turned(1, 2) / half,
                                      turned(2, 2) / (2 * y20),
                                      turned(0, 2) / half,
                                      (turned(0, 0) - turned(1, 1)) / y2};
    for (std::size_t i = 0; i < found.size(); ++i) sh[i + 1][c] = static_cast<float>(found[i]);
  }
}

}  // namespace rnmbake
