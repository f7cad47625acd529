// A spectrum read at wavelengths that move while a fit runs.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace msi
{

// The operator T with s(at) = T s(grid), with a continuous derivative in `at`, also where `at` passes a
// grid wavelength or an end of the grid (the interpolations of Spectra have kinks there or cost N^3).
//
// Cubic Hermite pieces; the slopes are those of the polynomial through the five nearest values. d nm beyond an
// end the spectrum is s_end + slope d / (1 + d / 20 nm): it goes on and comes to rest.
// at: any wavelengths, in any order. Every row of T sums to one. Exact for cubics within a grid of five wavelengths or
// more.
class MovedSpectrum
{
public:
  explicit MovedSpectrum(const WavelengthGrid& grid);

  // T; at.size() x grid.size().
  Eigen::MatrixXd operation(const Eigen::ArrayXd& at) const;
  // weights^T T without T: one row, grid.size(). Cost: O(at.size() + grid.size()).
  Eigen::RowVectorXd weighted(const Eigen::ArrayXd& weights, const Eigen::ArrayXd& at) const;

private:
  static constexpr Eigen::Index SlopePoints = 5;
  struct Slope
  {
    Eigen::Index first;
    std::array<double, SlopePoints> weight;
  };
  Slope slopeAt(Eigen::Index node) const;
  // How much of the values at the grid's wavelengths, and of the slopes there.
  struct Parts
  {
    explicit Parts(Eigen::Index size)
      : value(Eigen::RowVectorXd::Zero(size))
      , slope(Eigen::RowVectorXd::Zero(size))
    {
    }
    Eigen::RowVectorXd value;
    Eigen::RowVectorXd slope;
  };
  void add(double weight, double at, Parts& parts) const;
  void addBeyond(double weight, Eigen::Index end, double distance, Parts& parts) const;
  Eigen::RowVectorXd rowOf(const Parts& parts) const;

  WavelengthGrid Grid;
  Eigen::Index Points;
  std::vector<Slope> Slopes; // one a wavelength of the grid
};

} // namespace msi
