#include "Kernels/Sampling/Homography.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <cmath>
#include <stdexcept>
#include <string>

namespace msi
{

namespace
{
constexpr double LeastSpread = 1e-12;

// To mean 0 and mean distance sqrt(2).
Eigen::Matrix3d normalization(const std::vector<Eigen::Vector2d>& points)
{
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& point : points)
  {
    mean += point;
  }
  mean /= static_cast<double>(points.size());
  double distance = 0.0;
  for (const auto& point : points)
  {
    distance += (point - mean).norm();
  }
  distance /= static_cast<double>(points.size());
  if (!(distance > LeastSpread) || !std::isfinite(distance))
  {
    throw std::invalid_argument("the points of a homography lie on one another");
  }
  const double scale = std::sqrt(2.0) / distance;
  Eigen::Matrix3d transform = Eigen::Matrix3d::Identity();
  transform(0, 0) = transform(1, 1) = scale;
  transform.topRightCorner<2, 1>() = -scale * mean;
  return transform;
}
}

Eigen::Matrix3d fitHomography(
  const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to)
{
  constexpr std::size_t Least = 4;
  if (from.size() != to.size() || from.size() < Least)
  {
    throw std::invalid_argument("a homography between " + std::to_string(from.size()) + " and " +
      std::to_string(to.size()) + " points; expected the same number, at least 4");
  }
  const Eigen::Matrix3d a = normalization(from);
  const Eigen::Matrix3d b = normalization(to);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const Eigen::Vector3d x = a * from[i].homogeneous();
    const Eigen::Vector2d y = (b * to[i].homogeneous()).hnormalized();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = x.transpose();
    rows.block<1, 3>(0, 6) = -y.x() * x.transpose();
    rows.block<1, 3>(1, 3) = x.transpose();
    rows.block<1, 3>(1, 6) = -y.y() * x.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::JacobiSVD<Eigen::Matrix<double, 9, 9>> svd(normal, Eigen::ComputeFullV);
  const auto& sizes = svd.singularValues();
  if (!(sizes[7] > LeastSpread * sizes[0]))
  {
    throw std::invalid_argument("the points of a homography lie on one line");
  }
  const Eigen::Matrix<double, 9, 1> solution = svd.matrixV().col(8);
  Eigen::Matrix3d map;
  map << solution.head<3>().transpose(), solution.segment<3>(3).transpose(),
    solution.tail<3>().transpose();
  map = b.inverse() * map * a;
  return std::abs(map(2, 2)) > LeastSpread ? Eigen::Matrix3d(map / map(2, 2)) : map;
}

} // namespace msi
