#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"
#include "Kernels/Gap/Field/FieldCorrection.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace
{
using msi::CameraEffect;
using msi::GapReport;
using msi::ImageExtent;
using msi::ImageSimulator;
using msi::ImageWindow;
using namespace msi::test;

// Radial, keystone right and down, aspect, shear.
using Numbers = std::vector<double>;

// All channels distorted alike, then channel C2 moved to the right.
TestPair distortedPair(const TestScene& scene, const Numbers& by, double moved = 0.0)
{
  const double middleX = 0.5 * (scene.width() - 1);
  const double middleY = 0.5 * (scene.height() - 1);
  const double half = std::max(middleX, middleY);
  return makePair(
    scene,
    [&](int k)
    {
      return scene.pixels(scene.fine(k,
        [&](double column, double row)
        {
          const double x = (column - middleX - (k == 1 ? moved : 0.0)) / half;
          const double y = (row - middleY) / half;
          const double growth = by[0] * (x * x + y * y) + by[1] * x + by[2] * y;
          return std::make_pair(middleX + half * (x - growth * x - by[3] * x - by[4] * y),
            middleY + half * (y - growth * y + by[3] * y - by[4] * x));
        }));
    },
    71);
}

void expectDistortion(const GapReport& report, const Numbers& planted, double tolerance)
{
  const char* names[] = { "radial", "keystone_x", "keystone_y", "aspect", "shear" };
  for (std::size_t n = 0; n < planted.size(); ++n)
  {
    if (planted[n] != 0.0)
    {
      expectParameter(report, "distortion", names[n], planted[n], tolerance);
    }
  }
}

void expectFound(const Numbers& planted, std::uint64_t seed)
{
  const TestScene scene(seed);
  const GapReport report = diagnose(distortedPair(scene, planted));
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "distortion");
  EXPECT_EQ(report.verdict, msi::GapVerdict::Explained);
  EXPECT_EQ(report.where.front().axis, "edges");
  expectDistortion(report, planted, 0.0005);
}

const CameraEffect Distorted{ "distortion", "common", "", { 0.02, -0.01, 0.004, 0.003, -0.005 } };
}

TEST(Distortion, OfALensIsFound)
{
  expectFound({ -0.006, 0.0, 0.0, 0.0, 0.0 }, 64);
  expectFound({ 0.03, 0.0, 0.0, 0.0, 0.0 }, 65);
}

TEST(Distortion, OfATiltedViewIsFound)
{
  expectFound({ 0.0, 0.02, -0.012, 0.006, -0.004 }, 66);
}

TEST(Distortion, IsFoundBesideAChannelThatIsMoved)
{
  const TestScene scene(67);
  const Numbers planted = { 0.02, -0.01, 0.006, 0.004, -0.005 };
  const GapReport report = diagnose(distortedPair(scene, planted, 2.5));
  SCOPED_TRACE(describe(report));
  ASSERT_EQ(report.causes.size(), 2U);
  expectDistortion(report, planted, 0.0005);
  expectParameter(report, "misregistration", "along_x[C2]", 2.5, 0.02);
}

TEST(Distortion, EveryPieceGivesTheSameBytes)
{
  const ImageExtent extent{ 40, 30 };
  CameraEffect moved = msi::neutralEffect("misregistration", sevenChannels().channels());
  moved.parameters.front() = 1.7;
  const ImageSimulator simulator(sevenChannels(), { Distorted, moved }, extent);
  const auto bands = static_cast<std::size_t>(visibleGrid().size());
  const ImageWindow all = msi::wholeImage(extent);
  std::vector<float> scene(all.pixels() * bands);
  for (std::size_t i = 0; i < scene.size(); ++i)
  {
    scene[i] = 0.1F + 0.001F * static_cast<float>(i * 7919 % 700);
  }
  msi::ImageWorkspace workspace;
  const auto simulated = [&](const ImageWindow& window)
  {
    std::vector<float> response(window.pixels() * 7);
    simulator.simulate(scene.data(), nullptr, all, window, nullptr, response.data(), workspace);
    return response;
  };
  const std::vector<float> whole = simulated(all);
  const ImageWindow window{ 23, 1, 17, 12 };
  const std::vector<float> part = simulated(window);
  for (int y = 0; y < window.height; ++y)
  {
    for (int i = 0; i < window.width * 7; ++i)
    {
      EXPECT_EQ(part[static_cast<std::size_t>(y * window.width * 7 + i)],
        whole[static_cast<std::size_t>(((window.y + y) * extent.width + window.x) * 7 + i)]);
    }
  }
}

TEST(Distortion, TheCorrectedImageHasItAsTheSimulatorDoes)
{
  const TestScene scene(68, 3, 120, 100);
  const TestPair test = distortedPair(scene, Distorted.parameters, 2.5);
  const msi::FieldPair pair = test.pair();
  CameraEffect moved = msi::neutralEffect("misregistration", pair.channels);
  moved.parameters[1] = 2.5;
  msi::FieldModel model(3);
  model[msi::imageParameter("misregistration", "along_x")].matrix() << 0.0, 2.5, 0.0;
  const char* names[] = { "radial", "keystone_x", "keystone_y", "aspect", "shear" };
  for (std::size_t n = 0; n < Distorted.parameters.size(); ++n)
  {
    model[msi::imageParameter("distortion", names[n])].setConstant(Distorted.parameters[n]);
  }
  const ImageWindow all = msi::wholeImage(pair.extent);
  std::vector<float> corrected(test.real.size());
  msi::CorrectionWorkspace workspace;
  msi::FieldCorrection(pair, model)(all, corrected.data(), workspace);
  const msi::CameraModel camera(msi::WavelengthGrid::uniform(500.0, 520.0, 10.0),
    Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3), pair.channels);
  std::vector<float> simulated(test.real.size());
  msi::ImageWorkspace images;
  ImageSimulator(camera, { Distorted, moved }, pair.extent)
    .simulate(pair.simulated, nullptr, all, all, nullptr, simulated.data(), images);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < corrected.size(); ++i)
  {
    ASSERT_NEAR(simulated[i], corrected[i], 1e-5) << i;
    before += std::pow(test.real[i] - test.simulated[i], 2);
    after += std::pow(test.real[i] - corrected[i], 2);
  }
  EXPECT_LT(after, 0.05 * before);
}
