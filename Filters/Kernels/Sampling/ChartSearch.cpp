#include "Kernels/Sampling/ChartSearch.h"

#include "Kernels/Sampling/EvenRegions.h"
#include "Kernels/Sampling/Homography.h"
#include "Kernels/Sampling/PatchLattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace msi
{

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double LeastAgreement = 0.5;

void require(const ChartImage& image, const ChartSearchOptions& options)
{
  const auto patches = static_cast<Eigen::Index>(options.columns) * options.rows;
  if (options.columns < 2 || options.rows < 2)
  {
    throw std::invalid_argument("a chart of " + std::to_string(options.columns) + " x " +
      std::to_string(options.rows) + " patches cannot be searched for; expected at least 2 x 2");
  }
  if (options.expected.size() > 0 &&
    (options.expected.cols() != patches || options.expected.rows() != image.values.rows()))
  {
    throw std::invalid_argument("expected responses of " + std::to_string(options.expected.cols()) +
      " patches in " + std::to_string(options.expected.rows()) + " channels; the chart has " +
      std::to_string(patches) + " patches and the image " + std::to_string(image.values.rows()) +
      " channels");
  }
}

// Mean of each patch in the small image; NaN where it has no finite pixel.
Eigen::MatrixXd patchMeans(const ChartImage& image, const PatchGrid& grid)
{
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(image.values.rows(), grid.patches());
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(grid.patches());
  for (int y = 0; y < image.height; ++y)
  {
    for (int x = 0; x < image.width; ++x)
    {
      const auto place = image.original({ x, y });
      const int label = grid.labelAt(place.x(), place.y());
      const auto pixel = image.at(x, y);
      if (label > 0 && pixel.allFinite())
      {
        // Square roots; the response is their square.
        sums.col(label - 1) += pixel.cast<double>().cwiseAbs2();
        counts[label - 1] += 1.0;
      }
    }
  }
  for (Eigen::Index i = 0; i < sums.cols(); ++i)
  {
    sums.col(i) = counts[i] > 0.0 ? Eigen::VectorXd(sums.col(i) / counts[i])
                                  : Eigen::VectorXd::Constant(sums.rows(), NaN);
  }
  return sums;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), static_cast<Eigen::Index>(a.size()));
  const Eigen::Map<const Eigen::ArrayXd> y(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::ArrayXd dx = x - x.mean();
  const Eigen::ArrayXd dy = y - y.mean();
  const double size = std::sqrt(dx.square().sum() * dy.square().sum());
  return size > 0.0 ? (dx * dy).sum() / size : 0.0;
}

double agreementOf(const Eigen::MatrixXd& means, const Eigen::MatrixXd& expected)
{
  constexpr double Darkest = 0.005; // below it noise and stray light decide
  double sum = 0.0;
  int channels = 0;
  for (Eigen::Index k = 0; k < expected.rows(); ++k)
  {
    std::vector<double> a;
    std::vector<double> b;
    for (Eigen::Index i = 0; i < expected.cols(); ++i)
    {
      if (std::isfinite(means(k, i)) && std::isfinite(expected(k, i)))
      {
        a.push_back(std::log(std::max(means(k, i), Darkest)));
        b.push_back(std::log(std::max(expected(k, i), Darkest)));
      }
    }
    if (a.size() > 2)
    {
      sum += correlation(a, b);
      ++channels;
    }
  }
  return channels > 0 ? sum / channels : NaN;
}

// A window of the lattice and how it is turned: the cells of the first patch, the end of the first row, the last patch
// and the start of the last row.
using Window = std::array<Eigen::Vector2d, 4>;

struct Candidate
{
  Window cells;
  int seen = 0;
  int outside = 0;
};

// All windows that hold as many regions as any but for a row or column that may have gone unseen.
std::vector<Candidate> windowsOf(const PatchLattice& lattice, int columns, int rows)
{
  int left = std::numeric_limits<int>::max();
  int top = left;
  int right = std::numeric_limits<int>::min();
  int bottom = right;
  for (const auto& [cell, place] : lattice.places)
  {
    left = std::min(left, cell.first);
    right = std::max(right, cell.first);
    top = std::min(top, cell.second);
    bottom = std::max(bottom, cell.second);
  }
  std::vector<Candidate> candidates;
  for (const bool turned : { false, true })
  {
    const int width = turned ? rows : columns;
    const int height = turned ? columns : rows;
    for (int x = left - width + 1; x <= right; ++x)
    {
      for (int y = top - height + 1; y <= bottom; ++y)
      {
        Candidate candidate;
        for (const auto& [cell, place] : lattice.places)
        {
          const bool inside = cell.first >= x && cell.first < x + width && cell.second >= y &&
            cell.second < y + height;
          ++(inside ? candidate.seen : candidate.outside);
        }
        const double x0 = x - 0.5;
        const double y0 = y - 0.5;
        const double x1 = x0 + width;
        const double y1 = y0 + height;
        const Window around{ { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } } };
        // The first row runs to the right or, turned by 90 degrees clockwise, downward; or the other way round.
        for (std::size_t turn = turned ? 1 : 0; turn < 4; turn += 2)
        {
          for (std::size_t i = 0; i < 4; ++i)
          {
            candidate.cells[i] = around[(i + turn) % 4];
          }
          candidates.push_back(candidate);
        }
      }
    }
  }
  int most = 0;
  for (const auto& candidate : candidates)
  {
    most = std::max(most, candidate.seen);
  }
  const int least = std::max(most - std::max(columns, rows), most / 2);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                     [least](const Candidate& candidate) { return candidate.seen < least; }),
    candidates.end());
  return candidates;
}

PatchGrid::Corners cornersOf(
  const ChartImage& image, const PatchLattice& lattice, const Window& cells)
{
  PatchGrid::Corners corners;
  for (std::size_t i = 0; i < 4; ++i)
  {
    corners[i] = image.original(mapPoint(lattice.toImage, cells[i]));
  }
  return corners;
}

// Without expected colors: the first patch at the top left, the first row to the right.
double uprightness(const PatchGrid::Corners& corners)
{
  const Eigen::Vector2d along = (corners[1] - corners[0]).normalized();
  return along.x();
}

struct Judged
{
  ChartPlacement placement;
  double score = 0.0;
};

bool isConvex(const ChartSearchOptions& options, const PatchGrid::Corners& corners)
{
  try
  {
    PatchGrid(options.columns, options.rows, corners);
    return true;
  }
  catch (const std::invalid_argument&)
  {
    return false;
  }
}

std::vector<Judged> judge(
  const ChartImage& image, const ChartSearchOptions& options, const PatchLattice& lattice)
{
  std::vector<Judged> all;
  const double patches = static_cast<double>(options.columns) * options.rows;
  for (const auto& candidate : windowsOf(lattice, options.columns, options.rows))
  {
    const auto corners = cornersOf(image, lattice, candidate.cells);
    if (candidate.seen < options.leastSeen * patches || !isConvex(options, corners))
    {
      continue;
    }
    Judged judged;
    judged.placement.corners = corners;
    judged.placement.seen = candidate.seen;
    judged.placement.residual = lattice.residual;
    judged.placement.agreement = chartAgreement(image, options, corners);
    const double coverage = (candidate.seen - candidate.outside) / patches;
    judged.score = coverage +
      (std::isnan(judged.placement.agreement) ? 0.1 * uprightness(corners)
                                              : judged.placement.agreement);
    all.push_back(judged);
  }
  return all;
}

std::string sizeText(const ChartSearchOptions& options)
{
  return std::to_string(options.columns) + " x " + std::to_string(options.rows);
}
}

double chartAgreement(
  const ChartImage& image, const ChartSearchOptions& options, const PatchGrid::Corners& corners)
{
  require(image, options);
  if (options.expected.size() == 0)
  {
    return NaN;
  }
  return agreementOf(
    patchMeans(image, PatchGrid(options.columns, options.rows, corners)), options.expected);
}

ChartPlacement findChart(const ChartImage& image, const ChartSearchOptions& options)
{
  require(image, options);
  const auto least = static_cast<std::size_t>(
    std::max(4.0, std::ceil(options.leastSeen * options.columns * options.rows)));
  const auto regions = findEvenRegions(image);
  std::vector<Judged> all;
  for (const auto& lattice : findLattices(regions, least))
  {
    const auto more = judge(image, options, lattice);
    all.insert(all.end(), more.begin(), more.end());
  }
  if (all.empty())
  {
    throw std::runtime_error("no chart of " + sizeText(options) + " patches was found (" +
      std::to_string(regions.size()) +
      " even areas were seen); give its four corners, or an image in which it is larger");
  }
  const auto best = std::max_element(
    all.begin(), all.end(), [](const Judged& a, const Judged& b) { return a.score < b.score; });
  ChartPlacement placement = best->placement;
  placement.secondAgreement = -1.0;
  for (auto other = all.begin(); other != all.end(); ++other)
  {
    if (other != best)
    {
      placement.secondAgreement = std::max(placement.secondAgreement, other->placement.agreement);
    }
  }
  if (placement.agreement < LeastAgreement)
  {
    throw std::runtime_error("a grid of " + sizeText(options) +
      " patches was found, but its colors do not agree with the reference (correlation " +
      std::to_string(placement.agreement) +
      "); is it this chart? Give its four corners to sample it all the same");
  }
  return placement;
}

} // namespace msi
