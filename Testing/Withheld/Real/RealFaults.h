// What goes wrong with real answers: they are changed themselves, in proportion to what an idealised passband would see.
#pragma once

#include "RealSamples.h"

#include <functional>

namespace withheld
{

// Where and when the samples were taken, and idealised passbands: Gaussians of 20 nm about the channels' names.
class RealSite
{
public:
  RealSite(const RealSamples& real, std::vector<double> order);

  // How much more a passband sees: [channel][sample], answers with over answers without the change. weight: of a
  // wavelength in a channel; surface: what becomes of a sample's reflectance r. White is balanced again where asked for.
  using Weight = std::function<double(double nm, double center)>;
  using Surface = std::function<Eigen::ArrayXd(const Eigen::ArrayXd& nm, const Eigen::ArrayXd& r)>;
  Eigen::ArrayXXd ratio(const Weight& weight, bool rewhitened) const;
  Eigen::ArrayXXd ratio(const std::string& medium, const Surface& surface) const;

  Eigen::Index channels() const { return static_cast<Eigen::Index>(Centers.size()); }
  Eigen::Index samples() const { return Fine.cols(); }
  const std::vector<std::string>& medium() const { return Medium; }
  const Eigen::ArrayXd& x() const { return X; } // -1..1
  const Eigen::ArrayXd& y() const { return Y; }
  const Eigen::ArrayXd& time() const { return Time; } // 0..1

private:
  Eigen::ArrayXXd weights(const Weight& weight) const; // channels x wavelengths

  std::vector<double> Centers;
  Eigen::ArrayXd Wavelengths;
  Eigen::MatrixXd Fine; // reflectance in steps of one nanometre
  Eigen::MatrixXd Seen; // by the ideal passbands
  std::vector<std::string> Medium;
  Eigen::ArrayXd X, Y, Time;
};

struct RealFault
{
  int stage = 0; // on the light's way: surface and filters, geometry, gain, curve, dark, well
  std::string kind;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& answer, double size)> apply;
};

// As in the project's effect library; those that need two media, and excess_noise, last, from medium_gain on.
const std::vector<std::string>& realFaultNames();
const std::vector<std::string>& realStrangerNames();

// The site must outlive the fault.
RealFault drawRealFault(const std::string& name, Random& random, const RealSite& site);
RealFault drawRealStranger(const std::string& name, Random& random, const RealSite& site);

} // namespace withheld
