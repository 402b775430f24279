#include "encoding/codecs/ambient_cube_fit.h"

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

}  // namespace rnmbake
