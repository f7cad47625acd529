// Sharma's first pair of colors: their difference is 2.0425.
#include "Kernels/Difference/CIEDE2000.h"

#include <cmath>
#include <cstdio>

int main()
{
  const msi::CIEDE2000 difference;
  const double value = difference({ 50.0, 2.6772, -79.7751 }, { 50.0, 0.0, -82.7485 });
  std::printf("%.4f\n", value);
  return std::fabs(value - 2.0425) < 5e-5 ? 0 : 1;
}
