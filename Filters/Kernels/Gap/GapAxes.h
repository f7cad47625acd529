// Axes along which a gap lies, for tables of samples and for pairs of images.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace msi
{

// Normal equations are products of columns, of which the last is the residual. Squared residual after a change of the others.
double energyLeft(const Eigen::MatrixXd& normal, const Eigen::VectorXd& change);

// Shapley values of what the axes explain together. The first axis is the channel, the second the level.
// explained: by the axes whose bits are set. Where channel and level alone explain nearly all, contrast() is called and the axes
// are asked again: from then on the others are to leave out what is the same in all of their cells.
std::vector<double> shapleyOfAxes(std::size_t axes,
  const std::function<double(std::size_t subset)>& explained,
  const std::function<void()>& contrast);

// Energies sorted into named cells.
class GapCells
{
public:
  void add(const std::string& cell, double energy)
  {
    Energy[cell] += energy;
    Total += energy;
  }
  // The five largest, of the sum.
  std::vector<GapCell> worst() const;

private:
  std::map<std::string, double> Energy;
  double Total = 0.0;
};

// "level 0.1..0.25"
std::string rangeText(const std::string& what, double low, double high, int digits = 3);
// Of parts of equal width between two ends that in which a value lies.
struct GapPart
{
  GapPart(double value, double from, double to, int parts) noexcept;
  std::string text(const std::string& what, int digits = 3) const
  {
    return rangeText(what, low, high, digits);
  }

  double low, high;
};

// Energies in five parts of equal size, from small to large values. pairs: value and energy.
GapCells fifths(std::vector<std::pair<double, double>> pairs, const std::string& name);

// The axes with a share, the largest first.
std::vector<GapAxis> worthNaming(std::vector<GapAxis> axes);

// What is left unexplained, by the axes along which it lies.
GapRemainder remainderOf(double share, const std::vector<GapAxis>& axes);

} // namespace msi
