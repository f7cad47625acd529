#include "Kernels/Colorimetry/TristimulusTransform.h"

#include "Kernels/Colorimetry/WhitePoint.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{

// The bands of one group are summed in Scalar, the groups in double.
constexpr Eigen::Index GroupedBands = 8;

// Sums Count samples side by side, each over its bands in their order, whatever the others are.
template <int Count, typename Scalar>
void sumSamples(const Eigen::Matrix<Scalar, 4, Eigen::Dynamic>& weights,
  const Eigen::Ref<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>& reflectance,
  Eigen::Index first, Eigen::Ref<Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& xyz) noexcept
{
  const Eigen::Index bands = weights.cols();
  Eigen::Matrix<double, 4, Count> total = Eigen::Matrix<double, 4, Count>::Zero();
  for (Eigen::Index begin = 0; begin < bands; begin += GroupedBands)
  {
    const Eigen::Index end = std::min(begin + GroupedBands, bands);
    Eigen::Matrix<Scalar, 4, Count> group = Eigen::Matrix<Scalar, 4, Count>::Zero();
    for (Eigen::Index k = begin; k < end; ++k)
    {
      for (int sample = 0; sample < Count; ++sample)
      {
        group.col(sample) += weights.col(k) * reflectance(k, first + sample);
      }
    }
    total += group.template cast<double>();
  }
  for (int sample = 0; sample < Count; ++sample)
  {
    xyz.col(first + sample) = total.col(sample).template head<3>().template cast<Scalar>();
  }
}

template <typename Scalar>
void sumBands(const Eigen::Matrix<Scalar, 4, Eigen::Dynamic>& weights,
  const Eigen::Ref<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>& reflectance,
  Eigen::Ref<Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& xyz) noexcept
{
  constexpr int Together = 4;
  const Eigen::Index samples = reflectance.cols();
  Eigen::Index first = 0;
  for (; first + Together <= samples; first += Together)
  {
    sumSamples<Together>(weights, reflectance, first, xyz);
  }
  for (; first < samples; ++first)
  {
    sumSamples<1>(weights, reflectance, first, xyz);
  }
}
}

TristimulusTransform::TristimulusTransform(const WavelengthGrid& wavelengths,
  const Illuminant& illuminant, const StandardObserver& observer, InterpolationMethod method)
  : Wavelengths(wavelengths)
{
  const WavelengthGrid& fine = observer.wavelengths();
  const Eigen::VectorXd power = illuminant.powerAt(fine);
  const double luminous = observer.functions().row(1).dot(power);
  if (!(luminous > 0.0))
  {
    std::ostringstream message;
    message << "the observer '" << observer.name() << "', " << fine.front() << " to " << fine.back()
            << " nm, sees nothing of the illuminant '" << illuminant.name() << "', "
            << illuminant.wavelengths().front() << " to " << illuminant.wavelengths().back()
            << " nm";
    throw std::invalid_argument(message.str());
  }
  const Eigen::Matrix3Xd fineWeights =
    (WhiteY / luminous) * observer.functions() * power.asDiagonal();
  Weights = fineWeights * resamplingMatrix(wavelengths, fine, method);
  WhitePoint = fineWeights.rowwise().sum();

  ExtrapolatedShare.setZero();
  for (Eigen::Index i = 0; i < fine.size(); ++i)
  {
    if (needsExtrapolation(wavelengths, WavelengthGrid({ fine[i] })))
    {
      ExtrapolatedShare += fineWeights.col(i);
    }
  }
  ExtrapolatedShare =
    (WhitePoint.array() > 0.0).select(ExtrapolatedShare.array() / WhitePoint.array(), 0.0);

  DoubleWeights.setZero(4, Weights.cols());
  DoubleWeights.topRows<3>() = Weights;
  FloatWeights = DoubleWeights.cast<float>();
}

void TristimulusTransform::apply(const Eigen::Ref<const Eigen::MatrixXd>& reflectance,
  Eigen::Ref<Eigen::Matrix3Xd> xyz) const noexcept
{
  sumBands<double>(DoubleWeights, reflectance, xyz);
}

void TristimulusTransform::apply(const Eigen::Ref<const Eigen::MatrixXf>& reflectance,
  Eigen::Ref<Eigen::Matrix3Xf> xyz) const noexcept
{
  sumBands<float>(FloatWeights, reflectance, xyz);
}

Eigen::Matrix3Xd TristimulusTransform::operator()(const Eigen::MatrixXd& reflectance) const
{
  if (reflectance.rows() != Wavelengths.size())
  {
    std::ostringstream message;
    message << "reflectance has " << reflectance.rows() << " bands; the tristimulus transform was "
            << "built for " << Wavelengths.size();
    throw std::invalid_argument(message.str());
  }
  Eigen::Matrix3Xd xyz(3, reflectance.cols());
  apply(reflectance, xyz);
  return xyz;
}

} // namespace msi
