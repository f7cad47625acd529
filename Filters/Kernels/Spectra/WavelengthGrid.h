// The wavelengths at which a spectrum, a spectral image or a sensitivity is known.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace msi
{

// An immutable, strictly increasing list of wavelengths in nanometres.
//
// Range:  every value finite and within [100, 20000] nm; at least one value.
// Errors: the constructors throw std::invalid_argument naming the offending position and value.
class WavelengthGrid
{
public:
  explicit WavelengthGrid(std::vector<double> nanometres);

  // first, first + step, ..., last. Throws unless step > 0 and last is a whole number of steps away.
  static WavelengthGrid uniform(double first, double last, double step);

  Eigen::Index size() const noexcept { return static_cast<Eigen::Index>(Nanometres.size()); }
  double operator[](Eigen::Index i) const noexcept
  {
    return Nanometres[static_cast<std::size_t>(i)];
  }
  double front() const noexcept { return Nanometres.front(); }
  double back() const noexcept { return Nanometres.back(); }
  const std::vector<double>& values() const noexcept { return Nanometres; }
  Eigen::Map<const Eigen::VectorXd> vector() const noexcept
  {
    return { Nanometres.data(), size() };
  }

  // The common step in nm; empty where the spacing varies by more than 1e-6 nm or one value stands.
  std::optional<double> step() const noexcept { return Step; }

  friend bool operator==(const WavelengthGrid& a, const WavelengthGrid& b) noexcept
  {
    return a.Nanometres == b.Nanometres;
  }
  friend bool operator!=(const WavelengthGrid& a, const WavelengthGrid& b) noexcept
  {
    return !(a == b);
  }

private:
  std::optional<double> commonStep() const noexcept;

  std::vector<double> Nanometres;
  std::optional<double> Step;
};

} // namespace msi
