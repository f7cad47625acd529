// Colorimetry and color difference on one core, beside Little CMS, Eigen and a plain copy of memory.
#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Difference/ErrorOrderStatistics.h"
#include "Kernels/Difference/ErrorStatistics.h"
#include "Kernels/Difference/SpectralRms.h"

#include <benchmark/benchmark.h>
#include <lcms2.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace
{

constexpr Eigen::Index Samples = 1 << 18;

// Colors all over L* 0..100, a* and b* -60..60.
Eigen::Matrix3Xf randomLab(unsigned seed)
{
  std::srand(seed);
  Eigen::Matrix3Xf lab = 60.0F * Eigen::Matrix3Xf::Random(3, Samples);
  lab.row(0) = (lab.row(0).array() + 60.0F) / 1.2F;
  return lab;
}

Eigen::MatrixXf randomReflectance(unsigned seed)
{
  std::srand(seed);
  return (Eigen::MatrixXf::Random(31, Samples).array() + 1.0F) / 2.0F;
}

msi::TristimulusTransform transform()
{
  return msi::TristimulusTransform(
    msi::WavelengthGrid::uniform(400.0, 700.0, 10.0), msi::Illuminant::named("D65"));
}

void countSamples(benchmark::State& state)
{
  state.SetItemsProcessed(state.iterations() * Samples);
}

void ciede2000Float(benchmark::State& state)
{
  const Eigen::Matrix3Xf first = randomLab(1);
  const Eigen::Matrix3Xf second = randomLab(2);
  Eigen::VectorXf difference(Samples);
  const msi::CIEDE2000 ciede2000;
  for (auto _ : state)
  {
    ciede2000.apply(first, second, difference);
    benchmark::DoNotOptimize(difference.data());
  }
  countSamples(state);
}
BENCHMARK(ciede2000Float)->Name("CIEDE2000/float blocks");

void ciede2000Double(benchmark::State& state)
{
  const Eigen::Matrix3Xd first = randomLab(1).cast<double>();
  const Eigen::Matrix3Xd second = randomLab(2).cast<double>();
  Eigen::VectorXd difference(Samples);
  const msi::CIEDE2000 ciede2000;
  for (auto _ : state)
  {
    ciede2000.apply(first, second, difference);
    benchmark::DoNotOptimize(difference.data());
  }
  countSamples(state);
}
BENCHMARK(ciede2000Double)->Name("CIEDE2000/double blocks");

void ciede2000LittleCMS(benchmark::State& state)
{
  const Eigen::Matrix3Xd first = randomLab(1).cast<double>();
  const Eigen::Matrix3Xd second = randomLab(2).cast<double>();
  Eigen::VectorXd difference(Samples);
  for (auto _ : state)
  {
    for (Eigen::Index i = 0; i < Samples; ++i)
    {
      const cmsCIELab lab1{ first(0, i), first(1, i), first(2, i) };
      const cmsCIELab lab2{ second(0, i), second(1, i), second(2, i) };
      difference(i) = cmsCIE2000DeltaE(&lab1, &lab2, 1.0, 1.0, 1.0);
    }
    benchmark::DoNotOptimize(difference.data());
  }
  countSamples(state);
}
BENCHMARK(ciede2000LittleCMS)->Name("CIEDE2000/Little CMS");

void tristimulus(benchmark::State& state)
{
  const Eigen::MatrixXf reflectance = randomReflectance(3);
  Eigen::Matrix3Xf xyz(3, Samples);
  const msi::TristimulusTransform toXYZ = transform();
  for (auto _ : state)
  {
    toXYZ.apply(reflectance, xyz);
    benchmark::DoNotOptimize(xyz.data());
  }
  countSamples(state);
}
BENCHMARK(tristimulus)->Name("tristimulus/float blocks of 31 bands");

void tristimulusEigen(benchmark::State& state)
{
  const Eigen::MatrixXf reflectance = randomReflectance(3);
  Eigen::Matrix3Xf xyz(3, Samples);
  const Eigen::Matrix3Xf weights = transform().weights().cast<float>();
  for (auto _ : state)
  {
    xyz.noalias() = weights * reflectance;
    benchmark::DoNotOptimize(xyz.data());
  }
  countSamples(state);
}
BENCHMARK(tristimulusEigen)->Name("tristimulus/plain Eigen product");

void tristimulusCopy(benchmark::State& state)
{
  const Eigen::MatrixXf reflectance = randomReflectance(3);
  Eigen::MatrixXf copy(31, Samples);
  for (auto _ : state)
  {
    std::memcpy(copy.data(), reflectance.data(),
      static_cast<std::size_t>(reflectance.size()) * sizeof(float));
    benchmark::DoNotOptimize(copy.data());
  }
  countSamples(state);
}
BENCHMARK(tristimulusCopy)->Name("tristimulus/copy of the reflectance");

void spectralRms(benchmark::State& state)
{
  const Eigen::MatrixXf measured = randomReflectance(3);
  const Eigen::MatrixXf estimated = randomReflectance(4);
  Eigen::VectorXf rms(Samples);
  for (auto _ : state)
  {
    msi::spectralRms(measured, estimated, rms);
    benchmark::DoNotOptimize(rms.data());
  }
  countSamples(state);
}
BENCHMARK(spectralRms)->Name("spectral rms/float blocks of 31 bands");

void cielab(benchmark::State& state)
{
  const Eigen::Matrix3Xf xyz = randomReflectance(5).topRows<3>() * 100.0F;
  Eigen::Matrix3Xf lab(3, Samples);
  const msi::CIELAB toLab(transform().whitePoint());
  for (auto _ : state)
  {
    toLab.fromXYZ(xyz, lab);
    benchmark::DoNotOptimize(lab.data());
  }
  countSamples(state);
}
BENCHMARK(cielab)->Name("CIELAB/float blocks");

void cielabLittleCMS(benchmark::State& state)
{
  const Eigen::Matrix3Xd xyz = randomReflectance(5).topRows<3>().cast<double>();
  Eigen::Matrix3Xd lab(3, Samples);
  const cmsCIEXYZ white{ 0.95047, 1.0, 1.08883 };
  for (auto _ : state)
  {
    for (Eigen::Index i = 0; i < Samples; ++i)
    {
      const cmsCIEXYZ color{ xyz(0, i), xyz(1, i), xyz(2, i) };
      cmsCIELab result;
      cmsXYZ2Lab(&white, &result, &color);
      lab.col(i) << result.L, result.a, result.b;
    }
    benchmark::DoNotOptimize(lab.data());
  }
  countSamples(state);
}
BENCHMARK(cielabLittleCMS)->Name("CIELAB/Little CMS");

void srgb(benchmark::State& state)
{
  const Eigen::Matrix3Xf xyz = randomReflectance(5).topRows<3>() * 100.0F;
  Eigen::Matrix3Xf rgb(3, Samples);
  const msi::SRGB toRGB(transform().whitePoint());
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(toRGB.apply(xyz, rgb));
    benchmark::DoNotOptimize(rgb.data());
  }
  countSamples(state);
}
BENCHMARK(srgb)->Name("sRGB/float blocks");

Eigen::VectorXf someErrors()
{
  return randomReflectance(6).row(0).transpose().array().square() * 5.0F;
}

void errorStatistics(benchmark::State& state)
{
  const Eigen::VectorXf errors = someErrors();
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(msi::summarize(errors.data(), static_cast<std::size_t>(Samples)));
  }
  countSamples(state);
}
BENCHMARK(errorStatistics)->Name("error statistics/both passes");

void errorStatisticsSort(benchmark::State& state)
{
  const Eigen::VectorXf errors = someErrors();
  for (auto _ : state)
  {
    Eigen::VectorXf sorted = errors;
    std::sort(sorted.begin(), sorted.end());
    benchmark::DoNotOptimize(sorted.data());
  }
  countSamples(state);
}
BENCHMARK(errorStatisticsSort)->Name("error statistics/sorting a copy");

}
