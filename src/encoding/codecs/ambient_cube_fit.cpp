#include "encoding/codecs/ambient_cube_fit.h"

#include <cmath>

#include <Eigen/Dense>

namespace rnmbake {

AmbientCube fit_ambient_cube(std::span<const Vec3> normals, std::span<const Vec3> values,
                             std::span<const float> weights) {
  Eigen::Matrix<double, 6, 6> squares = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 3> sums = Eigen::Matrix<double, 6, 3>::Zero();
  for (std::size_t i = 0; i < normals.size(); ++i) {
    Eigen::Matrix<double, 6, 1> functions = Eigen::Matrix<double, 6, 1>::Zero();
    for (int axis = 0; axis < 3; ++axis)
      functions[2 * axis + (normals[i][axis] < 0 ? 1 : 0)] = double(normals[i][axis]) * normals[i][axis];
    const double weight = weights.empty() ? 1 : double(weights[i]);
    squares += weight * functions * functions.transpose();
    sums += weight * functions * Eigen::RowVector3d(values[i].x, values[i].y, values[i].z);
  }
  // Of the solutions, where sides are not determined, the one of least norm.
  const Eigen::Matrix<double, 6, 3> solution = squares.completeOrthogonalDecomposition().solve(sums);
  AmbientCube cube;
  for (int side = 0; side < 6; ++side)
    cube[std::size_t(side)] =
        Vec3(float(solution(side, 0)), float(solution(side, 1)), float(solution(side, 2)));
  return cube;
}

AmbientCube face_means(const DistantLight& light) {
  constexpr float area = 4;  // of a face at distance 1
  AmbientCube cube;
  cube.fill(Vec3(0));
  for (std::size_t i = 0; i < light.directions.size(); ++i) {
    const Vec3 d = light.directions[i], size(std::abs(d.x), std::abs(d.y), std::abs(d.z));
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    // A source is radiance times solid angle over pi; on the face it covers the solid angle over its cosine
    // cubed.
    const float to_area = static_cast<float>(pi) / (size[axis] * size[axis] * size[axis] * area);
    cube[2 * static_cast<std::size_t>(axis) + (d[axis] < 0 ? 1 : 0)] += light.powers[i] * to_area;
  }
  return cube;
}

}  // namespace rnmbake
