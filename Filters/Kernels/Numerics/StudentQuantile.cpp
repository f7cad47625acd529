#include "Kernels/Numerics/StudentQuantile.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double Pi = 3.14159265358979323846;

// Probability of |T| <= sqrt(degrees) tan(angle).
double studentProbability(double angle, int degrees)
{
  const double sine = std::sin(angle);
  const double cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1.0;
  double sum = 0.0;
  for (int k = odd ? 3 : 2; k <= degrees; k += 2)
  {
    sum += term;
    term *= cosine * cosine * static_cast<double>(k - 1) / static_cast<double>(k);
  }
  return odd ? 2.0 / Pi * (angle + sine * sum) : sine * sum;
}
}

double studentQuantile(double probability, int degrees)
{
  double lower = 0.0;
  double upper = 0.5 * Pi;
  for (int step = 0; step < 80; ++step)
  {
    const double middle = 0.5 * (lower + upper);
    (studentProbability(middle, degrees) < probability ? lower : upper) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(0.5 * (lower + upper));
}

} // namespace msi
