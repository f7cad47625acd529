#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Estimation/Transfer/TransferBlocks.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Estimation/Transfer/TransferBlocks.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// A lane is a pixel. Mul and Add, never MulAdd: every instruction set rounds the same way.
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

// exp(x) for x in [-700, 0.5], 2 ulp: Taylor series on [-ln 2 / 2, ln 2 / 2] times a power of two.
HWY_INLINE Vector exponential(Tag d, Vector x)
{
  constexpr double magic = 6755399441055744.0; // 1.5 * 2^52: leaves the integer in the low bits
  const auto shifted = hn::Add(hn::Mul(x, hn::Set(d, 1.4426950408889634)), hn::Set(d, magic));
  const auto whole = hn::Sub(shifted, hn::Set(d, magic));
  auto r = hn::Sub(x, hn::Mul(whole, hn::Set(d, 0.693147180369123816490)));
  r = hn::Sub(r, hn::Mul(whole, hn::Set(d, 1.90821492927058770002e-10)));
  constexpr double inverseFactorial[] = { 1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0,
    1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0,
    1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0 };
  auto sum = hn::Set(d, inverseFactorial[0]);
  for (int i = 1; i < 14; ++i)
  {
    sum = hn::Add(hn::Mul(sum, r), hn::Set(d, inverseFactorial[i]));
  }
  const hn::Rebind<std::int64_t, Tag> integers;
  const auto exponent = hn::ShiftLeft<52>(
    hn::Add(hn::BitCast(integers, shifted), hn::Set(integers, std::int64_t{ 1023 })));
  return hn::Mul(sum, hn::BitCast(d, exponent));
}

// out[row] = start[row] + sum over j of matrix(j, row) k[j], eight rows at a time.
HWY_INLINE void combine(Tag d, const double* matrix, Eigen::Index rows, Eigen::Index points,
  const double* start, const double* k, double* out)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const Eigen::Index stride = transferStride(rows);
  for (Eigen::Index first = 0; first < rows; first += 8)
  {
    auto s0 = hn::Zero(d);
    auto s1 = s0;
    auto s2 = s0;
    auto s3 = s0;
    auto s4 = s0;
    auto s5 = s0;
    auto s6 = s0;
    auto s7 = s0;
    const double* row = matrix + first;
    for (Eigen::Index j = 0; j < points; ++j, row += stride)
    {
      const auto kj = hn::LoadU(d, k + j * lanes);
      s0 = hn::Add(s0, hn::Mul(hn::Set(d, row[0]), kj));
      s1 = hn::Add(s1, hn::Mul(hn::Set(d, row[1]), kj));
      s2 = hn::Add(s2, hn::Mul(hn::Set(d, row[2]), kj));
      s3 = hn::Add(s3, hn::Mul(hn::Set(d, row[3]), kj));
      s4 = hn::Add(s4, hn::Mul(hn::Set(d, row[4]), kj));
      s5 = hn::Add(s5, hn::Mul(hn::Set(d, row[5]), kj));
      s6 = hn::Add(s6, hn::Mul(hn::Set(d, row[6]), kj));
      s7 = hn::Add(s7, hn::Mul(hn::Set(d, row[7]), kj));
    }
    const auto store = [&](Eigen::Index i, Vector sum) HWY_ATTR
    {
      if (first + i < rows)
      {
        const auto begin = start ? hn::Set(d, start[first + i]) : hn::Zero(d);
        hn::StoreU(hn::Add(begin, sum), d, out + (first + i) * lanes);
      }
    };
    store(0, s0);
    store(1, s1);
    store(2, s2);
    store(3, s3);
    store(4, s4);
    store(5, s5);
    store(6, s6);
    store(7, s7);
  }
}

// k of one vector of pixels. Returns x.x/K, NaN where a feature is not finite.
HWY_INLINE Vector kernelOf(
  Tag d, const PackedTransferExpert& e, const double* response, double* x, double* k)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  auto norm = hn::Zero(d);
  auto poison = hn::Zero(d);
  for (Eigen::Index c = 0; c < e.channels; ++c)
  {
    const auto i = static_cast<std::size_t>(c);
    auto z = hn::Add(
      hn::Mul(hn::Set(d, e.gain[i]), hn::LoadU(d, response + c * lanes)), hn::Set(d, e.offset[i]));
    if (e.space == TransferSpace::SquareRoot)
    {
      z = hn::CopySign(hn::Sqrt(hn::Abs(z)), z);
    }
    const auto feature = hn::Mul(hn::Sub(z, hn::Set(d, e.center[i])), hn::Set(d, e.featureScale));
    hn::StoreU(feature, d, x + c * lanes);
    norm = hn::Add(norm, hn::Mul(feature, feature));
    poison = hn::Add(poison, hn::Mul(feature, hn::Zero(d)));
  }
  norm = hn::Add(hn::Mul(norm, hn::Set(d, e.perChannel)), poison);
  const auto least = hn::Set(d, -700.0);
  for (Eigen::Index j = 0; j < e.points; j += 4)
  {
    const double* p = e.point.data() + j * e.channels;
    auto dot0 = hn::Zero(d);
    auto dot1 = dot0;
    auto dot2 = dot0;
    auto dot3 = dot0;
    for (Eigen::Index c = 0; c < e.channels; ++c)
    {
      const auto feature = hn::LoadU(d, x + c * lanes);
      dot0 = hn::Add(dot0, hn::Mul(hn::Set(d, p[c]), feature));
      dot1 = hn::Add(dot1, hn::Mul(hn::Set(d, p[c + e.channels]), feature));
      dot2 = hn::Add(dot2, hn::Mul(hn::Set(d, p[c + 2 * e.channels]), feature));
      dot3 = hn::Add(dot3, hn::Mul(hn::Set(d, p[c + 3 * e.channels]), feature));
    }
    const auto store = [&](Eigen::Index at, Vector dot) HWY_ATTR
    {
      const double* w = e.weight.data() + 3 * at;
      const auto distance = hn::Sub(
        hn::Add(norm, hn::Set(d, e.pointNorm[static_cast<std::size_t>(at)])), hn::Add(dot, dot));
      const auto smooth = exponential(d, hn::Max(hn::Mul(distance, hn::Set(d, e.exponent)), least));
      const auto value = hn::Add(hn::Add(hn::Set(d, w[0]), hn::Mul(hn::Set(d, w[1]), dot)),
        hn::Mul(hn::Set(d, w[2]), smooth));
      hn::StoreU(value, d, k + at * lanes);
    };
    store(j, dot0);
    store(j + 1, dot1);
    store(j + 2, dot2);
    store(j + 3, dot3);
  }
  return norm;
}

struct Scratch
{
  double* response;
  double* x;
  double* k;
  double* expertMean;
  double* reduced;
  double* mean;
  double* variance;
};

// Adds one expert's share to the mean and, where asked for, to the variance of a vector of pixels.
HWY_INLINE void addExpert(Tag d, const PackedTransferExpert& e, const Scratch& s, bool wantVariance)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const auto norm = kernelOf(d, e, s.response, s.x, s.k);
  const auto poison = hn::Mul(norm, hn::Zero(d));
  const auto share = hn::Set(d, e.meanShare);
  combine(d, e.coefficients.data(), e.bands, e.points, e.mean.data(), s.k, s.expertMean);
  auto variance = hn::Zero(d);
  if (wantVariance)
  {
    combine(d, e.reduction.data(), e.points, e.points, nullptr, s.k, s.reduced);
    variance = hn::Add(hn::Set(d, e.priorConstant), hn::Mul(hn::Set(d, e.priorLinear), norm));
    for (Eigen::Index j = 0; j < e.points; ++j)
    {
      variance = hn::Sub(
        variance, hn::Mul(hn::LoadU(d, s.k + j * lanes), hn::LoadU(d, s.reduced + j * lanes)));
    }
    variance = hn::Mul(hn::Max(variance, hn::Zero(d)), hn::Set(d, e.varianceShare));
  }
  for (Eigen::Index n = 0; n < e.bands; ++n)
  {
    auto y = hn::LoadU(d, s.expertMean + n * lanes);
    auto slope = hn::Set(d, 1.0);
    if (e.space == TransferSpace::SquareRoot)
    {
      y = hn::Mul(y, hn::Abs(y));
      slope = hn::Mul(hn::Set(d, 4.0), hn::Max(hn::Abs(y), hn::Set(d, LeastSlopeReflectance)));
    }
    auto* mean = s.mean + n * lanes;
    hn::StoreU(hn::Add(hn::LoadU(d, mean), hn::Add(hn::Mul(share, y), poison)), d, mean);
    if (wantVariance)
    {
      auto* total = s.variance + n * lanes;
      hn::StoreU(hn::Add(hn::LoadU(d, total), hn::Add(hn::Mul(slope, variance), poison)), d, total);
    }
  }
}

HWY_INLINE void addAffine(
  Tag d, const PackedAffineExpert& e, Eigen::Index channels, Eigen::Index bands, const Scratch& s)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const auto share = hn::Set(d, e.meanShare);
  combine(d, e.coefficients.data(), bands, channels, e.constant.data(), s.response, s.expertMean);
  for (Eigen::Index n = 0; n < bands; ++n)
  {
    auto* mean = s.mean + n * lanes;
    const auto estimate = hn::LoadU(d, s.expertMean + n * lanes);
    hn::StoreU(hn::Add(hn::LoadU(d, mean), hn::Mul(share, estimate)), d, mean);
  }
}

void runBlock(const PackedTransfer& mixture, const double* response, double* mean,
  double* standardDeviation, Eigen::Index pixels)
{
  const Tag d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const Eigen::Index channels = mixture.experts.front().channels;
  const Eigen::Index bands = mixture.experts.front().bands;
  Eigen::Index points = 0;
  for (const PackedTransferExpert& expert : mixture.experts)
  {
    points = std::max(points, expert.points);
  }
  std::vector<double> memory(
    static_cast<std::size_t>(lanes * (2 * channels + 2 * points + 3 * bands)));
  Scratch s{};
  s.response = memory.data();
  s.x = s.response + lanes * channels;
  s.k = s.x + lanes * channels;
  s.reduced = s.k + lanes * points;
  s.expertMean = s.reduced + lanes * points;
  s.mean = s.expertMean + lanes * bands;
  s.variance = s.mean + lanes * bands;

  for (Eigen::Index first = 0; first < pixels; first += lanes)
  {
    const Eigen::Index count = std::min(lanes, pixels - first);
    for (Eigen::Index lane = 0; lane < lanes; ++lane)
    {
      const double* pixel = response + (first + std::min(lane, count - 1)) * channels;
      for (Eigen::Index c = 0; c < channels; ++c)
      {
        s.response[c * lanes + lane] = pixel[c];
      }
    }
    std::fill(s.mean, s.variance + lanes * bands, 0.0);
    for (const PackedTransferExpert& expert : mixture.experts)
    {
      addExpert(d, expert, s, standardDeviation != nullptr);
    }
    addAffine(d, mixture.affine, channels, bands, s);
    for (Eigen::Index lane = 0; lane < count; ++lane)
    {
      for (Eigen::Index n = 0; n < bands; ++n)
      {
        const Eigen::Index to = (first + lane) * bands + n;
        mean[to] = s.mean[n * lanes + lane];
        if (standardDeviation != nullptr)
        {
          standardDeviation[to] = std::sqrt(
            mixture.bandVariance[static_cast<std::size_t>(n)] * s.variance[n * lanes + lane]);
        }
      }
    }
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(runBlock);

namespace
{
// Row-major, padded with zeros.
std::vector<double> pack(const Eigen::MatrixXd& matrix, Eigen::Index rows, Eigen::Index stride)
{
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor padded = RowMajor::Zero(rows, stride);
  padded.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
  return { padded.data(), padded.data() + padded.size() };
}
}

PackedTransferExpert::PackedTransferExpert(
  const TransferExpert& expert, double shareOfMean, double shareOfVariance)
  : space(expert.features.space)
  , meanShare(shareOfMean)
  , varianceShare(shareOfVariance)
  , channels(expert.points.rows())
  , bands(expert.coefficients.cols())
  , points((expert.points.cols() + 3) / 4 * 4)
  , exponent(-0.5 / (expert.length * expert.length))
  , priorConstant(expert.priorConstant)
  , priorLinear(expert.priorLinear)
  , perChannel(1.0 / static_cast<double>(channels))
  , featureScale(1.0 / expert.features.scale)
  , mean(expert.center.data(), expert.center.data() + bands)
{
  const Eigen::VectorXd gains =
    expert.features.logGain.array().exp() / expert.features.responseScale;
  gain.assign(gains.data(), gains.data() + channels);
  offset.assign(expert.features.offset.data(), expert.features.offset.data() + channels);
  center.assign(expert.features.center.data(), expert.features.center.data() + channels);
  point = pack(perChannel * expert.points.transpose(), points, channels);
  pointNorm = pack(perChannel * expert.points.colwise().squaredNorm().transpose(), points, 1);
  weight = pack(expert.weights.transpose(), points, 3);
  coefficients = pack(expert.coefficients, points, transferStride(bands));
  reduction = pack(expert.reduction, points, transferStride(points));
}

PackedAffineExpert::PackedAffineExpert(
  const Eigen::MatrixXd& affineCoefficients, double shareOfMean)
  : meanShare(shareOfMean)
{
  const Eigen::Index channels = affineCoefficients.cols() - 1;
  const Eigen::Index bands = affineCoefficients.rows();
  constant = pack(affineCoefficients.rightCols<1>(), bands, 1);
  coefficients =
    pack(affineCoefficients.leftCols(channels).transpose(), channels, transferStride(bands));
}

PackedTransfer::PackedTransfer(const TransferMixture& mixture)
  : affine(mixture.affine, mixture.affineShare)
  , bandVariance(
      mixture.bandVariance.data(), mixture.bandVariance.data() + mixture.bandVariance.size())
{
  for (std::size_t i = 0; i < mixture.experts.size(); ++i)
  {
    experts.emplace_back(mixture.experts[i], mixture.meanShares[i], mixture.varianceShares[i]);
  }
}

void runTransfer(const PackedTransfer& mixture, const double* response, double* mean,
  double* standardDeviation, Eigen::Index pixels) noexcept
{
  HWY_DYNAMIC_DISPATCH(runBlock)(mixture, response, mean, standardDeviation, pixels);
}

} // namespace msi
#endif
