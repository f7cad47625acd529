#include "Kernels/Numerics/Lbfgs.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace msi
{

namespace
{
struct Correction
{
  Eigen::VectorXd step;
  Eigen::VectorXd gradientChange;
  double inverseCurvature;
};

constexpr std::size_t Memory = 12;
constexpr double SufficientDecrease = 1e-4;
constexpr double Curvature = 0.9;
constexpr int SearchLimit = 30;

Eigen::VectorXd descentDirection(
  const std::deque<Correction>& corrections, const Eigen::VectorXd& gradient)
{
  Eigen::VectorXd direction = -gradient;
  if (corrections.empty())
  {
    // The first step is at most of unit length: one unit of a log hyperparameter.
    return direction / std::max(1.0, direction.norm());
  }
  std::vector<double> weights(corrections.size());
  for (std::size_t i = corrections.size(); i-- > 0;)
  {
    weights[i] = corrections[i].inverseCurvature * corrections[i].step.dot(direction);
    direction -= weights[i] * corrections[i].gradientChange;
  }
  const Correction& last = corrections.back();
  direction /= last.inverseCurvature * last.gradientChange.squaredNorm();
  for (std::size_t i = 0; i < corrections.size(); ++i)
  {
    const double weight =
      corrections[i].inverseCurvature * corrections[i].gradientChange.dot(direction);
    direction += (weights[i] - weight) * corrections[i].step;
  }
  return direction;
}

struct Point
{
  Eigen::VectorXd at;
  Eigen::VectorXd gradient;
  double value;
};

std::optional<Point> searchAlong(
  const DifferentiableFunction& function, const Point& from, const Eigen::VectorXd& direction)
{
  const double slope = from.gradient.dot(direction);
  double lower = 0.0;
  double upper = std::numeric_limits<double>::infinity();
  double length = 1.0;
  std::optional<Point> best;
  for (int trial = 0; trial < SearchLimit; ++trial)
  {
    Point next{ from.at + length * direction, Eigen::VectorXd(from.at.size()), 0.0 };
    next.value = function(next.at, next.gradient);
    if (!(next.value <= from.value + SufficientDecrease * length * slope) ||
      !next.gradient.allFinite())
    {
      upper = length;
    }
    else
    {
      best = next;
      if (next.gradient.dot(direction) >= Curvature * slope)
      {
        break;
      }
      lower = length;
    }
    length = std::isfinite(upper) ? 0.5 * (lower + upper) : 2.0 * length;
  }
  return best;
}
}

LbfgsResult minimizeLbfgs(
  const DifferentiableFunction& function, const Eigen::VectorXd& start, const LbfgsOptions& options)
{
  Point current{ start, Eigen::VectorXd(start.size()), 0.0 };
  current.value = function(current.at, current.gradient);
  LbfgsResult result{ start, current.value };
  if (!std::isfinite(current.value))
  {
    return result; // the gradient was not written
  }
  std::deque<Correction> corrections;
  while (result.iterations < options.maximumIterations && !result.converged)
  {
    if (current.gradient.cwiseAbs().maxCoeff() < options.gradientNorm)
    {
      result.converged = true;
      break;
    }
    Eigen::VectorXd direction = descentDirection(corrections, current.gradient);
    if (!(direction.dot(current.gradient) < 0.0))
    {
      corrections.clear();
      direction = descentDirection(corrections, current.gradient);
    }
    const std::optional<Point> next = searchAlong(function, current, direction);
    if (!next)
    {
      if (corrections.empty())
      {
        break;
      }
      corrections.clear(); // once more along the gradient
      continue;
    }
    const Eigen::VectorXd step = next->at - current.at;
    const Eigen::VectorXd gradientChange = next->gradient - current.gradient;
    const double curvature = step.dot(gradientChange);
    if (curvature > 1e-12 * step.norm() * gradientChange.norm())
    {
      corrections.push_back({ step, gradientChange, 1.0 / curvature });
      if (corrections.size() > Memory)
      {
        corrections.pop_front();
      }
    }
    result.converged =
      current.value - next->value < options.relativeDecrease * std::max(1.0, std::abs(next->value));
    current = *next;
    ++result.iterations;
  }
  result.at = current.at;
  result.value = current.value;
  return result;
}

} // namespace msi
