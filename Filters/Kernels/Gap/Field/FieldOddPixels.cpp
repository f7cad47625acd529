#include "Kernels/Gap/Field/FieldOddPixels.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Gap/ReportParts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace msi
{

namespace
{
constexpr double DarkFrame = 0.25; // of the mean of all

using ImageValues = Eigen::Map<const Eigen::ArrayXXf>; // K x pixels

// Numbers of the pixels that are 0 in all channels, from the border on.
std::vector<Eigen::Index> zerosFromBorder(const ImageValues& image, const ImageExtent& extent)
{
  std::vector<char> known(image.cols(), 0);
  std::vector<Eigen::Index> zeros;
  const auto look = [&](Eigen::Index x, Eigen::Index y)
  {
    const Eigen::Index pixel = y * extent.width + x;
    if (x >= 0 && y >= 0 && x < extent.width && y < extent.height && known[pixel] == 0 &&
      (image.col(pixel) == 0.0F).all())
    {
      known[pixel] = 1;
      zeros.push_back(pixel);
    }
  };
  for (int i = 0; i < std::max(extent.width, extent.height); ++i)
  {
    look(i, 0);
    look(i, extent.height - 1);
    look(0, i);
    look(extent.width - 1, i);
  }
  for (std::size_t next = 0; next < zeros.size();)
  {
    const Eigen::Index pixel = zeros[next++];
    const Eigen::Index x = pixel % extent.width;
    const Eigen::Index y = pixel / extent.width;
    look(x - 1, y);
    look(x + 1, y);
    look(x, y - 1);
    look(x, y + 1);
  }
  return zeros;
}

template <typename Values>
double meanOf(const Values& values)
{
  const auto known = values.isFinite();
  return known.select(values.template cast<double>(), 0.0).sum() /
    std::fmax(static_cast<double>(known.count()), 1.0);
}

// The gap of a pixel of a block, beside that of its neighbours.
struct LonePixel
{
  float* real;
  double difference; // to their median
  bool outside;      // of their range, by more than that
};

std::vector<LonePixel> lonePixels(FieldData& data, std::size_t channel)
{
  const FieldPair& pair = data.pair;
  const std::size_t K = pair.channels.size();
  const double unit = data.unit[channel];
  const auto gap = [&](int x, int y)
  {
    const std::size_t value = pair.index(x, y) * K + channel;
    return static_cast<double>(pair.real[value]) / unit - static_cast<double>(data.scene()[value]);
  };
  std::vector<LonePixel> pixels;
  std::vector<double> others; // of the neighbours
  for (FieldBlock& block : data.blocks)
  {
    for (int i = 0; i < static_cast<int>(block.window.pixels()); ++i)
    {
      float& real = block.real[i * K + channel];
      const ImagePlace place = block.place(i);
      const ImageWindow near = grown({ place.x, place.y, 1, 1 }, 1, pair.extent);
      others.clear();
      for (int y = near.y; y < near.y + near.height; ++y)
      {
        for (int x = near.x; x < near.x + near.width; ++x)
        {
          const double value = gap(x, y);
          if (std::isfinite(value) && (x != place.x || y != place.y))
          {
            others.push_back(value);
          }
        }
      }
      if (std::isfinite(real) && others.size() > 2)
      {
        std::sort(others.begin(), others.end());
        const double own = gap(place.x, place.y);
        const double middle = others[others.size() / 2];
        // But for one each, which may be defect, too.
        const double low = others[1];
        const double high = others[others.size() - 2];
        pixels.push_back({ &real, std::fabs(own - middle),
          own > high + (high - low) || own < low - (high - low) });
      }
    }
  }
  return pixels;
}

std::size_t leftOutPixels(const FieldData& data)
{
  std::size_t pixels = 0;
  for (const ImageWindow& window : data.leftOut)
  {
    pixels += window.pixels();
  }
  return pixels;
}

// By how steep the simulated image is there: pixels of one kind are as many as those of another, pixels x blocks.
Eigen::MatrixXi kindsOfPixels(const FieldData& data)
{
  constexpr Eigen::Index Kinds = 8;
  const Eigen::Index rows = data.blocks.front().window.pixels();
  const Eigen::Index K = data.channels();
  Eigen::ArrayXXd slope(rows, data.blocks.size());
  const ImageExtent& extent = data.pair.extent;
  const auto scene = [&](int x, int y)
  {
    const auto pixel =
      data.pair.index(std::clamp(x, 0, extent.width - 1), std::clamp(y, 0, extent.height - 1));
    return Eigen::Map<const Eigen::ArrayXf>(data.scene() + pixel * K, K);
  };
  for (Eigen::Index b = 0; b < slope.cols(); ++b)
  {
    for (Eigen::Index p = 0; p < rows; ++p)
    {
      const auto [x, y] = data.blocks[b].place(static_cast<int>(p));
      slope(p, b) = static_cast<double>((
        (scene(x + 1, y) - scene(x - 1, y)).square() + (scene(x, y + 1) - scene(x, y - 1)).square())
                                          .sum());
    }
  }
  std::vector<Eigen::Index> order(slope.size());
  std::iota(order.begin(), order.end(), Eigen::Index(0));
  std::stable_sort(order.begin(), order.end(),
    [&slope](Eigen::Index a, Eigen::Index b) { return slope(a) < slope(b); });
  Eigen::MatrixXi kind(slope.rows(), slope.cols());
  for (std::size_t n = 0; n < order.size(); ++n)
  {
    kind(order[n]) = static_cast<int>(Kinds * static_cast<Eigen::Index>(n) / slope.size());
  }
  return kind;
}
}

FieldPair withoutFrame(FieldPair pair)
{
  const auto values = [&](const float* image) -> ImageValues
  {
    return { image, static_cast<Eigen::Index>(pair.channels.size()),
      static_cast<Eigen::Index>(pair.pixels()) };
  };
  const std::size_t side = std::min(pair.extent.width, pair.extent.height);
  const ImageValues simulated = values(pair.simulated);
  const auto take = [&](const float*& image, const ImageValues& other)
  {
    const std::vector<Eigen::Index> frame = zerosFromBorder(values(image), pair.extent);
    if (2 * frame.size() >= side && 2 * frame.size() <= pair.pixels() &&
      meanOf(other(Eigen::all, frame)) >= DarkFrame * meanOf(other))
    {
      Eigen::MatrixXf inside = values(image);
      inside(Eigen::all, frame).setConstant(std::numeric_limits<float>::quiet_NaN());
      pair.own.push_back(std::make_shared<const Eigen::MatrixXf>(std::move(inside)));
      image = pair.own.back()->data();
      pair.framePart += static_cast<double>(frame.size()) / static_cast<double>(pair.pixels());
    }
  };
  const ImageValues real = values(pair.real);
  take(pair.real, simulated);
  take(pair.simulated, real);
  return pair;
}

void leaveOutDefects(FieldData& data)
{
  double all = 0.0;
  double defect = 0.0;
  for (std::size_t k = 0; k < data.pair.channels.size(); ++k)
  {
    std::vector<LonePixel> pixels = lonePixels(data, k);
    all += static_cast<double>(pixels.size());
    // Until no others stand out, as large ones hide small ones.
    for (bool more = true; more;)
    {
      double energy = 0.0;
      for (const LonePixel& pixel : pixels)
      {
        energy += pixel.difference * pixel.difference;
      }
      const double limit =
        Decision::OutlierDeviations * std::sqrt(energy / static_cast<double>(pixels.size()));
      const auto defects = std::partition(pixels.begin(), pixels.end(),
        [limit](const LonePixel& pixel) { return !pixel.outside || pixel.difference <= limit; });
      more = defects != pixels.end();
      defect += static_cast<double>(pixels.end() - defects);
      std::for_each(defects, pixels.end(),
        [](const LonePixel& pixel) { *pixel.real = std::numeric_limits<float>::quiet_NaN(); });
      pixels.erase(defects, pixels.end());
    }
  }
  data.defectPart = defect / std::fmax(all, 1.0);
}

void leaveOut(FieldData& data, const IndexList& pixels)
{
  const Eigen::Index size = data.blocks.front().window.pixels();
  const std::size_t K = data.pair.channels.size();
  std::map<Eigen::Index, std::vector<int>> ofBlocks;
  for (const Eigen::Index pixel : pixels)
  {
    ofBlocks[pixel / size].push_back(static_cast<int>(pixel % size));
  }
  for (auto entry = ofBlocks.rbegin(); entry != ofBlocks.rend(); ++entry)
  {
    const auto block = data.blocks.begin() + entry->first;
    if (static_cast<Eigen::Index>(entry->second.size()) == size)
    {
      const auto before = std::remove_if(data.leftOut.begin(), data.leftOut.end(),
        [&](const ImageWindow& pixel) { return block->window.contains(pixel); });
      data.leftOut.erase(before, data.leftOut.end());
      data.leftOut.push_back(block->window);
      data.blocks.erase(block);
      continue;
    }
    for (const int pixel : entry->second)
    {
      const ImagePlace place = block->place(pixel);
      data.leftOut.push_back({ place.x, place.y, 1, 1 });
      std::fill_n(block->real.begin() + pixel * K, K, std::numeric_limits<float>::quiet_NaN());
    }
  }
}

IndexList oddPixels(const FieldData& data, const FieldWeights& weights, const FieldModel& nominal,
  const FieldModel& found)
{
  const std::vector<FieldResidual> before = fieldResiduals(data, nominal, true);
  const std::vector<FieldResidual> after = fieldResiduals(data, found, true);
  const Eigen::Index rows = data.blocks.front().window.pixels();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(rows, data.blocks.size());
  Eigen::MatrixXd count = sum;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    const std::size_t block = i / data.pair.channels.size();
    const CameraNoise& noise = weights.noise[i % data.pair.channels.size()];
    for (Eigen::Index n = 0; n < before[i].residual.size(); ++n)
    {
      const Eigen::Index pixel = before[i].pixel[n];
      const double left =
        std::fmin(std::fabs(before[i].residual[n]), std::fabs(after[i].residual[n]));
      sum(pixel, block) += left * left / noiseVariance(noise, after[i].level[n]);
      count(pixel, block) += 1.0;
    }
  }
  return oddElements(
    sum.cwiseQuotient(count), kindsOfPixels(data), leftOutPixels(data)); // 0 / 0: none
}

// Which pixels, one of those that lie near each other, from the first on.
std::string oddPixelsNote(const FieldData& data, const std::string& consequence)
{
  constexpr std::size_t MostPlaces = 3;
  constexpr double NearPixels = 64.0;
  std::vector<Eigen::Vector2d> places;
  std::string text;
  for (const ImageWindow& window : data.leftOut)
  {
    const Eigen::Vector2d place = middleOf(data.pair, window);
    const bool named = std::any_of(places.begin(), places.end(),
      [&](const Eigen::Vector2d& other) { return (place - other).norm() < NearPixels; });
    if (!named && places.size() < MostPlaces)
    {
      places.push_back(place);
      text +=
        textOf(2, text.empty() ? "" : "; ", "x ", data.pair.fieldX(window.x + 0.5 * window.width),
          ", y ", data.pair.fieldY(window.y + 0.5 * window.height));
    }
  }
  const std::size_t left = leftOutPixels(data);
  std::size_t all = left;
  for (const FieldBlock& block : data.blocks)
  {
    all += block.window.pixels();
  }
  return textOf(2, "Odd? ", 100.0 * static_cast<double>(left) / static_cast<double>(all),
    " % of the pixels looked at", consequence, ": far from what is found in all others. Look near ",
    text, " of the field for dust, glare, a shadow or something that moved.");
}

} // namespace msi
