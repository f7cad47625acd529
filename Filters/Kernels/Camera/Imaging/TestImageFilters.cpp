#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ChannelRegistration.h"
#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Camera/Imaging/SceneMean.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace
{
using msi::PixelBuffer;
using msi::test::messageOf;

constexpr msi::ImageExtent PictureExtent{ 161, 141 };
constexpr int CenterX = 80;
constexpr int CenterY = 70;

PixelBuffer pictureOf(int channels, const std::function<double(int, int, int)>& value)
{
  PixelBuffer buffer;
  buffer.resize(msi::wholeImage(PictureExtent), channels);
  for (int y = 0; y < PictureExtent.height; ++y)
  {
    for (int x = 0; x < PictureExtent.width; ++x)
    {
      for (int k = 0; k < channels; ++k)
      {
        buffer.pixel(x, y)[k] = static_cast<float>(value(x, y, k));
      }
    }
  }
  return buffer;
}

PixelBuffer impulse(int channels)
{
  return pictureOf(
    channels, [](int x, int y, int) { return x == CenterX && y == CenterY ? 1.0 : 0.0; });
}

struct Spread
{
  double sum = 0.0;
  double varianceX = 0.0;
  double varianceY = 0.0;
};

Spread spreadOf(const PixelBuffer& picture, int channel)
{
  Spread spread;
  for (int y = 0; y < PictureExtent.height; ++y)
  {
    for (int x = 0; x < PictureExtent.width; ++x)
    {
      const double value = static_cast<double>(picture.pixel(x, y)[channel]);
      spread.sum += value;
      spread.varianceX += value * (x - CenterX) * (x - CenterX);
      spread.varianceY += value * (y - CenterY) * (y - CenterY);
    }
  }
  return spread;
}

TEST(SeparableFilter, SpreadsAnImpulseIntoAGaussian)
{
  PixelBuffer picture = impulse(3);
  msi::convolve(msi::gaussianKernel(Eigen::Array3d(0.0, 1.5, 3.0)), picture);
  EXPECT_EQ(picture.pixel(CenterX, CenterY)[0], 1.0F);
  EXPECT_EQ(picture.pixel(CenterX + 1, CenterY)[0], 0.0F);
  for (const auto& [channel, deviation] : { std::pair{ 1, 1.5 }, std::pair{ 2, 3.0 } })
  {
    const Spread spread = spreadOf(picture, channel);
    EXPECT_NEAR(spread.sum, 1.0, 1e-6);
    // Cut at four deviations a Gaussian lacks 0.1 % of its variance.
    EXPECT_NEAR(spread.varianceX / (deviation * deviation), 1.0, 2e-3);
    EXPECT_NEAR(spread.varianceY / (deviation * deviation), 1.0, 2e-3);
    const double peak = static_cast<double>(picture.pixel(CenterX, CenterY)[channel]);
    const double beside = static_cast<double>(picture.pixel(CenterX + 2, CenterY + 1)[channel]);
    EXPECT_NEAR(beside / peak, std::exp(-0.5 * 5.0 / (deviation * deviation)), 1e-6);
  }
}

// Sum of sums in double precision, the edge repeated; weights of their own for every channel, holes in between.
TEST(SeparableFilter, IsTheSumOfItsDefinition)
{
  msi::SymmetricKernel kernel;
  kernel.weights =
    (Eigen::ArrayXXf(3, 3) << 0.5F, 0.2F, 0.05F, 0.4F, 0.25F, 0.05F, 1.0F, 0.0F, 0.0F).finished();
  const auto picture = [](int x, int y, int k)
  { return 0.5 + 0.3 * std::sin(0.7 * x + k) + 0.2 * std::cos(0.9 * y * x); };
  for (const int stride : { 1, 16, 70 })
  {
    kernel.stride = stride;
    PixelBuffer filtered = pictureOf(3, picture);
    msi::convolve(kernel, filtered);
    for (const auto& [x, y] : { std::pair{ 0, 0 }, std::pair{ 160, 3 }, std::pair{ 77, 140 },
           std::pair{ 33, 60 }, std::pair{ 159, 139 } })
    {
      for (int k = 0; k < 3; ++k)
      {
        double expected = 0.0;
        for (int i = -2; i <= 2; ++i)
        {
          for (int j = -2; j <= 2; ++j)
          {
            expected +=
              static_cast<double>(kernel.weights(k, std::abs(i)) * kernel.weights(k, std::abs(j))) *
              picture(std::clamp(x + i * stride, 0, PictureExtent.width - 1),
                std::clamp(y + j * stride, 0, PictureExtent.height - 1), k);
          }
        }
        ASSERT_NEAR(static_cast<double>(filtered.pixel(x, y)[k]), expected, 5e-7)
          << x << " " << y << " stride " << stride;
      }
    }
  }
}

TEST(ScatterTail, SpreadsAnImpulseToTheStatedVariance)
{
  const msi::ScatterTail tail(1.5);
  ASSERT_LT(tail.reach(), CenterY) << "the picture must hold the whole tail";
  PixelBuffer picture = impulse(1);
  PixelBuffer spreadOut;
  tail(picture, spreadOut);
  double expected = 0.0;
  double weights = 0.0;
  for (std::size_t n = 0; n < tail.weights().size(); ++n)
  {
    expected += static_cast<double>(tail.weights()[n]) * (std::pow(4.0, n + 1.0) - 1.0) / 3.0;
    weights += static_cast<double>(tail.weights()[n]);
  }
  const Spread spread = spreadOf(spreadOut, 0);
  EXPECT_NEAR(weights, 1.0, 1e-6);
  EXPECT_NEAR(spread.sum, 1.0, 1e-5);
  EXPECT_NEAR(spread.varianceX, expected, 1e-4 * expected);
  EXPECT_NEAR(spread.varianceY, expected, 1e-4 * expected);
}

TEST(ScatterTail, ReachesFartherWithALargerRadius)
{
  EXPECT_GT(msi::ScatterTail(16.0).reach(), msi::ScatterTail(4.0).reach());
  EXPECT_EQ(messageOf([] { msi::ScatterTail tail(0.5); }),
    "the radius of the stray light is 0.5 pixels; expected a value from 1 to 64");
}

TEST(ChannelRegistration, InterpolatesCubicsExactlyAndDetailBetterThanFourPoints)
{
  const auto places = [](Eigen::Index points) -> Eigen::ArrayXd
  {
    const double first = 1.0 - 0.5 * static_cast<double>(points);
    return Eigen::ArrayXd::LinSpaced(points, first, -first + 1.0);
  };
  const double detail = 0.6 * 3.141592653589793; // per pixel: three fifths of what pixels can show
  double six = 0.0;
  double four = 0.0;
  for (double t = 0.0; t <= 1.0; t += 0.0625)
  {
    const Eigen::ArrayXd weight = msi::sixPointConvolution(t);
    for (int power = 0; power <= 3; ++power)
    {
      EXPECT_NEAR((weight * places(6).pow(power)).sum(), std::pow(t, power), 1e-14);
    }
    const double step = 1e-6;
    const Eigen::ArrayXd slope =
      (msi::sixPointConvolution(t + step) - msi::sixPointConvolution(t - step)) / (2.0 * step);
    EXPECT_LT((msi::sixPointConvolutionSlope(t) - slope).abs().maxCoeff(), 1e-8);
    six =
      std::fmax(six, std::fabs((weight * (detail * places(6)).cos()).sum() - std::cos(detail * t)));
    const Eigen::ArrayXd other = msi::cubicConvolution(t);
    four =
      std::fmax(four, std::fabs((other * (detail * places(4)).cos()).sum() - std::cos(detail * t)));
  }
  EXPECT_LT(six, 0.5 * four);
  // The derivative is the same on both sides of a pixel.
  const Eigen::ArrayXd behind = msi::sixPointConvolutionSlope(0.0);
  const Eigen::ArrayXd before = msi::sixPointConvolutionSlope(1.0);
  EXPECT_LT((behind.head(5) - before.tail(5)).abs().maxCoeff(), 1e-14);
  EXPECT_NEAR(behind[5], 0.0, 1e-14);
  EXPECT_NEAR(before[0], 0.0, 1e-14);
}

TEST(ChannelRegistration, MovesAQuadraticExactly)
{
  const auto surface = [](double x, double y)
  { return 0.2 + 0.01 * x - 0.004 * y + 0.0003 * x * x - 0.0002 * y * y; };
  const msi::ChannelRegistration move({ {}, { 2.0, -1.0 }, { -0.37, 1.62, 0.01 } }, PictureExtent);
  PixelBuffer picture = pictureOf(3, [&](int x, int y, int) { return surface(x, y); });
  const PixelBuffer before = picture;
  PixelBuffer scratch;
  move(picture, scratch);
  for (int y = 8; y < PictureExtent.height - 8; ++y)
  {
    for (int x = 8; x < PictureExtent.width - 8; ++x)
    {
      ASSERT_EQ(picture.pixel(x, y)[0], before.pixel(x, y)[0]);
      ASSERT_EQ(picture.pixel(x, y)[1], before.pixel(x - 2, y + 1)[1]);
      const double sourceX = CenterX + (x - CenterX + 0.37) / 1.01;
      const double sourceY = CenterY + (y - CenterY - 1.62) / 1.01;
      ASSERT_NEAR(static_cast<double>(picture.pixel(x, y)[2]), surface(sourceX, sourceY), 1e-5);
    }
  }
}

namespace
{
// Interpolation is exact for quadratics. cameFrom(x, y): the place, from the middle, of what a pixel shows there.
template <typename CameFrom>
void expectQuadraticMoved(const msi::ImageDisplacement& displacement, const CameFrom& cameFrom)
{
  const auto surface = [](double x, double y)
  { return 0.2 + 0.01 * x - 0.004 * y + 0.0003 * x * x - 0.0002 * y * y + 0.0001 * x * y; };
  const msi::ChannelRegistration move({ {}, displacement }, PictureExtent);
  PixelBuffer picture = pictureOf(2, [&](int x, int y, int) { return surface(x, y); });
  const PixelBuffer before = picture;
  PixelBuffer scratch;
  move(picture, scratch);
  for (int y = 10; y < PictureExtent.height - 10; ++y)
  {
    for (int x = 10; x < PictureExtent.width - 10; ++x)
    {
      ASSERT_EQ(picture.pixel(x, y)[0], before.pixel(x, y)[0]);
      const auto [u, v] = cameFrom(x - CenterX, y - CenterY);
      ASSERT_NEAR(
        static_cast<double>(picture.pixel(x, y)[1]), surface(CenterX + u, CenterY + v), 2e-5);
    }
  }
}
}

// A point at (1, 0) from the middle comes to (cos, sin): right turns towards down.
TEST(ChannelRegistration, TurnsAQuadraticAboutTheMiddle)
{
  constexpr double Degrees = 2.5;
  const double angle = Degrees * 3.141592653589793 / 180.0;
  expectQuadraticMoved({ 0.6, -1.3, -0.01, Degrees },
    [angle](double x, double y)
    {
      const double offX = (x - 0.6) / 0.99;
      const double offY = (y + 1.3) / 0.99;
      return std::make_pair(std::cos(angle) * offX + std::sin(angle) * offY,
        -std::sin(angle) * offX + std::cos(angle) * offY);
    });
}

// As the library says: p comes from p - p (radial p^2 + keystone p) - aspect (x, -y) - shear (y, x).
TEST(ChannelRegistration, DistortsAQuadratic)
{
  expectQuadraticMoved({ 0.6, 0.0, 0.0, 0.0, 0.02, -0.01, 0.03, 0.015, -0.025 },
    [](double x, double y)
    {
      const double half = std::max(CenterX, CenterY);
      const double u = (x - 0.6) / half;
      const double v = y / half;
      const double growth = 0.02 * (u * u + v * v) - 0.01 * u + 0.03 * v;
      return std::make_pair(half * (u - growth * u - 0.015 * u + 0.025 * v),
        half * (v - growth * v + 0.015 * v + 0.025 * u));
    });
}

TEST(SceneMean, IsTheMeanWhateverTheSplit)
{
  std::vector<float> pixels(2 * 1000);
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i)
  {
    pixels[2 * static_cast<std::size_t>(i)] = static_cast<float>(1.0 / (1.0 + i));
    pixels[2 * static_cast<std::size_t>(i) + 1] = -0.25F;
    sum += static_cast<double>(pixels[2 * static_cast<std::size_t>(i)]);
  }
  pixels[2 * 17 + 1] = std::numeric_limits<float>::quiet_NaN();
  msi::SceneMean whole(2);
  whole.add(pixels.data(), 1000);
  msi::SceneMean back(2);
  back.add(pixels.data() + 2 * 300, 700);
  msi::SceneMean front(2);
  front.add(pixels.data(), 300);
  back.merge(front);
  EXPECT_EQ(whole.value(), back.value());
  EXPECT_NEAR(static_cast<double>(whole.value()[0]), sum / 1000.0, 1e-9);
  EXPECT_EQ(whole.value()[1], -0.25F);
}

}
