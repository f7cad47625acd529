// Surfaces for withheld cases: drawn spectra, and real ones where MULTISPECTRAL_DATA is set.
#pragma once

#include "VirtualBench.h"

#include <string>
#include <vector>

namespace withheld
{

struct SwatchBook
{
  std::string name;
  std::vector<Curve> reflectance;
};

// A medium of its own: base, range and pigments differ from one to the next.
SwatchBook drawSwatches(Random& random, const std::string& name, int count);

// The real sets found, each as long as it is; empty without MULTISPECTRAL_DATA.
const std::vector<SwatchBook>& realSwatches();

} // namespace withheld
