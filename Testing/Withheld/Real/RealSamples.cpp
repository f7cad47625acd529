#include "RealSamples.h"

#include "Formats/Curves.h"
#include "Formats/LabelImage.h"
#include "Formats/SampleTable.h"
#include "Formats/SpectralImageFile.h"
#include "Kernels/Camera/CameraModelFit.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

namespace withheld
{

namespace
{
std::string dataFolder()
{
  const char* folder = std::getenv("MULTISPECTRAL_DATA");
  return folder == nullptr ? std::string() : std::string(folder) + "/";
}

Eigen::MatrixXd columnsOf(const Eigen::MatrixXd& matrix, const std::vector<Eigen::Index>& which)
{
  Eigen::MatrixXd chosen(matrix.rows(), static_cast<Eigen::Index>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i)
  {
    chosen.col(static_cast<Eigen::Index>(i)) = matrix.col(which[i]);
  }
  return chosen;
}

// v(u) = c0 + c1 u + c2 u^2 + c3 u^3 that comes nearest to `linear`, at every u of `all`.
Eigen::VectorXd cubic(
  const Eigen::VectorXd& answer, const Eigen::VectorXd& linear, const Eigen::VectorXd& all)
{
  const auto powers = [](const Eigen::VectorXd& u)
  {
    Eigen::MatrixXd columns(u.size(), 4);
    columns << Eigen::VectorXd::Ones(u.size()), u, u.cwiseAbs2(), u.array().cube().matrix();
    return columns;
  };
  return powers(all) * powers(answer).colPivHouseholderQr().solve(linear);
}

// Responsivities and, last, the dark responses, K x (N + 1). penalty: over the mean square of a wavelength's reflectances.
Eigen::MatrixXd ridge(
  const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& answer, double penalty)
{
  const Eigen::Index N = reflectance.rows();
  Eigen::MatrixXd known(N + 1, reflectance.cols());
  known << reflectance, Eigen::RowVectorXd::Ones(reflectance.cols());
  Eigen::MatrixXd normal = known * known.transpose();
  normal.diagonal().head(N).array() += penalty * reflectance.squaredNorm() / static_cast<double>(N);
  return normal.ldlt().solve(known * answer.transpose()).transpose();
}
}

Eigen::MatrixXd RealSamples::simulated() const
{
  Eigen::MatrixXd onGrid(camera.cols(), reflectance.cols());
  for (Eigen::Index w = 0; w < onGrid.rows(); ++w)
  {
    const double step = wavelengths[1] - wavelengths[0];
    const double place =
      std::clamp((cameraWavelengths[static_cast<std::size_t>(w)] - wavelengths[0]) / step, 0.0,
        static_cast<double>(wavelengths.size() - 1));
    const auto low = static_cast<Eigen::Index>(
      std::min(std::floor(place), static_cast<double>(wavelengths.size() - 2)));
    const double part = place - static_cast<double>(low);
    onGrid.row(w) = (1.0 - part) * reflectance.row(low) + part * reflectance.row(low + 1);
  }
  return (camera * onGrid).colwise() + dark;
}

bool haveRealSamples()
{
  return !dataFolder().empty();
}

RealSamples fittedHalf(Random& random, const std::vector<std::string>& media, Source source)
{
  RealSamples real;
  Eigen::MatrixXd reflectance;
  Eigen::MatrixXd answer;
  std::vector<std::string> medium;
  std::optional<msi::WavelengthGrid> grid;
  for (const std::string& name : media)
  {
    const msi::SampleTable table = msi::readSampleTable(dataFolder() + "hkpolyu/" + name + ".csv");
    grid = table.wavelengths;
    const Eigen::Index before = reflectance.cols();
    reflectance.conservativeResize(table.reflectance.rows(), before + table.sampleCount());
    answer.conservativeResize(table.responses.rows(), before + table.sampleCount());
    reflectance.rightCols(table.sampleCount()) = table.reflectance;
    answer.rightCols(table.sampleCount()) = table.responses;
    medium.insert(medium.end(), static_cast<std::size_t>(table.sampleCount()), name);
    real.channels.clear();
    for (Eigen::Index k = 0; k < table.responses.rows(); ++k)
    {
      real.channels.push_back((*table.channelWavelengths)[k]);
    }
  }
  for (Eigen::Index w = 0; w < grid->size(); ++w)
  {
    real.wavelengths.push_back((*grid)[w]);
  }
  std::vector<Eigen::Index> order(medium.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  const auto half = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 2);
  const std::vector<Eigen::Index> fitted(order.begin(), half);
  const std::vector<Eigen::Index> kept(half, order.end());

  real.cameraWavelengths = real.wavelengths;
  const Eigen::MatrixXd calibration = columnsOf(reflectance, fitted);
  if (source == Source::Ridge)
  {
    const Eigen::MatrixXd solution =
      ridge(calibration, columnsOf(answer, fitted), std::pow(10.0, uniform(random, -7.0, -2.0)));
    real.camera = solution.leftCols(grid->size());
    real.dark = solution.rightCols(1);
  }
  else
  {
    msi::CameraModelFitOptions options;
    options.draws = 0;
    msi::CameraModelFit fit =
      msi::fitCameraModel(*grid, calibration, columnsOf(answer, fitted), options);
    for (int round = 0; source == Source::Linearised && round < 2; ++round)
    {
      const Eigen::MatrixXd linear =
        (fit.camera.responsivity() * calibration).colwise() + fit.camera.dark();
      const Eigen::MatrixXd seen = columnsOf(answer, fitted);
      for (Eigen::Index k = 0; k < answer.rows(); ++k)
      {
        answer.row(k) = cubic(seen.row(k), linear.row(k), answer.row(k));
      }
      fit = msi::fitCameraModel(*grid, calibration, columnsOf(answer, fitted), options);
    }
    real.camera = fit.camera.responsivity();
    real.dark = fit.camera.dark();
  }
  real.reflectance = columnsOf(reflectance, kept);
  real.answers = { columnsOf(answer, kept) };
  for (const Eigen::Index i : kept)
  {
    real.medium.push_back(medium[static_cast<std::size_t>(i)]);
  }
  return real;
}

RealSamples chart(Random& random)
{
  const std::string folder = dataFolder() + "filterwheel-cc24/";
  RealSamples real;
  const msi::SampleTable patches = msi::readSampleTable(folder + "patches.csv");
  for (Eigen::Index w = 0; w < patches.wavelengths->size(); ++w)
  {
    real.wavelengths.push_back((*patches.wavelengths)[w]);
  }
  real.reflectance = patches.reflectance;
  const Eigen::Index S = patches.sampleCount();
  real.medium.assign(static_cast<std::size_t>(S), "colorchecker");

  std::vector<std::string> files;
  for (int nm = 400; nm <= 700; nm += 50)
  {
    files.push_back(folder + "channel_" + std::to_string(nm) + "nm.tif");
    real.channels.push_back(nm);
  }
  const auto K = static_cast<Eigen::Index>(files.size());
  const auto file = msi::openSpectralImage(files);
  const int width = file->info().width;
  const int height = file->info().height;
  std::vector<float> pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
    static_cast<std::size_t>(K));
  file->readBlock({ 0, width, 0, height }, {}, pixels.data());
  const msi::LabelImage labels = msi::readLabelImage(folder + "labels.png");
  // Every third row of a patch is one reading.
  constexpr int Readings = 3;
  real.answers.assign(Readings, Eigen::MatrixXd::Zero(K, S));
  Eigen::MatrixXd count = Eigen::MatrixXd::Zero(Readings, S);
  real.x = real.y = Eigen::VectorXd::Zero(S);
  const std::vector<double> labelOf = patches.findMetadata("label")->numbers();
  for (Eigen::Index i = 0; i < S; ++i)
  {
    for (int row = 0; row < height; ++row)
    {
      for (int column = 0; column < width; ++column)
      {
        const auto at = static_cast<std::size_t>(row * width + column);
        if (labels.labels[at] != static_cast<int>(labelOf[static_cast<std::size_t>(i)]))
        {
          continue;
        }
        count(row % Readings, i) += 1.0;
        real.x[i] += column;
        real.y[i] += row;
        for (Eigen::Index k = 0; k < K; ++k)
        {
          real.answers[static_cast<std::size_t>(row % Readings)](k, i) += static_cast<double>(
            pixels[at * static_cast<std::size_t>(K) + static_cast<std::size_t>(k)]);
        }
      }
    }
    real.x[i] /= count.col(i).sum();
    real.y[i] /= count.col(i).sum();
    for (int n = 0; n < Readings; ++n)
    {
      real.answers[static_cast<std::size_t>(n)].col(i) /= count(n, i);
    }
  }
  const msi::Curves curves = msi::readCurves(folder + "filters.csv");
  for (Eigen::Index w = 0; w < curves.wavelengths.size(); ++w)
  {
    real.cameraWavelengths.push_back(curves.wavelengths[w]);
  }
  real.camera = curves.values.transpose();
  real.dark = Eigen::VectorXd::Zero(K);
  // One scale a channel brings light x filter to the answers, and the answers to white.
  std::vector<Eigen::Index> order(static_cast<std::size_t>(S));
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  const Eigen::MatrixXd simulated = real.simulated();
  for (Eigen::Index k = 0; k < K; ++k)
  {
    double both = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < order.size() / 2; ++i)
    {
      const double u = (real.answers[0](k, order[i]) + real.answers[1](k, order[i]) +
                         real.answers[2](k, order[i])) /
        3.0;
      both += u * simulated(k, order[i]);
      square += u * u;
    }
    const double white = real.camera.row(k).sum();
    real.camera.row(k) /= white;
    for (Eigen::MatrixXd& answer : real.answers)
    {
      answer.row(k) *= both / square / white;
    }
  }
  return real;
}

} // namespace withheld
