// Numbers that no instrument gives: marks for missing values, and what a wrong unit makes.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>

namespace msi
{

struct ImpossibleValue
{
  Eigen::Index row = 0;    // band or channel, counted from 0
  Eigen::Index column = 0; // sample or reading, counted from 0
  double value = 0.0;
  std::string expected; // "-1 to 100, where 1 is the perfect white"
};

// The first reflectance factor below -1 or above 100, column by column: noise reaches neither. Values that are not
// finite are passed over; they have checks of their own.
std::optional<ImpossibleValue> findImpossibleReflectance(const Eigen::MatrixXd& reflectance);

// The first camera response that is one of the usual marks for missing values (-9999, -999, -99999, -32768, or beyond
// 1e30), or lies far outside of all others: below -10 or above 1000 times the median of their sizes, which counts as
// at least 1. So counts and values relative to white are both possible, and the noise of a dark frame is.
std::optional<ImpossibleValue> findImpossibleResponse(const Eigen::MatrixXd& response);

// Of the channels' largest sizes, the median. One value per channel in a column.
double typicalLevel(const Eigen::MatrixXd& response);
// Responses relative to white have a typical level up to this; above it they are counts.
constexpr double LargestRelativeLevel = 2.0;

// Throw std::invalid_argument for the first such value: "NAME sample 3, band 2 is -9999; expected ...".
void requirePossibleReflectance(const Eigen::MatrixXd& reflectance, const std::string& name);
void requirePossibleResponse(const Eigen::MatrixXd& response, const std::string& name);

} // namespace msi
