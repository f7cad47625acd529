#include "Kernels/Camera/Imaging/ChannelDisplacement.h"

#include "Kernels/Numerics/Angle.h"
#include "Kernels/Spectra/Reject.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace msi
{

namespace
{
constexpr int WindowSide = 12;
constexpr int TileSide = 128;
constexpr int TilesPerSide = 4;
constexpr int MostLevels = 3;
constexpr int WidestStart = 3; // pixels of the coarsest level
constexpr double PriceOfShift = 0.02;
constexpr int MostSteps = 30;
constexpr double LargestShift = 16.0;  // pixels
constexpr double LargestStep = 1.5;    // pixels of a level, at the image's corner
constexpr double SmallestStep = 1e-3;  // the same
constexpr double RelativeNoise = 1e-3; // of the mean: what a window leaves unexplained at least

// One channel of a tile, at some level of the pyramid: every step-th pixel.
struct Plane
{
  int width = 0;
  int height = 0;
  std::vector<float> values;

  float at(int x, int y) const noexcept
  {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(x)];
  }
};

Plane planeOf(const PixelBuffer& tile, int channel)
{
  Plane plane{ tile.window.width, tile.window.height, {} };
  plane.values.reserve(tile.window.pixels());
  for (std::size_t i = 0; i < tile.window.pixels(); ++i)
  {
    plane.values.push_back(
      tile.values[i * static_cast<std::size_t>(tile.channels) + static_cast<std::size_t>(channel)]);
  }
  return plane;
}

// The binomial filter 1 4 6 4 1 along both axes; the edge repeats.
Plane smoothed(const Plane& plane)
{
  constexpr std::array<float, 5> Weights{ 0.0625F, 0.25F, 0.375F, 0.25F, 0.0625F };
  const auto pass = [&Weights](const Plane& in, int alongX, int alongY)
  {
    Plane out{ in.width, in.height, {} };
    out.values.reserve(in.values.size());
    for (int y = 0; y < in.height; ++y)
    {
      for (int x = 0; x < in.width; ++x)
      {
        float sum = 0.0F;
        int offset = -2;
        for (const float weight : Weights)
        {
          sum += weight *
            in.at(std::clamp(x + offset * alongX, 0, in.width - 1),
              std::clamp(y + offset * alongY, 0, in.height - 1));
          ++offset;
        }
        out.values.push_back(sum);
      }
    }
    return out;
  };
  return pass(pass(plane, 1, 0), 0, 1);
}

Plane halved(const Plane& plane)
{
  Plane out{ (plane.width + 1) / 2, (plane.height + 1) / 2, {} };
  for (int y = 0; y < plane.height; y += 2)
  {
    for (int x = 0; x < plane.width; x += 2)
    {
      out.values.push_back(plane.at(x, y));
    }
  }
  return out;
}

std::vector<Plane> pyramid(const PixelBuffer& tile, int channel, int levels)
{
  std::vector<Plane> result{ smoothed(planeOf(tile, channel)) };
  while (static_cast<int>(result.size()) < levels)
  {
    result.push_back(smoothed(halved(result.back())));
  }
  return result;
}

// Value and derivatives at a place that is at least a pixel from the edge, two from the far one.
struct Sample
{
  float value;
  float alongX;
  float alongY;
};

Sample sampleAt(const Plane& plane, int x, int y, float fractionX, float fractionY)
{
  const Eigen::Array4f across = cubicConvolution(fractionX);
  const Eigen::Array4f acrossSlope = cubicConvolutionSlope(fractionX);
  const Eigen::Array4f down = cubicConvolution(fractionY);
  const Eigen::Array4f downSlope = cubicConvolutionSlope(fractionY);
  Sample sample{ 0.0F, 0.0F, 0.0F };
  for (int v = 0; v < 4; ++v)
  {
    const Eigen::Map<const Eigen::Array4f> row(
      plane.values.data() + static_cast<std::ptrdiff_t>(y - 1 + v) * plane.width + (x - 1));
    const float value = (across * row).sum();
    sample.value += down[v] * value;
    sample.alongX += down[v] * (acrossSlope * row).sum();
    sample.alongY += downSlope[v] * value;
  }
  return sample;
}

// A displacement as it is searched for: all four in pixels, the last two at the image's corner.
using Vector4 = Eigen::Vector4d;

struct Frame
{
  double middleX;
  double middleY;
  double corner;

  explicit Frame(const ImageExtent& extent)
    : middleX(0.5 * (extent.width - 1))
    , middleY(0.5 * (extent.height - 1))
    , corner(0.5 * std::hypot(extent.width, extent.height))
  {
  }
};

// What one window says of the displacement.
struct WindowEquations
{
  Eigen::Matrix4d normal; // J'J
  Vector4 gradient;       // J'e
  double residual;        // e'e / pixels
  double variance;        // of the reference
};

class LevelSearch
{
public:
  LevelSearch(const Plane& reference, const Plane& moving, const ImageWindow& window, int step,
    const Frame& frame)
    : Reference(reference)
    , Moving(moving)
    , Place(window)
    , Step(step)
    , Center(frame)
  {
  }

  void add(const Vector4& at, double floorOfVariance, std::vector<WindowEquations>& equations) const
  {
    // What does not fill a window is left at both edges alike.
    const int left = Reference.width % WindowSide / 2;
    const int top = Reference.height % WindowSide / 2;
    for (int y = top; y + WindowSide <= Reference.height; y += WindowSide)
    {
      for (int x = left; x + WindowSide <= Reference.width; x += WindowSide)
      {
        addWindow(x, y, at, floorOfVariance, equations);
      }
    }
  }

private:
  void addWindow(int firstX, int firstY, const Vector4& at, double floorOfVariance,
    std::vector<WindowEquations>& equations) const
  {
    constexpr int Pixels = WindowSide * WindowSide;
    Eigen::Matrix<double, Pixels, 1> reference;
    Eigen::Matrix<double, Pixels, 1> moving;
    Eigen::Matrix<double, Pixels, 4> slopes;
    const double scale = 1.0 + at[2] / Center.corner;
    const double cosine = scale * std::cos(at[3] / Center.corner);
    const double sine = scale * std::sin(at[3] / Center.corner);
    for (int i = 0; i < Pixels; ++i)
    {
      const int x = firstX + i % WindowSide;
      const int y = firstY + i / WindowSide;
      const double offX = Place.x + x * Step - Center.middleX;
      const double offY = Place.y + y * Step - Center.middleY;
      const double u = (Center.middleX + cosine * offX - sine * offY + at[0] - Place.x) /
        static_cast<double>(Step);
      const double v = (Center.middleY + sine * offX + cosine * offY + at[1] - Place.y) /
        static_cast<double>(Step);
      if (!(u >= 1.0 && v >= 1.0 && u < Moving.width - 2 && v < Moving.height - 2))
      {
        return;
      }
      const auto left = static_cast<int>(u);
      const auto top = static_cast<int>(v);
      const Sample sample =
        sampleAt(Moving, left, top, static_cast<float>(u - left), static_cast<float>(v - top));
      reference[i] = Reference.at(x, y);
      moving[i] = sample.value;
      const double alongX = sample.alongX / Step;
      const double alongY = sample.alongY / Step;
      slopes.row(i) << alongX, alongY, (alongX * offX + alongY * offY) / Center.corner,
        (alongY * offX - alongX * offY) / Center.corner;
    }
    if (!std::isfinite(reference.sum()) || !std::isfinite(moving.sum()))
    {
      return;
    }
    reference.array() -= reference.mean();
    moving.array() -= moving.mean();
    slopes.rowwise() -= slopes.colwise().mean().eval();
    // Noise of the channel must not count as structure that explains.
    const double power = moving.squaredNorm() + floorOfVariance * Pixels;
    const double gain = reference.dot(moving) / power;
    reference -= gain * moving;
    const double variance = (reference + gain * moving).squaredNorm() / Pixels;
    slopes -= moving * ((moving.transpose() * slopes) / power).eval();
    slopes *= gain;
    equations.push_back({ slopes.transpose() * slopes, slopes.transpose() * reference,
      reference.squaredNorm() / Pixels, variance });
  }

  const Plane& Reference;
  const Plane& Moving;
  ImageWindow Place;
  int Step;
  Frame Center;
};

double medianResidual(const std::vector<WindowEquations>& equations)
{
  std::vector<double> residuals;
  residuals.reserve(equations.size());
  for (const WindowEquations& window : equations)
  {
    residuals.push_back(window.residual);
  }
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  return *middle;
}

// The weighted sums of all windows, and the scatter of their contributions.
struct Equations
{
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d scatter = Eigen::Matrix4d::Zero();
  Vector4 gradient = Vector4::Zero();
};

Equations weighted(const std::vector<WindowEquations>& windows, double usual)
{
  Equations sum;
  for (const WindowEquations& window : windows)
  {
    const double weight = 1.0 / (usual + window.residual);
    const Vector4 gradient = weight * window.gradient;
    sum.normal += weight * window.normal;
    sum.gradient += gradient;
    sum.scatter += gradient * gradient.transpose();
  }
  return sum;
}

// What the weights minimize, per window; infinite where there is none.
double costOf(const std::vector<WindowEquations>& windows, double usual)
{
  double sum = 0.0;
  for (const WindowEquations& window : windows)
  {
    sum += std::log(usual + window.residual);
  }
  return windows.empty() ? std::numeric_limits<double>::infinity()
                         : sum / static_cast<double>(windows.size());
}

// The leading unknowns of the model; false where the image does not determine them.
bool solve(const Equations& equations, Eigen::Index unknowns, Vector4& step, Vector4& deviation)
{
  const Eigen::MatrixXd normal = equations.normal.topLeftCorner(unknowns, unknowns);
  const Eigen::LDLT<Eigen::MatrixXd> factor(normal);
  const Eigen::VectorXd pivots = factor.vectorD();
  step.setZero();
  deviation.setConstant(std::numeric_limits<double>::infinity());
  constexpr double LeastPivot = 1e-9;
  if (!(pivots.minCoeff() > LeastPivot * std::max(1.0, pivots.maxCoeff())))
  {
    return false;
  }
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  step.head(unknowns) = inverse * equations.gradient.head(unknowns);
  deviation.setZero();
  deviation.head(unknowns) =
    (inverse * equations.scatter.topLeftCorner(unknowns, unknowns) * inverse)
      .diagonal()
      .cwiseMax(0.0)
      .cwiseSqrt();
  return true;
}

double agreementOf(const std::vector<WindowEquations>& windows)
{
  double left = 0.0;
  double whole = 0.0;
  for (const WindowEquations& window : windows)
  {
    left += window.residual;
    whole += window.variance;
  }
  return whole > 0.0 ? std::clamp(1.0 - left / whole, 0.0, 1.0) : 0.0;
}

// The shift by whole pixels of a level that agrees best: where the steps begin. Contrasts do not tell the patches of a
// chart from one another, so a shift near the period of its grid agrees as well: the shorter one is preferred.
template <typename WindowsAt>
Vector4 bestShift(int level, const WindowsAt& windowsAt)
{
  Vector4 best = Vector4::Zero();
  double most = agreementOf(windowsAt(level, best));
  const auto enough = windowsAt(level, best).size() / 2;
  for (int y = -WidestStart; y <= WidestStart; ++y)
  {
    for (int x = -WidestStart; x <= WidestStart; ++x)
    {
      const Vector4 at(x * (1 << level), y * (1 << level), 0.0, 0.0);
      const std::vector<WindowEquations> windows = windowsAt(level, at);
      const double agreement = agreementOf(windows) - PriceOfShift * (x * x + y * y);
      if (agreement > most && windows.size() >= enough)
      {
        most = agreement;
        best = at;
      }
    }
  }
  return best;
}

// Square of a thousandth of the finite values' root mean square.
double floorOf(const std::vector<PixelBuffer>& tiles, int channel)
{
  double sum = 0.0;
  double count = 0.0;
  for (const PixelBuffer& tile : tiles)
  {
    for (std::size_t i = static_cast<std::size_t>(channel); i < tile.values.size();
         i += static_cast<std::size_t>(tile.channels))
    {
      const double value = tile.values[i];
      sum += std::isfinite(value) ? value * value : 0.0;
      count += std::isfinite(value) ? 1.0 : 0.0;
    }
  }
  return count > 0.0 ? RelativeNoise * RelativeNoise * sum / count : 0.0;
}
}

DisplacementSearch::DisplacementSearch(
  const std::vector<PixelBuffer>& tiles, const ImageExtent& extent, DisplacementModel model)
  : Tiles(tiles)
  , Extent(extent)
  , Model(model)
{
  if (tiles.empty())
  {
    reject("there is no tile of the image; expected at least 1");
  }
  for (const PixelBuffer& tile : tiles)
  {
    if (std::min(tile.window.width, tile.window.height) < LeastTileSide)
    {
      reject("the image is ", extent.width, " x ", extent.height, " pixels; expected at least ",
        LeastTileSide, " on each side to find the channels' displacements");
    }
  }
}

ChannelDisplacement DisplacementSearch::operator()(int reference, int channel) const
{
  if (channel == reference)
  {
    return {};
  }
  int smallest = TileSide;
  for (const PixelBuffer& tile : Tiles)
  {
    smallest = std::min({ smallest, tile.window.width, tile.window.height });
  }
  int levels = 1;
  while (levels < MostLevels && (smallest >> levels) >= LeastTileSide)
  {
    ++levels;
  }
  std::vector<std::vector<Plane>> references;
  std::vector<std::vector<Plane>> movings;
  for (const PixelBuffer& tile : Tiles)
  {
    references.push_back(pyramid(tile, reference, levels));
    movings.push_back(pyramid(tile, channel, levels));
  }
  const Frame frame(Extent);
  const double floorOfVariance = floorOf(Tiles, channel);
  const Eigen::Index unknowns = Model == DisplacementModel::Shift ? 2 : 4;
  const auto windowsAt = [&](int level, const Vector4& place)
  {
    std::vector<WindowEquations> windows;
    for (std::size_t tile = 0; tile < Tiles.size(); ++tile)
    {
      const auto l = static_cast<std::size_t>(level);
      LevelSearch(references[tile][l], movings[tile][l], Tiles[tile].window, 1 << level, frame)
        .add(place, floorOfVariance, windows);
    }
    return windows;
  };

  Vector4 at = bestShift(levels - 1, windowsAt);
  Vector4 deviation = Vector4::Constant(std::numeric_limits<double>::infinity());
  double agreement = 0.0;
  for (int level = levels - 1; level >= 0; --level)
  {
    std::vector<WindowEquations> windows = windowsAt(level, at);
    const double usual = windows.empty() ? 0.0 : medianResidual(windows) + floorOfVariance;
    for (int i = 0; i < MostSteps; ++i)
    {
      Vector4 move = Vector4::Zero();
      if (windows.empty() || !solve(weighted(windows, usual), unknowns, move, deviation))
      {
        deviation.setConstant(std::numeric_limits<double>::infinity());
        break;
      }
      agreement = agreementOf(windows);
      double length = move.cwiseAbs().maxCoeff() / (1 << level);
      move *= std::min(1.0, LargestStep / length);
      const double before = costOf(windows, usual);
      std::vector<WindowEquations> next = windowsAt(level, at + move);
      while (length > SmallestStep && !(costOf(next, usual) < before))
      {
        move *= 0.5;
        length *= 0.5;
        next = windowsAt(level, at + move);
      }
      if (!(length > SmallestStep))
      {
        break;
      }
      at += move;
      windows = std::move(next);
    }
  }
  if (!(at.head<2>().cwiseAbs().maxCoeff() <= LargestShift))
  {
    deviation.setConstant(std::numeric_limits<double>::infinity());
  }
  const double degrees = 1.0 / (frame.corner * Degree);
  ChannelDisplacement found{ at[0], at[1], at[2] / frame.corner, at[3] * degrees,
    { deviation[0], deviation[1], deviation[2] / frame.corner, deviation[3] * degrees },
    agreement };
  return found;
}

ChannelDisplacement composed(const ChannelDisplacement& first, const ChannelDisplacement& second)
{
  const double cosine = (1.0 + second.magnification) * std::cos(second.rotation * Degree);
  const double sine = (1.0 + second.magnification) * std::sin(second.rotation * Degree);
  ChannelDisplacement both;
  both.right = cosine * first.right - sine * first.down + second.right;
  both.down = sine * first.right + cosine * first.down + second.down;
  both.magnification = (1.0 + first.magnification) * (1.0 + second.magnification) - 1.0;
  both.rotation = first.rotation + second.rotation;
  both.standardError = (first.standardError.square() + second.standardError.square()).sqrt();
  both.agreement = std::min(first.agreement, second.agreement);
  return both;
}

double structureOf(const std::vector<PixelBuffer>& tiles, int channel)
{
  double sum = 0.0;
  for (const PixelBuffer& tile : tiles)
  {
    const Plane plane = smoothed(planeOf(tile, channel));
    for (int y = 1; y < plane.height; ++y)
    {
      for (int x = 1; x < plane.width; ++x)
      {
        const double change =
          std::hypot(plane.at(x, y) - plane.at(x - 1, y), plane.at(x, y) - plane.at(x, y - 1));
        sum += std::isfinite(change) ? change * change : 0.0;
      }
    }
  }
  const double level = floorOf(tiles, channel);
  return level > 0.0 ? sum / level : 0.0;
}

std::vector<ImageWindow> displacementTiles(const ImageExtent& extent)
{
  const auto placesOf = [](int length)
  {
    std::vector<int> places;
    for (int i = 0; length > TilesPerSide * TileSide && i < TilesPerSide; ++i)
    {
      places.push_back((length - TileSide) * i / (TilesPerSide - 1));
    }
    return places;
  };
  const std::vector<int> acrosses = placesOf(extent.width);
  const std::vector<int> downs = placesOf(extent.height);
  const int width = acrosses.empty() ? extent.width : TileSide;
  const int height = downs.empty() ? extent.height : TileSide;
  std::vector<ImageWindow> tiles;
  for (const int y : downs.empty() ? std::vector<int>{ 0 } : downs)
  {
    for (const int x : acrosses.empty() ? std::vector<int>{ 0 } : acrosses)
    {
      tiles.push_back({ x, y, width, height });
    }
  }
  return tiles;
}

ChannelRegistration undoing(
  const std::vector<ChannelDisplacement>& displacements, const ImageExtent& extent)
{
  std::vector<ImageDisplacement> back;
  for (const ChannelDisplacement& d : displacements)
  {
    const double scale = 1.0 / (1.0 + d.magnification);
    const double cosine = scale * std::cos(d.rotation * Degree);
    const double sine = scale * std::sin(d.rotation * Degree);
    back.push_back({ -(cosine * d.right + sine * d.down), -(cosine * d.down - sine * d.right),
      scale - 1.0, -d.rotation });
  }
  return { std::move(back), extent };
}

ShownPixels::ShownPixels(const ChannelDisplacement& d, const ImageExtent& extent) noexcept
  : Extent(extent)
  , MiddleX(Frame(extent).middleX)
  , MiddleY(Frame(extent).middleY)
  , Right(d.right)
  , Down(d.down)
  , Cosine((1.0 + d.magnification) * std::cos(d.rotation * Degree))
  , Sine((1.0 + d.magnification) * std::sin(d.rotation * Degree))
{
}

bool ShownPixels::contain(int x, int y) const noexcept
{
  const double offX = x - MiddleX;
  const double offY = y - MiddleY;
  const double u = MiddleX + Cosine * offX - Sine * offY + Right;
  const double v = MiddleY + Sine * offX + Cosine * offY + Down;
  // Rounding of a displacement that is a whole number must not take the last row away.
  constexpr double Rounding = 1e-6;
  return u >= -Rounding && v >= -Rounding && u <= Extent.width - 1 + Rounding &&
    v <= Extent.height - 1 + Rounding;
}

} // namespace msi
