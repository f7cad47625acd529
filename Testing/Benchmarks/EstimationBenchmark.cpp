// Estimators of reflectance on one core: 16 channels to 31 bands.
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/TransferEstimation.h"

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
  const auto& matrix = transfer().parameters().at("affine.coefficients");
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

}
