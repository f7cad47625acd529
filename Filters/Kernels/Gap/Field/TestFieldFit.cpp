#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace
{
using namespace msi;
using namespace msi::test;

const FieldChoice& choiceOf(
  const std::vector<FieldChoice>& choices, const std::string& effect, std::size_t terms)
{
  for (const FieldChoice& choice : choices)
  {
    if (choice.effect->name == effect && choice.terms.size() == terms)
    {
      return choice;
    }
  }
  throw std::out_of_range(effect);
}

void inTurn(int count, const std::function<void(int)>& body)
{
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
}
}

// Differences of noise alone, and with a part that goes with the squared slopes of the scene: the noise is the same. It has a scatter as of
// blocks of some hundred pixels.
TEST(FieldNoise, WhatGoesWithSlopesIsNone)
{
  constexpr CameraNoise True{ 0.002, 0.004 };
  const CounterRandom random(73);
  for (const double onEdges : { 0.0, 0.05 })
  {
    FieldStatistics statistics{ FieldModel(1), 1, std::vector<BlockSums>(200) };
    std::uint64_t draw = 0;
    for (BlockSums& block : statistics.sums)
    {
      block.level = 0.05 + 0.9 * random.uniform(draw++);
      block.gradient = 4e-4 * random.uniform(draw++); // of all of them: no block is smooth
      const double noise = noiseVariance(True, block.level);
      block.difference = noise * (1.0 + 0.1 * random.normal(draw++)) + onEdges * block.gradient;
      block.differenceDown = noise * (1.0 + 0.1 * random.normal(draw++)) + onEdges * block.gradient;
    }
    const CameraNoise found = fieldNoise(statistics).front();
    for (const double level : { 0.1, 0.5, 0.9 })
    {
      EXPECT_NEAR(noiseVariance(found, level) / noiseVariance(True, level), 1.0, 0.15) << onEdges;
    }
  }
}

// An image of nothing but noise, moved and blurred: the mean products of its columns are those that noise is said to make.
TEST(FieldFit, ProductsOfNoiseInTheScene)
{
  constexpr double Deviation = 1e-3;
  const TestScene scene(71, 1, 160, 140);
  TestPair pair = changed(scene, 71, [](double u, int, int, int, double) { return u; });
  const CounterRandom random(72);
  for (std::size_t i = 0; i < pair.simulated.size(); ++i)
  {
    pair.simulated[i] = static_cast<float>(0.5 + Deviation * random.normal(i));
    pair.real[i] = 0.5F;
  }
  const FieldPair images = pair.pair();
  const FieldData data = prepareFieldData(images, 1, inTurn);
  for (const double variance : { 0.0, 0.7 })
  {
    FieldModel model(1);
    model[imageParameter("defocus", "blur")].setConstant(variance);
    model[imageParameter("misregistration", "along_x")].setConstant(variance > 0.0 ? 0.3 : 0.0);
    const Eigen::ArrayXd glare = data.cells.mean(model);
    const int blur = fieldColumns().blur;
    const int right = static_cast<int>(stepOf(imageParameter("misregistration", "along_x")).column);
    Eigen::Matrix3d seen = Eigen::Matrix3d::Zero(); // blur, right, residual
    Eigen::Matrix3d expected = seen;
    for (const FieldBlock& block : data.blocks)
    {
      forColumns(data, model, glare, block, everyStep(),
        [&](Eigen::Index, const ChannelColumns& found)
        {
          std::vector<Eigen::Index> columns;
          for (const Eigen::Index column : { blur, right, fieldColumns().residual })
          {
            columns.push_back(
              std::find(found.there.begin(), found.there.end(), column) - found.there.begin());
          }
          const Eigen::MatrixXd values = found.columns(Eigen::all, columns);
          seen += values.transpose() * values;
          for (Eigen::Index c = 0; c < 3; ++c)
          {
            expected.col(c) += static_cast<double>(values.rows()) * Deviation * Deviation *
              found.ofNoise(columns[static_cast<std::size_t>(c)])(columns);
          }
        });
    }
    const Eigen::Vector3d size = expected.diagonal().cwiseSqrt();
    EXPECT_LT(
      ((seen - expected).array() / (size * size.transpose()).array()).abs().maxCoeff(), 0.04)
      << seen << "\n\n"
      << expected;
  }
}

// A falloff about a center of its own and a gradient that bends are nearly the same: linear steps lead far away.
TEST(FieldFit, TheEnergyToldIsThatOfTheModelReached)
{
  const std::vector<FieldChoice> choices = fieldChoices({});
  const FieldSet set{ &choiceOf(choices, "vignetting", 3),
    &choiceOf(choices, "illumination_gradient", 4) };
  for (std::uint64_t seed = 61; seed < 65; ++seed)
  {
    const TestScene scene(seed);
    const TestPair pair = changed(scene, seed,
      [&](double u, int, int x, int y, double)
      { return u * (1.0 + 0.05 * scene.fieldX(x) - 0.03 * scene.fieldY(y)); });
    const FieldPair images = pair.pair();
    const FieldData data = prepareFieldData(images, seed, inTurn);
    FieldModel start(data.channels());
    const FieldWeights weights = fieldWeights(fieldStatistics(data, start, nullptr));
    start[imageParameter("vignetting", "falloff")].setConstant(-0.2);
    start[imageParameter("vignetting", "center_x")].setConstant(0.9);
    start[imageParameter("vignetting", "center_y")].setConstant(-0.6);
    const FieldHypothesis found = refitted(data, weights, set, start);
    const double reached =
      FieldFitter(data, fieldStatistics(data, found.fit.next, &weights)).energy();
    EXPECT_LT(reached, 1.02 * found.fit.energy) << "seed " << seed;
    EXPECT_LT(FieldFitter(data, *found.statistics).energy(), 1.02 * found.fit.energy)
      << "seed " << seed;
  }
}
