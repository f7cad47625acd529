#include "Kernels/Gap/Diagnosis/GapRegression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{

using namespace msi;

constexpr int Rows = 64;
constexpr int Channels = 4;
enum Column
{
  Offset,
  Gain,
  Square,
  Second, // the half of the rows that is the second medium, times u
  Place,  // u times a place that has nothing to do with u
};

// Each channel's columns and a gap on odd rows for training, on even ones for the test.
PredictedEnergies predicted(
  const std::function<double(int channel, const Eigen::VectorXd& row)>& gap)
{
  AxisSplit split;
  for (int k = 0; k < Channels; ++k)
  {
    Eigen::MatrixXd columns(Rows, 6);
    for (int i = 0; i < Rows; ++i)
    {
      const double u = 0.1 + 0.8 * std::fmod(0.618 * i, 1.0);
      const double place = std::fmod(0.4142 * i, 1.0) - 0.5;
      columns.row(i).head(5) << 1.0, u, u * u, i / 2 % 2 == 0 ? 0.0 : u, u * place;
      columns(i, 5) = gap(k, columns.row(i).head(5).transpose());
    }
    const auto part = [&columns](int first)
    {
      const Eigen::MatrixXd rows = columns(Eigen::seqN(first, Rows / 2, 2), Eigen::all);
      return Eigen::MatrixXd(rows.transpose() * rows);
    };
    split.training.push_back(part(0));
    split.test.push_back(part(1));
  }
  return predictedEnergies(
    { { "channel", {}, { Offset, Gain }, {} }, { "level", { Gain, Square }, {}, {} },
      { "medium", { Second }, {}, { Second } }, { "position", {}, { Place }, { Place } } },
    { split }, Gain);
}

double part(const PredictedEnergies& energies, std::size_t axis)
{
  return energies.axis[axis] / energies.before;
}

TEST(PredictedEnergies, SumToWhatAllPredict)
{
  const PredictedEnergies energies = predicted([](int k, const Eigen::VectorXd& row)
    { return 0.01 * k + 0.05 * row[Second] + 0.02 * row[Place]; });
  EXPECT_NEAR(part(energies, 0) + part(energies, 1) + part(energies, 2) + part(energies, 3),
    energies.all / energies.before, 1e-12);
  EXPECT_NEAR(energies.all, energies.before, 1e-3 * energies.before);
}

TEST(PredictedEnergies, ACommonGainIsTheLevels)
{
  const PredictedEnergies energies =
    predicted([](int, const Eigen::VectorXd& row) { return 0.05 * row[Gain]; });
  // The offsets of the channels do a part of it.
  EXPECT_GT(part(energies, 1), part(energies, 0));
  EXPECT_NEAR(part(energies, 2), 0.0, 0.01);
  EXPECT_NEAR(part(energies, 3), 0.0, 0.01);
}

TEST(PredictedEnergies, GainsThatDifferAreTheChannels)
{
  const PredictedEnergies energies = predicted(
    [](int k, const Eigen::VectorXd& row) { return (k % 2 == 0 ? 0.05 : -0.05) * row[Gain]; });
  EXPECT_NEAR(part(energies, 0), 1.0, 0.01);
}

TEST(PredictedEnergies, WhatIsOfOneCellIsNotTheLevels)
{
  const PredictedEnergies energies =
    predicted([](int, const Eigen::VectorXd& row) { return 0.05 * row[Second]; });
  EXPECT_GT(part(energies, 2), 0.5);
  const PredictedEnergies places =
    predicted([](int k, const Eigen::VectorXd& row) { return 0.05 * k * row[Place]; });
  EXPECT_GT(part(places, 3), 0.95);
}

TEST(PredictedEnergies, CoefficientsAreThoseOfTheGap)
{
  const PredictedEnergies energies = predicted([](int k, const Eigen::VectorXd& row)
    { return 0.03 * k + 0.2 * k * row[Place] - 0.1 * row[Square]; });
  for (int k = 0; k < Channels; ++k)
  {
    const Eigen::VectorXd& found = energies.coefficients.front()[static_cast<std::size_t>(k)];
    EXPECT_NEAR(found[Place], 0.2 * k, 2e-3);
    EXPECT_NEAR(found[Square], -0.1, 0.02);
  }
}

} // namespace
