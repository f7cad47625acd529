// The map between two views of a plane.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <vector>

namespace msi
{

// y ~ H x for points in homogeneous coordinates, H(2, 2) = 1 or as close to it as the scale allows.
//
// Direct linear transform on normalized points (R. Hartley and A. Zisserman, "Multiple View Geometry", 2nd edition,
// algorithm 4.2): the points of each side are moved to their mean and scaled to a mean distance of sqrt(2).
// Errors: std::invalid_argument unless there are as many points on both sides, at least 4, and not all on one line.
Eigen::Matrix3d fitHomography(
  const std::vector<Eigen::Vector2d>& from, const std::vector<Eigen::Vector2d>& to);

inline Eigen::Vector2d mapPoint(const Eigen::Matrix3d& homography, const Eigen::Vector2d& point)
{
  return (homography * point.homogeneous()).hnormalized();
}

} // namespace msi
