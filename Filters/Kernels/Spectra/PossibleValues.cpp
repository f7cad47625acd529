#include "Kernels/Spectra/PossibleValues.h"

#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

namespace msi
{

namespace
{
constexpr double LeastReflectance = -1.0;
constexpr double MostReflectance = 100.0;
constexpr double LeastResponse = -10.0; // times the median size
constexpr double MostResponse = 1000.0; // times the median size
constexpr double LargestNumber = 1e30;
constexpr std::array<double, 4> MissingMarks = { -9999.0, -999.0, -99999.0, -32768.0 };
const char* const Remedy = "; remove the sample if this marks a missing value";

// The median of the sizes of all finite values, at least 1.
double typicalSize(const Eigen::MatrixXd& values)
{
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values.reshaped())
  {
    if (std::isfinite(value))
    {
      sizes.push_back(std::abs(value));
    }
  }
  if (sizes.empty())
  {
    return 1.0;
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(1.0, *middle);
}

template <typename IsImpossible>
std::optional<ImpossibleValue> findFirst(
  const Eigen::MatrixXd& values, const std::string& expected, const IsImpossible& isImpossible)
{
  for (Eigen::Index column = 0; column < values.cols(); ++column)
  {
    for (Eigen::Index row = 0; row < values.rows(); ++row)
    {
      if (isImpossible(values(row, column)))
      {
        return ImpossibleValue{ row, column, values(row, column), expected };
      }
    }
  }
  return std::nullopt;
}

void requireNone(
  const std::optional<ImpossibleValue>& found, const std::string& name, const char* row)
{
  if (found)
  {
    reject(name, " sample ", found->column + 1, ", ", row, " ", found->row + 1, " is ",
      found->value, "; expected ", found->expected, Remedy);
  }
}
}

std::optional<ImpossibleValue> findImpossibleReflectance(const Eigen::MatrixXd& reflectance)
{
  return findFirst(reflectance, "-1 to 100, where 1 is the perfect white",
    [](double value)
    { return std::isfinite(value) && (value < LeastReflectance || value > MostReflectance); });
}

std::optional<ImpossibleValue> findImpossibleResponse(const Eigen::MatrixXd& response)
{
  const double typical = typicalSize(response);
  std::ostringstream expected;
  expected << LeastResponse * typical << " to " << MostResponse * typical
           << ", as the other responses are";
  return findFirst(response, expected.str(),
    [typical](double value)
    {
      return std::isfinite(value) &&
        (std::find(MissingMarks.begin(), MissingMarks.end(), value) != MissingMarks.end() ||
          std::abs(value) >= LargestNumber || value < LeastResponse * typical ||
          value > MostResponse * typical);
    });
}

double typicalLevel(const Eigen::MatrixXd& response)
{
  Eigen::VectorXd largest = response.cwiseAbs().rowwise().maxCoeff();
  const auto middle = largest.begin() + largest.size() / 2;
  std::nth_element(largest.begin(), middle, largest.end());
  return *middle;
}

void requirePossibleReflectance(const Eigen::MatrixXd& reflectance, const std::string& name)
{
  requireNone(findImpossibleReflectance(reflectance), name, "reflectance band");
}

void requirePossibleResponse(const Eigen::MatrixXd& response, const std::string& name)
{
  requireNone(findImpossibleResponse(response), name, "response channel");
}

} // namespace msi
