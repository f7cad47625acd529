#include "Kernels/Camera/Imaging/ImageSimulator.h"
#include "Kernels/Gap/Field/FieldCorrection.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace
{
using msi::FieldGap;
using namespace msi::test;

// Blur, vignetting, stripes of columns, gains and an offset.
TestPair everything(const TestScene& scene)
{
  const double gain[] = { 0.96, 1.0, 1.05 };
  return makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(gaussianBlurred(scene.fine(k), 0.9 * TestScene::Fine));
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          const double rho2 = std::pow(scene.fieldX(x), 2) + std::pow(scene.fieldY(y), 2);
          plane.at(x, y) *=
            gain[k] * (1.0 - 0.1 * rho2) * (1.0 + 0.02 * std::sin(2.0 * Pi * (x / 8.5 + 0.2)));
        }
      }
      return plane;
    },
    31);
}

std::vector<float> correctedImage(
  const msi::FieldPair& pair, const msi::FieldModel& model, int side)
{
  const msi::FieldCorrection correction(pair, model);
  const std::size_t K = pair.channels.size();
  std::vector<float> image(pair.pixels() * K);
  std::vector<float> part;
  msi::CorrectionWorkspace workspace;
  for (int y = 0; y < pair.extent.height; y += side)
  {
    for (int x = 0; x < pair.extent.width; x += side)
    {
      const msi::ImageWindow window{ x, y, std::min(side, pair.extent.width - x),
        std::min(side, pair.extent.height - y) };
      part.resize(window.pixels() * K);
      correction(window, part.data(), workspace);
      for (int row = 0; row < window.height; ++row)
      {
        std::copy_n(part.data() + static_cast<std::size_t>(row * window.width) * K,
          static_cast<std::size_t>(window.width) * K, image.data() + pair.index(x, y + row) * K);
      }
    }
  }
  return image;
}
}

// A curve of its own in each channel is in no effect.
TEST(FieldCorrection, WhatNoCauseExplainsCanBeAdded)
{
  const TestScene scene(22, 3, 120, 100);
  const double square[] = { 0.06, -0.05, 0.04 };
  const TestPair test =
    changed(scene, 32, [&](double u, int k, int, int, double) { return u + square[k] * u * u; });
  const msi::FieldPair pair = test.pair();
  msi::GapOptions options;
  options.addRest = true;
  options.without = { "detector_nonlinearity" };
  const FieldGap found = *msi::diagnoseField(pair, options);
  SCOPED_TRACE(describe(found.report));
  ASSERT_TRUE(found.report.unexplained.rmsWithRest);
  EXPECT_GT(found.report.gap.rmsAfter, 1.2 * found.report.gap.noiseFloor);
  EXPECT_LT(*found.report.unexplained.rmsWithRest, 1.05 * found.report.gap.noiseFloor);
  EXPECT_EQ(found.report.correction.back().name, "unmodelled_response");
  const std::vector<float> corrected = correctedImage(pair, found.model, 64);
  double left = 0.0;
  for (std::size_t i = 0; i < corrected.size(); ++i)
  {
    left += std::pow(pair.real[i] - corrected[i], 2) / static_cast<double>(corrected.size());
  }
  EXPECT_LT(std::sqrt(left), 1.05 * found.report.gap.noiseFloor);
}

namespace
{
// A camera that sees each wavelength in one channel turns the simulated image, taken as reflectance, into itself; with the
// effects that were found the simulator must give the corrected image.
void expectSimulatorGivesTheCorrectedImage(const TestPair& test, const FieldGap& found)
{
  const msi::FieldPair pair = test.pair();
  const auto K = static_cast<Eigen::Index>(pair.channels.size());
  const msi::CameraModel camera(
    msi::WavelengthGrid::uniform(500.0, 490.0 + 10.0 * static_cast<double>(K), 10.0),
    Eigen::MatrixXd::Identity(K, K), Eigen::VectorXd::Zero(K), pair.channels);
  const msi::ImageSimulator simulator(camera, found.report.correction, pair.extent);
  const msi::ImageWindow all = msi::wholeImage(pair.extent);
  msi::ImageWorkspace workspace;
  msi::SceneMean mean(K);
  simulator.addToMean(pair.simulated, nullptr, all, mean, workspace);
  std::vector<float> simulated(test.simulated.size());
  simulator.simulate(pair.simulated, nullptr, all, all, &mean, simulated.data(), workspace);
  const std::vector<float> corrected = correctedImage(pair, found.model, 64);
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < corrected.size(); ++i)
  {
    ASSERT_NEAR(simulated[i], corrected[i], 1e-5) << i;
    before += std::pow(pair.real[i] - pair.simulated[i], 2);
    after += std::pow(pair.real[i] - corrected[i], 2);
  }
  EXPECT_LT(after, 0.05 * before);
}
}

TEST(FieldCorrection, TheSimulatorRunsWithWhatWasFound)
{
  const TestPair test = everything(TestScene(21, 3, 120, 100));
  const FieldGap found = *msi::diagnoseField(test.pair());
  ASSERT_EQ(found.report.correction.size(), 4U);
  expectSimulatorGivesTheCorrectedImage(test, found);
}

TEST(FieldCorrection, TheSimulatorHasTheLampThatWasFound)
{
  const TestPair test = changed(TestScene(63, 6, 96, 80), 73,
    [](double u, int k, int, int, double) { return u * std::exp(0.04 * k); });
  const FieldGap found = *msi::diagnoseField(test.pair());
  ASSERT_EQ(found.report.correction.front().name, "illuminant_drift");
  expectSimulatorGivesTheCorrectedImage(test, found);
}

TEST(FieldCorrection, TheSimulatorHasTheTailThatWasFound)
{
  const TestScene scene(64, 3, 120, 100);
  const TestPair test = makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(scene.fine(k));
      const ImagePlane wide = gaussianBlurred(plane, 7.0);
      for (std::size_t i = 0; i < plane.value.size(); ++i)
      {
        plane.value[i] += 0.25 * (wide.value[i] - plane.value[i]);
      }
      return plane;
    },
    74);
  const FieldGap found = *msi::diagnoseField(test.pair());
  ASSERT_EQ(found.report.correction.size(), 1U);
  ASSERT_EQ(found.report.correction.front().form, "any_shape");
  expectSimulatorGivesTheCorrectedImage(test, found);
}

// Turned channels under light off the middle, with sines of three harmonics in the place of a profile.
TEST(FieldCorrection, TheSimulatorTurnsAsTheModelDoes)
{
  const TestScene scene(24, 3, 120, 100);
  const TestPair test = makePair(
    scene, [&](int k) { return scene.pixels(scene.fine(k)); }, 33);
  const msi::FieldPair pair = test.pair();
  msi::FieldModel model(3);
  model[msi::imageParameter("misregistration", "along_x")].matrix() << 0.4, 0.0, -1.2;
  model[msi::imageParameter("misregistration", "rotation")].matrix() << 0.7, 0.0, -1.1;
  model[msi::imageParameter("misregistration", "magnification")].matrix() << 0.0, 0.004, 0.0;
  model[msi::imageParameter("vignetting", "falloff")].setConstant(0.1);
  model[msi::imageParameter("vignetting", "fourth")].setConstant(0.05);
  model[msi::imageParameter("vignetting", "sixth")].setConstant(-0.02);
  model[msi::imageParameter("vignetting", "center_x")].setConstant(0.2);
  model[msi::imageParameter("vignetting", "center_y")].setConstant(-0.1);
  msi::CameraEffect moved = msi::neutralEffect("misregistration", pair.channels);
  moved.parameters = { 0.4, 0.0, -1.2, 0.0, 0.0, 0.0, 0.0, 0.004, 0.0, 0.7, 0.0, -1.1 };
  const msi::CameraEffect light{ "vignetting", "polynomial", "", { 0.1, 0.05, -0.02, 0.2, -0.1 } };
  const msi::CameraModel camera(msi::WavelengthGrid::uniform(500.0, 520.0, 10.0),
    Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3), pair.channels);
  const msi::ImageSimulator simulator(camera, { light, moved }, pair.extent);
  const msi::ImageWindow all = msi::wholeImage(pair.extent);
  msi::ImageWorkspace workspace;
  std::vector<float> simulated(test.simulated.size());
  simulator.simulate(pair.simulated, nullptr, all, all, nullptr, simulated.data(), workspace);
  const std::vector<float> corrected = correctedImage(pair, model, 64);
  for (std::size_t i = 0; i < corrected.size(); ++i)
  {
    ASSERT_NEAR(simulated[i], corrected[i], 1e-5) << i;
  }
}

TEST(FieldCorrection, WindowsDoNotShowAndGapsStay)
{
  const TestScene scene(22, 3, 120, 100);
  TestPair test = everything(scene);
  test.simulated[3 * 500 + 1] = std::numeric_limits<float>::quiet_NaN();
  const msi::FieldPair pair = test.pair();
  const FieldGap found = *msi::diagnoseField(pair);
  const std::vector<float> large = correctedImage(pair, found.model, 128);
  const std::vector<float> small = correctedImage(pair, found.model, 32);
  for (std::size_t i = 0; i < large.size(); ++i)
  {
    ASSERT_EQ(std::isnan(large[i]), i == 3 * 500 + 1) << i;
    ASSERT_TRUE(std::isnan(large[i]) || large[i] == small[i]) << i;
  }
}

TEST(FieldCorrection, TheOrderOfWorkDoesNotShow)
{
  const TestScene scene(23, 3, 120, 100);
  const TestPair test = everything(scene);
  msi::GapOptions backwards;
  backwards.parallelFor = [](int count, const std::function<void(int)>& body)
  {
    for (int i = count; i-- > 0;)
    {
      body(i);
    }
  };
  const auto one = msi::diagnoseField(test.pair())->report;
  const auto other = msi::diagnoseField(test.pair(), backwards)->report;
  ASSERT_EQ(one.correction.size(), other.correction.size());
  for (std::size_t i = 0; i < one.correction.size(); ++i)
  {
    EXPECT_EQ(one.correction[i].parameters, other.correction[i].parameters);
  }
  EXPECT_EQ(one.gap.rmsAfter, other.gap.rmsAfter);
  EXPECT_EQ(one.gap.shrinkInterval, other.gap.shrinkInterval);
}
