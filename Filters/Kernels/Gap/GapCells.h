// Energies sorted into named cells.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace msi
{

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

// "x -1..-0.33", ..
std::string thirdOfField(double value, const char* axis);
std::string rounded(double value);
// "level 0.1..0.25"
std::string rangeText(const std::string& what, double low, double high);

// Energies in five parts of equal size, from small to large values. pairs: value and energy.
GapCells fifths(std::vector<std::pair<double, double>> pairs, const std::string& name);

} // namespace msi
