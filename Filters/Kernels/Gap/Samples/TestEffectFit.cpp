#include "Kernels/Gap/Samples/EffectFit.h"
#include "Kernels/Gap/Samples/GapTestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <ostream>
#include <set>
#include <vector>

namespace
{

using namespace msi::test;

struct Planted
{
  msi::CameraEffect effect;
  std::size_t parameter; // that is compared
};

void PrintTo(const Planted& planted, std::ostream* out)
{
  *out << planted.effect.name;
}

msi::EffectChoice choiceOf(const msi::CameraEffect& effect)
{
  const msi::EffectDefinition* definition = msi::findEffect(effect.name);
  msi::EffectChoice choice;
  choice.effect = definition;
  choice.form = msi::findForm(*definition, effect.form);
  choice.medium = effect.medium;
  return choice;
}

class EffectFitRecovers : public ::testing::TestWithParam<Planted>
{
};

// Three standard errors, those of the sandwich over samples, and they are not idly large.
TEST_P(EffectFitRecovers, PlantedParameterWithinItsStandardError)
{
  const Planted& planted = GetParam();
  const msi::GapData data = dataOf(captureWith({ planted.effect }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  msi::EffectSet set;
  set.add(choiceOf(planted.effect), data.camera);
  const msi::EffectFit fit = fitter.fit(std::move(set), msi::FinalFit);
  const double error = std::sqrt(fitter.covariance(fit)(
    static_cast<Eigen::Index>(planted.parameter), static_cast<Eigen::Index>(planted.parameter)));
  const double truth = planted.effect.parameters[planted.parameter];
  const double neutral = fit.free[planted.parameter].definition->neutral;
  EXPECT_NEAR(fit.set.effects.front().parameters[planted.parameter], truth, 3.0 * error);
  EXPECT_LT(error, 0.1 * std::fabs(truth - neutral));
  // What is left is noise: the weighted squares of as many elements, within five of their standard deviations.
  EXPECT_LT(fit.energy, fitter.noiseEnergy() * (1.0 + 5.0 * std::sqrt(2.0 / (96.0 * 7.0))) * 1.1);
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectFitRecovers,
  ::testing::Values(Planted{ { "exposure_gain", "", "", { 1.05 } }, 0 },
    Planted{ { "dark_offset", "", "", { 0.01 } }, 0 },
    Planted{
      { "dark_offset", "per_channel", "", { 0.01, -0.01, 0.005, 0.02, 0.01, -0.02, 0.015 } }, 3 },
    Planted{ { "filter_shift", "", "", { 2.5 } }, 0 },
    Planted{ { "filter_bandwidth", "", "", { 1.2 } }, 0 },
    Planted{ { "channel_crosstalk", "", "", { 0.03, 0.0 } }, 0 },
    Planted{ { "detector_nonlinearity", "gamma", "", { 0.92 } }, 0 },
    Planted{ { "illumination_gradient", "", "", { 0.05, -0.03 } }, 1 },
    Planted{ { "medium_gain", "", "fabric", { 0.93 } }, 0 },
    Planted{ { "interreflection", "", "fabric", { 0.2 } }, 0 }));

TEST(EffectFit, WithoutEffectsIsTheNominalCamera)
{
  const msi::GapData data = dataOf(captureWith({ { "exposure_gain", "", "", { 1.05 } } }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  const msi::EffectFit fit = fitter.fit({}, msi::FinalFit);
  EXPECT_EQ(fit.predicted, data.simulated);
  EXPECT_EQ(fit.energy, fitter.nominal().energy);
  EXPECT_TRUE(fit.derivatives.empty());
}

TEST(EffectFit, ResistsReadingsThatAreWrongAltogether)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } });
  capture.readings.col(10).setConstant(0.9);
  capture.readings.col(11).setConstant(0.9);
  const msi::GapData data = dataOf(capture);
  const msi::EffectFitter fitter(data, data.usable, 1);
  msi::EffectSet set;
  set.add(choiceOf({ "exposure_gain", "", "", {} }), data.camera);
  EXPECT_NEAR(
    fitter.fit(std::move(set), msi::FinalFit).set.effects.front().parameters[0], 1.05, 0.002);
}

TEST(FoldsOf, EachHasItsPartOfTheBrightAndTheDarkOfAMedium)
{
  const msi::GapData data = dataOf(captureWith({}));
  const std::vector<msi::SampleList> folds = msi::foldsOf(data, data.usable, 5, 1);
  EXPECT_NE(folds, msi::foldsOf(data, data.usable, 5, 2));
  std::vector<std::size_t> fold(data.usable.size());
  for (std::size_t f = 0; f < folds.size(); ++f)
  {
    for (const Eigen::Index i : folds[f])
    {
      fold[static_cast<std::size_t>(i)] = f;
    }
  }
  for (int medium = 0; medium < static_cast<int>(data.scene.media().size()); ++medium)
  {
    msi::SampleList samples;
    std::copy_if(data.usable.begin(), data.usable.end(), std::back_inserter(samples),
      [&](Eigen::Index i) { return data.scene.medium()[static_cast<std::size_t>(i)] == medium; });
    std::sort(samples.begin(), samples.end(),
      [&](Eigen::Index a, Eigen::Index b)
      { return data.simulated.col(a).maxCoeff() > data.simulated.col(b).maxCoeff(); });
    for (auto fifth = samples.begin(); samples.end() - fifth >= 9; fifth += 9)
    {
      std::set<std::size_t> there; // nine in a row hold five that were dealt together
      std::for_each(
        fifth, fifth + 9, [&](Eigen::Index i) { there.insert(fold[static_cast<std::size_t>(i)]); });
      EXPECT_EQ(there.size(), 5U);
    }
  }
}

// One Gauss-Newton step without a fold is exact for an effect that is linear: compared with fits that really leave
// the samples out. The folds are those of the fitter.
TEST(EffectFit, CrossValidationOfALinearEffectIsThatOfFitsWithoutTheFold)
{
  const msi::GapData data = dataOf(captureWith({ { "exposure_gain", "", "", { 1.05 } } }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  msi::EffectSet set;
  set.add(choiceOf({ "exposure_gain", "", "", {} }), data.camera);
  const msi::EffectFit fit = fitter.fit(set, msi::FinalFit);
  for (const msi::SampleList& left : msi::foldsOf(data, data.usable, 5, 1))
  {
    msi::SampleList training;
    std::set_difference(data.usable.begin(), data.usable.end(), left.begin(), left.end(),
      std::back_inserter(training));
    const msi::EffectFitter without(data, training, 1);
    const msi::EffectFit other = without.fit(set, msi::FinalFit);
    for (const Eigen::Index i : left)
    {
      EXPECT_NEAR(
        (fit.heldOut.col(i) - (data.observed.col(i) - other.predicted.col(i))).norm(), 0.0, 1e-6);
    }
  }
}

TEST(EffectSet, RespondsAsTheSimulatorDoes)
{
  const msi::CameraEffect shift{ "filter_shift", "common", "", { 2.0 } };
  msi::EffectSet set;
  set.add(choiceOf(shift), sevenChannels(), { 2.0 });
  EXPECT_EQ(
    msi::stagedResponse(sevenChannels(), rasterScene(), set)->response(), responseWith({ shift }));
}

TEST(EffectSet, DerivativesAreThoseOfTheResponse)
{
  msi::EffectSet set;
  set.add(choiceOf({ "filter_shift", "per_channel", "", {} }), sevenChannels());
  const msi::SampleScene scene = rasterScene();
  const auto free = set.freeParameters(sevenChannels());
  const std::vector<msi::Derivative> derivatives =
    msi::derivatives(*msi::stagedResponse(sevenChannels(), scene, set), set, free);
  ASSERT_EQ(derivatives.size(), 7U);
  msi::EffectSet up = set;
  msi::EffectSet down = set;
  up.value(free[2]) = 0.01;
  down.value(free[2]) = -0.01;
  Eigen::MatrixXd central = (msi::stagedResponse(sevenChannels(), scene, up)->response() -
                              msi::stagedResponse(sevenChannels(), scene, down)->response()) /
    0.02;
  EXPECT_EQ(derivatives[2].first, 2);
  ASSERT_EQ(derivatives[2].changes.rows(), 1);
  EXPECT_LT((derivatives[2].changes - central.row(2)).norm(), 0.01 * central.norm());
  central.row(2).setZero();
  EXPECT_EQ(central.norm(), 0.0);
}

// A report is read back with the bounds of its effects: 1 + (0.2 - 1) would already be less than 0.2.
TEST(EffectSet, NumbersStayWithinTheirBounds)
{
  const msi::GapData data = dataOf(captureWith({}));
  for (const msi::EffectChoice& choice : msi::choicesFor(data.scene, {}))
  {
    msi::EffectSet set;
    set.add(choice, data.camera);
    const std::vector<msi::FreeParameter> free = set.freeParameters(data.camera);
    for (const double way : { -1.0, 1.0 })
    {
      Eigen::VectorXd change(static_cast<Eigen::Index>(free.size()));
      std::transform(free.begin(), free.end(), change.begin(),
        [&](const msi::FreeParameter& one)
        { return (way < 0.0 ? one.lower : one.upper) - one.deviation; });
      const msi::EffectSet moved = msi::changed(set, free, change);
      for (const msi::FreeParameter& one : free)
      {
        EXPECT_GE(moved.value(one), one.definition->lower) << choice.effect->name;
        EXPECT_LE(moved.value(one), one.definition->upper) << choice.effect->name;
      }
    }
  }
}

TEST(EffectChoices, OnlyWhatTheCaptureCanShow)
{
  msi::SceneSamples samples = rasterSamples();
  const auto has = [&samples](const std::string& name, const std::vector<std::string>& without = {})
  {
    const auto choices = msi::choicesFor(msi::SampleScene(visibleGrid(), samples), without);
    return std::any_of(choices.begin(), choices.end(),
      [&name](const msi::EffectChoice& choice) { return choice.effect->name == name; });
  };
  EXPECT_TRUE(has("vignetting"));
  EXPECT_TRUE(has("session_drift"));
  EXPECT_TRUE(has("medium_gain"));
  EXPECT_FALSE(has("defocus"));
  EXPECT_FALSE(has("excess_noise"));
  EXPECT_FALSE(has("vignetting", { "vignetting" }));
  samples.x.resize(0);
  samples.y.resize(0);
  samples.order.resize(0);
  samples.medium.clear();
  EXPECT_FALSE(has("vignetting"));
  EXPECT_FALSE(has("session_drift"));
  EXPECT_FALSE(has("medium_gain"));
  EXPECT_TRUE(has("filter_shift"));
}

// The plain product of all rows, for effects that keep to their channel and for one that reaches the neighbours.
TEST(NormalEquations, ArePlainProducts)
{
  const msi::GapData data = dataOf(captureWith({}));
  for (const char* name : { "dark_offset", "channel_crosstalk" })
  {
    msi::EffectSet set;
    for (const auto& [effect, form] : { std::pair<const char*, const char*>{ name, "" },
           { "channel_gain", "per_channel" }, { "filter_shift", "per_channel" } })
    {
      msi::EffectChoice choice;
      choice.effect = msi::findEffect(effect);
      choice.form = msi::findForm(*choice.effect, form);
      set.add(choice, data.camera);
    }
    const auto free = set.freeParameters(data.camera);
    const std::vector<msi::Derivative> derivatives =
      msi::derivatives(*msi::stagedResponse(data.camera, data.scene, set), set, free);
    Eigen::MatrixXd columns =
      Eigen::MatrixXd::Zero(data.observed.size(), static_cast<Eigen::Index>(free.size()));
    for (std::size_t p = 0; p < free.size(); ++p)
    {
      auto column =
        columns.col(static_cast<Eigen::Index>(p)).reshaped(data.channels(), data.samples());
      derivatives[p].of(column) = derivatives[p].changes;
    }
    std::vector<Eigen::Index> samples(40);
    std::iota(samples.begin(), samples.end(), 20);
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(data.channels(), data.samples());
    weight.middleCols(20, 40) = data.weight.middleCols(20, 40);
    const Eigen::ArrayXXd root = weight.array().sqrt();
    const Eigen::ArrayXXd residual = root * data.observed.array();
    const Eigen::MatrixXd weighted = root.reshaped().matrix().asDiagonal() * columns;
    const Eigen::MatrixXd expected = weighted.transpose() * weighted;
    const Eigen::VectorXd gradient = weighted.transpose() * residual.reshaped().matrix();
    const auto half = samples.begin() + 25;
    const std::vector<msi::NormalEquations> folds = msi::normalEquations(
      derivatives, root, residual, { { samples.begin(), half }, { half, samples.end() }, {} });
    const Eigen::MatrixXd matrix = folds[0].matrix + folds[1].matrix;
    EXPECT_LT((matrix - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff())
      << name;
    EXPECT_LT((folds[0].gradient + folds[1].gradient - gradient).cwiseAbs().maxCoeff(),
      1e-10 * gradient.cwiseAbs().maxCoeff())
      << name;
    EXPECT_GT(folds[0].matrix.norm(), folds[1].matrix.norm()) << name;
    EXPECT_EQ(folds[2].matrix.norm(), 0.0) << name; // but of the same pattern
    EXPECT_EQ(folds[2].matrix.nonZeros(), folds[0].matrix.nonZeros()) << name;
  }
}

// A step of 5 % between samples 40 and 41. Without both of them it is only known to lie between 39 and 42.
TEST(HeldOut, ASampleBesideAStepMayLieOnEitherSide)
{
  const double place = 40.5 / 95.0;
  const msi::GapData data =
    dataOf(captureWith({ { "session_drift", "step", "", { 0.05, place, 0.001 } } }));
  msi::SampleList training;
  for (Eigen::Index i = 0; i < 96; ++i)
  {
    if (i != 40 && i != 41 && i != 60)
    {
      training.push_back(i);
    }
  }
  const msi::EffectDefinition* drift = msi::findEffect("session_drift");
  for (const double guess : { 39.4, 41.6 })
  {
    msi::EffectSet set;
    set.add(
      { drift, msi::findForm(*drift, "step"), "" }, data.camera, { 0.05, guess / 95.0, 0.001 });
    msi::EffectFit fit;
    fit.predicted = msi::stagedResponse(data.camera, data.scene, set)->response();
    fit.set = std::move(set);
    const Eigen::MatrixXd plain = data.observed - fit.predicted;
    const Eigen::MatrixXd left = msi::leftOfHeldOut(data, fit, training);
    ASSERT_GT(std::fmax(plain.col(40).norm(), plain.col(41).norm()), 0.01);
    EXPECT_LT(left.col(40).norm(), 0.002);
    EXPECT_LT(left.col(41).norm(), 0.002);
    EXPECT_EQ(left.col(60), plain.col(60));
    EXPECT_EQ(left.col(39), plain.col(39));
  }
}

} // namespace
