// The search and what is said of it, on data of which everything is known: columns of numbers and their sums.
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/Diagnosis/SetSearch.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace
{

// y = sum of some columns + noise of deviation 1; every row is a group of its own. The options are the columns, under
// names of the library.
class ColumnSums : public msi::Observation
{
public:
  ColumnSums(Eigen::MatrixXd columns, Eigen::VectorXd y)
    : X(std::move(columns))
    , Y(std::move(y))
  {
    for (Eigen::Index c = 0; c < X.cols(); ++c)
    {
      Options.push_back({ &msi::effectLibrary()[static_cast<std::size_t>(c)], "", "", false, 3.0 });
    }
    Elements = NoiseEnergy = static_cast<double>(Y.size());
    Nominal = fitted({});
    InexactEnergy = { Nominal->energy, Nominal->energy };
  }
  void makePerChannel(std::size_t option) { Options[option].perChannel = true; }
  void makeOfMedium(std::size_t option, const char* medium) { Options[option].medium = medium; }
  std::vector<msi::GapPreview> previews(const msi::ObservedFit& from) const override
  {
    std::vector<msi::GapPreview> all;
    for (std::size_t c = 0; c < Options.size(); ++c)
    {
      if (std::find(from.set.begin(), from.set.end(), c) == from.set.end())
      {
        std::vector<std::size_t> set = from.set;
        set.push_back(c);
        all.push_back({ c, {}, *fitted(std::move(set)) });
      }
    }
    return all;
  }
  msi::FitPointer extended(const msi::ObservedFit& from, const msi::GapPreview& with) const override
  {
    std::vector<std::size_t> set = from.set;
    set.push_back(with.option);
    return fitted(set);
  }
  msi::FitPointer reduced(const msi::ObservedFit& from, std::size_t positions) const override
  {
    std::vector<std::size_t> set;
    for (std::size_t p = 0; p < from.set.size(); ++p)
    {
      if ((positions >> p & 1U) != 0)
      {
        set.push_back(from.set[p]);
      }
    }
    return fitted(set);
  }
  msi::GroupEnergies energies(const msi::ObservedFit& fit) const override
  {
    msi::GroupEnergies energies(Y.size(), 3);
    energies << Y.cwiseAbs2(), leftOf(fit.set).cwiseAbs2(), Eigen::VectorXd::Ones(Y.size());
    return energies;
  }
  std::vector<std::vector<msi::GapParameter>> parameters(const msi::ObservedFit& fit) const override
  {
    return std::vector<std::vector<msi::GapParameter>>(fit.set.size());
  }

private:
  Eigen::MatrixXd chosen(const std::vector<std::size_t>& set) const
  {
    Eigen::MatrixXd columns(X.rows(), static_cast<Eigen::Index>(set.size()));
    for (std::size_t p = 0; p < set.size(); ++p)
    {
      columns.col(static_cast<Eigen::Index>(p)) = X.col(static_cast<Eigen::Index>(set[p]));
    }
    return columns;
  }
  Eigen::MatrixXd normalOf(const Eigen::MatrixXd& columns) const
  {
    return columns.transpose() * columns +
      0.01 * Eigen::MatrixXd::Identity(columns.cols(), columns.cols());
  }
  // Each row predicted without it.
  Eigen::VectorXd leftOf(const std::vector<std::size_t>& set) const
  {
    if (set.empty())
    {
      return Y;
    }
    const Eigen::MatrixXd columns = chosen(set);
    const Eigen::LDLT<Eigen::MatrixXd> factor(normalOf(columns));
    const Eigen::VectorXd left = Y - columns * factor.solve(columns.transpose() * Y);
    const Eigen::MatrixXd solved = factor.solve(columns.transpose());
    return left.array() / (1.0 - (columns.array() * solved.transpose().array()).rowwise().sum());
  }
  msi::FitPointer fitted(std::vector<std::size_t> set) const
  {
    auto fit = std::make_shared<Fit>();
    fit->energy = leftOf(set).squaredNorm();
    const Eigen::VectorXd squares = chosen(set).colwise().squaredNorm();
    fit->information = Eigen::MatrixXd(squares.asDiagonal()).sparseView();
    fit->prior = msi::BlockPrior({ { squares.size(), 100.0 } });
    fit->set = std::move(set);
    return fit;
  }
  class Fit : public msi::ObservedFit
  {
  };

  Eigen::MatrixXd X;
  Eigen::VectorXd Y;
};

Eigen::MatrixXd drawnNumbers(Eigen::Index rows, Eigen::Index columns, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

constexpr Eigen::Index SumRows = 300;

msi::FoundSets foundSets(const msi::Observation& data)
{
  return msi::searchSets(data, {}, [] { return false; });
}

double probabilityOf(const msi::Observation& data, const msi::FoundSets& sets, std::size_t option)
{
  for (const auto& [name, probability] :
    msi::effectProbabilities(msi::explanationsOf(data, sets), true, 0.0))
  {
    if (name == data.options()[option].effect->name)
    {
      return probability;
    }
  }
  return 0.0;
}

TEST(SetSearch, FindsWhatIsThereAndNothingElse)
{
  const Eigen::MatrixXd X = drawnNumbers(SumRows, 8, 1);
  const ColumnSums data(X, 4.0 * X.col(2) - 3.0 * X.col(5) + drawnNumbers(SumRows, 1, 2));
  const msi::FoundSets sets = foundSets(data);
  std::vector<std::size_t> set = sets.best->set;
  std::sort(set.begin(), set.end());
  EXPECT_EQ(set, (std::vector<std::size_t>{ 2, 5 }));
  EXPECT_GT(probabilityOf(data, sets, 2), 0.9);
  EXPECT_LT(probabilityOf(data, sets, 0), 0.2);
  const std::vector<msi::GapCause> causes = msi::foundCauses(data, sets, 0.9);
  ASSERT_EQ(causes.size(), 2U);
  EXPECT_EQ(causes.front().effect, data.options()[2].effect->name);
  EXPECT_NEAR(causes[0].share + causes[1].share, 0.9, 1e-12);
}

// The difference of two columns that are nearly the same: neither does anything alone.
TEST(SetSearch, FindsTwoThatUndoOneAnother)
{
  Eigen::MatrixXd X = drawnNumbers(SumRows, 4, 11);
  const Eigen::VectorXd difference = X.col(2);
  X.col(2) = X.col(1) + 0.05 * difference;
  const ColumnSums data(X, 3.0 * difference + drawnNumbers(SumRows, 1, 12));
  std::vector<std::size_t> set = foundSets(data).best->set;
  std::sort(set.begin(), set.end());
  EXPECT_EQ(set, (std::vector<std::size_t>{ 1, 2 }));
}

// Fits that are begun where a larger set was do not get anywhere.
class StuckWhenReduced : public ColumnSums
{
public:
  using ColumnSums::ColumnSums;
  msi::FitPointer reduced(const msi::ObservedFit& from, std::size_t positions) const override
  {
    auto stuck = std::make_shared<msi::ObservedFit>(*ColumnSums::reduced(from, positions));
    stuck->energy = nominal()->energy;
    return stuck;
  }
  msi::GroupEnergies energies(const msi::ObservedFit& fit) const override
  {
    return ColumnSums::energies(fit.energy == nominal()->energy ? *nominal() : fit);
  }
};

TEST(SetSearch, SharesKnowWhatWasFoundOnTheWay)
{
  const Eigen::MatrixXd X = drawnNumbers(SumRows, 8, 1);
  const Eigen::VectorXd y = 4.0 * X.col(2) - 3.0 * X.col(5) + drawnNumbers(SumRows, 1, 2);
  const ColumnSums plain(X, y);
  const std::vector<msi::GapCause> expected = msi::foundCauses(plain, foundSets(plain), 0.9);
  const StuckWhenReduced stuck(X, y);
  const std::vector<msi::GapCause> causes = msi::foundCauses(stuck, foundSets(stuck), 0.9);
  ASSERT_EQ(causes.size(), 2U);
  for (std::size_t c = 0; c < 2; ++c)
  {
    EXPECT_EQ(causes[c].effect, expected[c].effect);
    EXPECT_NEAR(causes[c].share, expected[c].share, 1e-12);
    EXPECT_NEAR(causes[c].shrink, expected[c].shrink, 1e-12);
  }
}

TEST(SetSearch, NoiseIsNothing)
{
  const ColumnSums data(drawnNumbers(SumRows, 8, 3), drawnNumbers(SumRows, 1, 4));
  const msi::FoundSets sets = foundSets(data);
  EXPECT_TRUE(sets.best->set.empty());
  EXPECT_EQ(msi::effectProbabilities(msi::explanationsOf(data, sets), false, 0.0).size(),
    10U); // each effect, "nothing" and "unknown"
}

TEST(SetSearch, TwoThatDoTheSameAreEquivalent)
{
  Eigen::MatrixXd X = drawnNumbers(SumRows, 6, 5);
  X.col(4) = X.col(1);
  const ColumnSums data(X, 4.0 * X.col(1) + drawnNumbers(SumRows, 1, 6));
  const msi::FoundSets sets = foundSets(data);
  ASSERT_EQ(sets.best->set.size(), 1U);
  const msi::GapCause cause = msi::foundCauses(data, sets, 1.0).front();
  const std::size_t other = sets.best->set.front() == 1 ? 4 : 1;
  EXPECT_EQ(cause.equivalent, std::vector<std::string>{ data.options()[other].effect->name });
  EXPECT_NEAR(probabilityOf(data, sets, 1), probabilityOf(data, sets, 4), 1e-9);
}

// Column 0 is all, column 1 most of it.
TEST(SetSearch, WhatDoesMostBesideNumbersOfChannelsIsEquivalentToThem)
{
  Eigen::MatrixXd X = drawnNumbers(SumRows, 2, 8);
  const Eigen::VectorXd y = 5.0 * X.col(0);
  X.col(1) = 0.9 * X.col(0) + 0.4 * X.col(1);
  ColumnSums data(X, y);
  const auto equivalents = [&data](double score)
  {
    const msi::FitPointer nominal = data.nominal();
    const msi::FitPointer best = data.extended(*nominal, { 0, {}, {} });
    const msi::FitPointer most = data.extended(*nominal, { 1, {}, {} });
    const msi::FitPointer both = data.extended(*best, { 1, {}, {} });
    const msi::FoundSets sets{ nominal, best, { best, most, both }, { 0.0, -50.0, score },
      { 0.0, -50.0, score } };
    return msi::foundCauses(data, sets, 1.0).front().equivalent;
  };
  EXPECT_TRUE(equivalents(-5.0).empty()); // one number beside one number
  data.makePerChannel(0);
  EXPECT_EQ(equivalents(-5.0), std::vector<std::string>{ data.options()[1].effect->name });
  EXPECT_TRUE(equivalents(-7.0).empty());
}

// The first column takes much of what the sum of two others does, and goes when they are both there.
TEST(SetSearch, AnEffectThatOnlyStoodInForOthersIsDropped)
{
  Eigen::MatrixXd X = drawnNumbers(SumRows, 6, 7);
  X.col(0) = 0.7 * (X.col(2) + X.col(3)) + 0.3 * X.col(0);
  const ColumnSums data(X, 4.0 * X.col(2) + 4.0 * X.col(3) + drawnNumbers(SumRows, 1, 8));
  std::vector<std::size_t> set = foundSets(data).best->set;
  std::sort(set.begin(), set.end());
  EXPECT_EQ(set, (std::vector<std::size_t>{ 2, 3 }));
}

// Column 2 is found beside column 5, but gets less than 3 % of what both get.
TEST(Conclude, WhatIsTooSmallToBeACauseIsNotBelievedToBeOne)
{
  const Eigen::MatrixXd X = drawnNumbers(SumRows, 8, 1);
  const ColumnSums data(X, 1.5 * X.col(2) - 30.0 * X.col(5) + drawnNumbers(SumRows, 1, 2));
  const msi::FoundSets sets = foundSets(data);
  ASSERT_EQ(sets.best->set.size(), 2U);
  msi::GapReport report;
  conclude(report, data, sets, { 0.98, 0.98 }, 1);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_GT(report.causes.front().probability, 0.9);
  ASSERT_EQ(report.uncredited.size(), 1U);
  EXPECT_LT(report.probabilityOf(report.uncredited.front()), 0.1);
}

// What is found but not credited is nothing where there is no gap, and unknown where there is one.
TEST(Conclude, TheVerdictAndTheProbabilitiesSayTheSame)
{
  const Eigen::MatrixXd X = drawnNumbers(SumRows, 8, 1);
  const ColumnSums data(X, 4.0 * X.col(2) + drawnNumbers(SumRows, 1, 2));
  const msi::FoundSets sets = foundSets(data);
  const std::string found = data.options()[2].effect->name;
  msi::GapReport report;
  msi::Evidence evidence;
  evidence.noticed = 0.5;
  conclude(report, data, sets, evidence, 1);
  EXPECT_EQ(report.verdict, msi::GapVerdict::NoGap);
  EXPECT_NEAR(report.probabilityOf("nothing"), 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(report.probabilityOf(found), 1.0 / 3.0, 0.01);
  EXPECT_EQ(report.probabilityOf("unknown"), 0.0);
  evidence.gap = true;
  conclude(report, data, sets, evidence, 1);
  EXPECT_EQ(report.verdict, msi::GapVerdict::Unexplained);
  const double odds = 3.0 + std::exp(-msi::Decision::EffectImprobability);
  EXPECT_NEAR(report.probabilityOf("unknown"), odds / (1.0 + odds), 1e-9);
  EXPECT_EQ(report.probabilityOf("nothing"), 0.0);
}

TEST(SignsOfStandIns, AnEffectOfEveryMediumIsNotTheMediums)
{
  const msi::EffectDefinition* gain = msi::findEffect("medium_gain");
  const msi::EffectDefinition* gloss = msi::findEffect("specular_component");
  std::vector<msi::GapOption> options{ { gain, "", "paper" }, { gain, "", "cotton" },
    { gain, "again", "cotton" }, { gloss, "", "paper" }, { gloss, "", "cotton" },
    { msi::findEffect("dark_offset"), "", "" } };
  options.back().inDisguise = true;
  EXPECT_EQ(msi::signsOfStandIns(options, {}), 0);
  EXPECT_EQ(msi::signsOfStandIns(options, { 0 }), 0);
  EXPECT_EQ(msi::signsOfStandIns(options, { 0, 4 }), 0);
  EXPECT_EQ(msi::signsOfStandIns(options, { 0, 2, 4 }), 2);
  EXPECT_EQ(msi::signsOfStandIns(options, { 5 }), 1);
  // The only medium there is.
  EXPECT_EQ(msi::signsOfStandIns({ options.front() }, { 0 }), 1);
}

// Two channels whose responses have 100 and 300 of energy, times gains, and 3 of something else each.
TEST(Criterion, LargeGainsDoNotCountAsGap)
{
  const auto left = [](double first, double second, bool ofChannels)
  {
    const Eigen::Array2d response(100.0, 300.0);
    const Eigen::Array2d gain(first, second);
    return msi::energiesBesideGain(
      response, gain * response, gain.square() * response + 3.0, ofChannels);
  };
  for (const bool ofChannels : { false, true })
  {
    const Eigen::ArrayXd small = left(0.05, 0.1, ofChannels);
    EXPECT_NEAR(small[0], 0.25 + 3.0, 1e-12);
    EXPECT_NEAR(small[1], 3.0 + 3.0, 1e-12);
    const Eigen::ArrayXd common = left(-0.5, -0.5, ofChannels); // of which .1 x .1 / .5 stays
    EXPECT_NEAR(common[0], 100.0 * 0.02 * 0.02 + 3.0, 1e-12);
    EXPECT_NEAR(common[1], 300.0 * 0.02 * 0.02 + 3.0, 1e-12);
  }
  EXPECT_NEAR(left(0.5, -0.8, true)[1], 300.0 * 0.0125 * 0.0125 + 3.0, 1e-12);
  EXPECT_GT(left(0.5, -0.8, false)[0], 25.0);
}

// Column 1 does the same on a medium as column 0.
TEST(Criterion, AnEffectOfTheOnlyMediumIsOneFormDearerThanTheCameras)
{
  Eigen::MatrixXd X = drawnNumbers(SumRows, 3, 9);
  X.col(1) = X.col(0);
  ColumnSums data(X, 4.0 * X.col(0) + drawnNumbers(SumRows, 1, 10));
  const msi::FitPointer nominal = data.nominal();
  const auto dearer = [&]
  {
    const msi::Criterion score(data, *nominal, 50.0, nominal->energy);
    return score(*data.extended(*nominal, { 0, {}, {} })) -
      score(*data.extended(*nominal, { 1, {}, {} }));
  };
  EXPECT_NEAR(dearer(), 0.0, 1e-9);
  data.makeOfMedium(1, "paper");
  EXPECT_NEAR(dearer(), msi::Decision::FormImprobability, 1e-9);
  data.makeOfMedium(2, "cotton");
  EXPECT_NEAR(dearer(), msi::Decision::StandIn, 1e-9);
}

TEST(SharesUnderPrecedence, AreShapleyValuesWithoutPrecedence)
{
  // Two players that do the same, and one of its own.
  const std::vector<double> shrink{ 0.0, 0.6, 0.6, 0.6, 0.3, 0.9, 0.9, 0.9 };
  const std::vector<double> share = msi::sharesUnderPrecedence(shrink, { 0, 0, 0 });
  EXPECT_NEAR(share[0], 0.3, 1e-12);
  EXPECT_NEAR(share[1], 0.3, 1e-12);
  EXPECT_NEAR(share[2], 0.3, 1e-12);
}

TEST(SharesUnderPrecedence, ThoseThatComeLaterGetWhatTheOthersLeave)
{
  const std::vector<double> shrink{ 0.0, 0.8, 0.9, 1.0 };
  const std::vector<double> share = msi::sharesUnderPrecedence(shrink, { 0, 1 });
  EXPECT_NEAR(share[0], 0.8, 1e-12);
  EXPECT_NEAR(share[1], 0.2, 1e-12);
}

} // namespace
