#include "encoding/fit/least_squares.h"

#include <limits>

#include <Eigen/Dense>

namespace rnmbake {

LeastSquares::LeastSquares(const std::vector<std::vector<double>>& values, std::size_t kept)
    : directions_(values.size()) {
  const auto rows = static_cast<Eigen::Index>(values.size());
  const auto columns = static_cast<Eigen::Index>(values[0].size());
  Eigen::MatrixXd functions(rows, columns);
  for (Eigen::Index k = 0; k < rows; ++k) {
    for (Eigen::Index i = 0; i < columns; ++i)
      functions(k, i) = values[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  }
  const auto singular = Eigen::JacobiSVD<Eigen::MatrixXd>(functions).singularValues();
  const double least = rows < columns ? 0 : singular(columns - 1);
  condition_ = least > 0 ? singular(0) / least : std::numeric_limits<double>::infinity();

  // x = x0 e_kept + Z y: x0 meets the kept value, Z spans what does not change it; y is then free.
  const Eigen::VectorXd met = functions.row(static_cast<Eigen::Index>(kept)).transpose();
  const Eigen::VectorXd x0 = met / met.squaredNorm();
  const Eigen::MatrixXd frame = Eigen::HouseholderQR<Eigen::MatrixXd>(met).householderQ();
  const Eigen::MatrixXd z = frame.rightCols(columns - 1);
  const Eigen::MatrixXd free = z * (functions * z).completeOrthogonalDecomposition().pseudoInverse();
  Eigen::MatrixXd solution = free;
  solution.col(static_cast<Eigen::Index>(kept)) += x0 - free * (functions * x0);
  for (Eigen::Index i = 0; i < columns; ++i)
    for (Eigen::Index k = 0; k < rows; ++k) matrix_.push_back(solution(i, k));
}

void LeastSquares::solve(std::span<const Vec3> values, std::span<Vec3> coefficients) const {
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    Vec3d sum(0);
    for (std::size_t k = 0; k < directions_; ++k) sum += Vec3d(values[k]) * matrix_[i * directions_ + k];
    coefficients[i] = Vec3(sum);
  }
}

}  // namespace rnmbake
