// Estimators of reflectance on one core: 16 channels to 31 bands.
#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/ResponseColor.h"
#include "Kernels/Estimation/Transfer/TransferEstimation.h"

#include <benchmark/benchmark.h>

#include <cstring>

namespace
{

constexpr Eigen::Index Pixels = 1 << 16;

// The demo's chart, and every fourth of its fabrics for tuning.
const msi::TransferEstimator& transfer()
{
  static const msi::TransferEstimator estimator = []
  {
    const auto read = [](const char* name)
    { return msi::test::samplesIn(std::string(MULTISPECTRAL_SOURCE_DIR "/Data/Samples/") + name); };
    const msi::SampleSet fabric = read("demo-fabric.csv");
    std::vector<Eigen::Index> tuning;
    for (Eigen::Index i = 0; i < fabric.size() && tuning.size() < 16; i += 4)
    {
      tuning.push_back(i);
    }
    return msi::fitTransfer(read("demo-chart.csv"), fabric.subset(tuning)).estimator;
  }();
  return estimator;
}

template <typename Scalar>
void run(benchmark::State& state, const msi::ReflectanceEstimator& estimator)
{
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  std::srand(1);
  const Block responses = (Block::Random(estimator.channels(), Pixels).array() + Scalar(1.2)) / 3;
  Block reflectance(estimator.bands(), Pixels);
  estimator.apply(responses.data(), reflectance.data(), static_cast<Scalar*>(nullptr), 1);
  for (auto _ : state)
  {
    estimator.apply(responses.data(), reflectance.data(), static_cast<Scalar*>(nullptr), Pixels);
    benchmark::DoNotOptimize(reflectance.data());
  }
  state.SetItemsProcessed(state.iterations() * Pixels);
}

void transferFloat(benchmark::State& state)
{
  run<float>(state, transfer());
}
BENCHMARK(transferFloat)->Name("transfer/float blocks");

void transferDouble(benchmark::State& state)
{
  run<double>(state, transfer());
}
BENCHMARK(transferDouble)->Name("transfer/double blocks");

void affineFloat(benchmark::State& state)
{
  const Eigen::MatrixXd matrix = transfer().parameters().at("affine.coefficients");
  run<float>(state, msi::AffineEstimator(msi::AffineTransform(matrix)));
}
BENCHMARK(affineFloat)->Name("transfer/an affine transform");

void copyReflectance(benchmark::State& state)
{
  const Eigen::MatrixXf reflectance = Eigen::MatrixXf::Random(31, Pixels);
  Eigen::MatrixXf copy(31, Pixels);
  for (auto _ : state)
  {
    std::memcpy(copy.data(), reflectance.data(),
      static_cast<std::size_t>(reflectance.size()) * sizeof(float));
    benchmark::DoNotOptimize(copy.data());
  }
  state.SetItemsProcessed(state.iterations() * Pixels);
}
BENCHMARK(copyReflectance)->Name("transfer/memcpy");

// From responses and measured colors to a map of CIEDE2000, an image that no cache holds.
constexpr Eigen::Index ImagePixels = 1 << 20;

struct ColorMapCase
{
  msi::AffineTransform transform{ transfer().parameters().at("affine.coefficients") };
  msi::TristimulusTransform tristimulus{ msi::WavelengthGrid::uniform(400.0, 700.0, 10.0),
    msi::Illuminant::named("D65") };
  Eigen::MatrixXf responses = (Eigen::MatrixXf::Random(16, ImagePixels).array() + 1.2F) / 3;
  Eigen::Matrix3Xf measured = 50.0F * Eigen::Matrix3Xf::Random(3, ImagePixels);
  Eigen::VectorXf map{ ImagePixels };
};

constexpr Eigen::Index ColorBlock = 256;

void colorMapFused(benchmark::State& state)
{
  ColorMapCase c;
  const msi::ResponseColor color(c.transform, c.tristimulus);
  for (auto _ : state)
  {
    color.differences({}, c.responses.data(), c.measured.data(), c.map.data(), ImagePixels);
    benchmark::DoNotOptimize(c.map.data());
  }
  state.SetItemsProcessed(state.iterations() * ImagePixels);
}
BENCHMARK(colorMapFused)->Name("color map/responses to CIEDE2000, fused");

// The same by an image of reflectance.
void colorMapUnfused(benchmark::State& state)
{
  ColorMapCase c;
  const msi::CIELAB toLab(c.tristimulus.whitePoint());
  Eigen::MatrixXf reflectance(31, ImagePixels);
  Eigen::Matrix<float, 3, ColorBlock> lab;
  for (auto _ : state)
  {
    c.transform.apply(c.responses.data(), reflectance.data(), ImagePixels);
    for (Eigen::Index at = 0; at < ImagePixels; at += ColorBlock)
    {
      c.tristimulus.apply(reflectance.middleCols<ColorBlock>(at), lab);
      toLab.fromXYZ(lab, lab);
      msi::CIEDE2000().apply(
        c.measured.middleCols<ColorBlock>(at), lab, c.map.segment<ColorBlock>(at));
    }
    benchmark::DoNotOptimize(c.map.data());
  }
  state.SetItemsProcessed(state.iterations() * ImagePixels);
}
BENCHMARK(colorMapUnfused)->Name("color map/by a reflectance image");

// The bytes that the fused pass cannot do without: 16 responses, a color and a difference, read or written once.
void colorMapCopy(benchmark::State& state)
{
  const Eigen::MatrixXf bytes = Eigen::MatrixXf::Random(10, ImagePixels);
  Eigen::MatrixXf copy(10, ImagePixels);
  for (auto _ : state)
  {
    std::memcpy(copy.data(), bytes.data(), static_cast<std::size_t>(bytes.size()) * sizeof(float));
    benchmark::DoNotOptimize(copy.data());
  }
  state.SetItemsProcessed(state.iterations() * ImagePixels);
}
BENCHMARK(colorMapCopy)->Name("color map/memcpy");

}
