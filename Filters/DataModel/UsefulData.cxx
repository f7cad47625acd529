#include "UsefulData.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
// Of a channel's response to the perfect white: where more comes from wavelengths without measured reflectance, the
// simulation is a guess.
constexpr double MostUnmeasured = 0.5;
}

void requireResponsesThatChange(const Eigen::MatrixXd& response, const std::string& nameOfTable)
{
  const auto last = response.cols() - 1;
  if ((response.array() == 0.0).all())
  {
    throw std::invalid_argument("the responses of " + nameOfTable +
      " are 0 in every sample; expected the answers of a camera: check the file and its columns");
  }
  if (last > 0 && response.leftCols(last) == response.rightCols(last))
  {
    throw std::invalid_argument("the responses of " + nameOfTable + " are the same in all " +
      std::to_string(last + 1) +
      " samples; expected the answers of a camera to each of them: check the file and its columns");
  }
}

std::string uselessChannel(
  const CameraModel& camera, const WavelengthGrid& measured, const std::string& nameOfTable)
{
  std::ostringstream text;
  if (camera.wavelengths().size() < 2)
  {
    text << nameOfTable
         << " has 1 wavelength; expected the responsivity of each channel over the spectrum";
    return text.str();
  }
  for (Eigen::Index k = 0; k < camera.channelCount(); ++k)
  {
    const Eigen::VectorXd curve = camera.responsivity().row(k).transpose().cwiseAbs();
    text << "channel " << camera.channels()[static_cast<std::size_t>(k)] << " of " << nameOfTable;
    const double all = curve.sum();
    if (!(all > 0.0))
    {
      text << " answers to no light: its curve is 0; expected responsivities above 0";
      return text.str();
    }
    double outside = 0.0;
    for (Eigen::Index j = 0; j < curve.size(); ++j)
    {
      const double nm = camera.wavelengths()[j];
      outside += nm < measured.front() || nm > measured.back() ? curve[j] : 0.0;
    }
    if (outside > MostUnmeasured * all)
    {
      text << " gets " << std::round(100.0 * outside / all)
           << " % of its response from wavelengths where no reflectance was measured (measured: "
           << std::round(measured.front()) << " to " << std::round(measured.back())
           << " nm); expected curves over the measured wavelengths: check the wavelengths of both";
      return text.str();
    }
    text.str({});
  }
  return {};
}

} // namespace msi
