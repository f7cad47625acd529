#include "Kernels/Gap/Shapley.h"

namespace msi
{

std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players)
{
  // (others)! (players - others - 1)! / players! for a coalition of so many others.
  const auto weight = [players](std::size_t others)
  {
    double part = 1.0 / static_cast<double>(players);
    for (std::size_t n = 1; n <= others; ++n)
    {
      part *= static_cast<double>(n) / static_cast<double>(players - n);
    }
    return part;
  };
  std::vector<double> share;
  for (std::size_t p = 0; p < players; ++p)
  {
    double sum = 0.0;
    for (std::size_t subset = 0; subset < value.size(); ++subset)
    {
      if ((subset >> p & 1U) == 0)
      {
        std::size_t others = 0;
        for (std::size_t bit = 0; bit < players; ++bit)
        {
          others += subset >> bit & 1U;
        }
        sum += weight(others) * (value[subset | std::size_t(1) << p] - value[subset]);
      }
    }
    share.push_back(sum);
  }
  return share;
}

} // namespace msi
