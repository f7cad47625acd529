#include "Kernels/Colorimetry/TristimulusTransform.h"

#include "Kernels/Colorimetry/WhitePoint.h"
#include "Kernels/Spectra/Reject.h"

namespace msi
{

namespace
{

// Sums Count samples side by side, each over its bands in their order, whatever the others are.
template <int Count>
void sumSamples(const Eigen::Matrix4Xd& weights,
  const Eigen::Ref<const Eigen::MatrixXd>& reflectance, Eigen::Index first,
  Eigen::Ref<Eigen::Matrix3Xd>& xyz) noexcept
{
  Eigen::Matrix<double, 4, Count> total = Eigen::Matrix<double, 4, Count>::Zero();
  for (Eigen::Index k = 0; k < weights.cols(); ++k)
  {
    for (int sample = 0; sample < Count; ++sample)
    {
      total.col(sample) += weights.col(k) * reflectance(k, first + sample);
    }
  }
  xyz.middleCols<Count>(first) = total.template topRows<3>();
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
    reject("the observer '", observer.name(), "', ", fine.front(), " to ", fine.back(),
      " nm, sees nothing of the illuminant '", illuminant.name(), "', ",
      illuminant.wavelengths().front(), " to ", illuminant.wavelengths().back(), " nm");
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
  FloatBlocks = TristimulusBlocks(Weights);
}

void TristimulusTransform::apply(const Eigen::Ref<const Eigen::MatrixXd>& reflectance,
  Eigen::Ref<Eigen::Matrix3Xd> xyz) const noexcept
{
  constexpr int Together = 4;
  const Eigen::Index samples = reflectance.cols();
  Eigen::Index first = 0;
  for (; first + Together <= samples; first += Together)
  {
    sumSamples<Together>(DoubleWeights, reflectance, first, xyz);
  }
  for (; first < samples; ++first)
  {
    sumSamples<1>(DoubleWeights, reflectance, first, xyz);
  }
}

void TristimulusTransform::apply(const Eigen::Ref<const Eigen::MatrixXf>& reflectance,
  Eigen::Ref<Eigen::Matrix3Xf> xyz) const noexcept
{
  if (reflectance.outerStride() == reflectance.rows() && xyz.outerStride() == 3)
  {
    FloatBlocks.apply(reflectance.data(), xyz.data(), xyz.cols());
    return;
  }
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
  {
    FloatBlocks.apply(reflectance.col(i).data(), xyz.col(i).data(), 1);
  }
}

Eigen::Matrix3Xd TristimulusTransform::operator()(const Eigen::MatrixXd& reflectance) const
{
  if (reflectance.rows() != Wavelengths.size())
  {
    reject("reflectance has ", reflectance.rows(),
      " bands; the tristimulus transform was built for ", Wavelengths.size());
  }
  Eigen::Matrix3Xd xyz(3, reflectance.cols());
  apply(reflectance, xyz);
  return xyz;
}

} // namespace msi
