#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldStarts.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace
{
using msi::GapReport;
using msi::GapVerdict;
using namespace msi::test;
}

TEST(FieldGap, BandingOfRowsAndOfColumns)
{
  const TestScene scene(12);
  const double start[] = { 0.1, 0.45, 0.8 };
  const TestPair rows = changed(scene, 22,
    [&](double u, int k, int, int y, double)
    { return u * (1.0 + 0.012 * std::sin(2.0 * Pi * (y / 11.3 + start[k]))); });
  const GapReport report = diagnose(rows);
  expectFirst(report, "banding", "rows");
  EXPECT_EQ(report.causes.front().form, "rows");
  expectParameter(report, "banding", "period", 11.3, 0.05);
  expectParameter(report, "banding", "amplitude[C1]", 0.012, 0.001);
  expectParameter(report, "banding", "start[C2]", 0.45, 0.04);

  const TestPair columns = changed(scene, 23,
    [&](double u, int k, int x, int, double)
    { return u * (1.0 + 0.012 * std::sin(2.0 * Pi * (x / 7.7 + start[k]))); });
  const GapReport other = diagnose(columns);
  expectFirst(other, "banding", "columns");
  expectParameter(other, "banding", "period", 7.7, 0.05);
}

// A square wave a has the harmonics 4 a / (pi n), n odd, a sawtooth 2 a / (pi n).
TEST(FieldBanding, SinesOfASquareWaveAndOfASawtooth)
{
  constexpr Eigen::Index Lines = 240;
  Eigen::ArrayXXd profile(Lines, 2);
  for (Eigen::Index line = 0; line < Lines; ++line)
  {
    // Half a line off, so that no line lies on a step.
    const double cycle = (static_cast<double>(line) + 0.5) / 60.0;
    const double part = cycle - std::floor(cycle);
    profile(line, 0) = part < 0.5 ? 0.1 : -0.1;
    profile(line, 1) = 0.1 * (1.0 - 2.0 * part);
  }
  const msi::BandingSines sines = msi::nearestSines(profile);
  EXPECT_NEAR(sines.period, 60.0, 1e-9);
  for (int n = 1; n <= 3; ++n)
  {
    EXPECT_NEAR(sines.amplitude(0, n - 1), n == 2 ? 0.0 : 0.4 / (Pi * n), 2e-3) << n;
    EXPECT_NEAR(sines.amplitude(1, n - 1), 0.2 / (Pi * n), 2e-3) << n;
  }
}

// Three times the period has its energy, too, and a little of the noise's.
TEST(FieldBanding, ASineInNoiseHasItsOwnPeriod)
{
  const msi::CounterRandom random(7);
  Eigen::ArrayXXd profile(240, 1);
  for (int line = 0; line < 240; ++line)
  {
    profile(line, 0) = 0.03 * std::sin(2.0 * Pi * line / 18.6) +
      0.004 * random.normal(static_cast<std::uint64_t>(line));
  }
  const msi::BandingSines sines = msi::nearestSines(profile);
  EXPECT_NEAR(sines.period, 18.6, 0.2); // the periods that are tried
  EXPECT_NEAR(sines.amplitude(0, 0), 0.03, 0.001);
  EXPECT_NEAR(sines.rms, std::hypot(0.03 / std::sqrt(2.0), 0.004), 0.001);
}

TEST(FieldGap, StripesOfAnyPeriodicShape)
{
  const TestScene scene(44);
  const double start[] = { 0.1, 0.45, 0.8 };
  const auto part = [&](int place, double period, int k)
  {
    const double cycle = place / period + start[k];
    return cycle - std::floor(cycle);
  };
  const GapReport square = diagnose(changed(scene, 54,
    [&](double u, int k, int, int y, double)
    { return u * (part(y, 16.0, k) < 0.5 ? 1.03 : 0.97); }));
  expectFirst(square, "banding", "rows");
  EXPECT_EQ(square.causes.front().form, "row_harmonics");
  expectParameter(square, "banding", "period", 16.0, 0.2);
  const GapReport saw = diagnose(changed(scene, 55,
    [&](double u, int k, int x, int, double)
    { return u * (1.0 + 0.06 * (part(x, 21.0, k) - 0.5)); }));
  expectFirst(saw, "banding", "columns");
  EXPECT_EQ(saw.causes.front().form, "column_harmonics");
  expectParameter(saw, "banding", "period", 21.0, 0.2);
}

// Every row with an offset of its own: no sine, and so the notes say.
TEST(FieldGap, OffsetsOfRows)
{
  const TestScene scene(45);
  const msi::CounterRandom random(7, 3);
  Eigen::ArrayXXd offset(scene.height(), scene.channels());
  for (Eigen::Index i = 0; i < offset.size(); ++i)
  {
    offset(i) = 0.02 * random.normal(static_cast<std::uint64_t>(i));
  }
  offset.rowwise() -= offset.colwise().mean().eval(); // that would be a dark offset
  const TestPair pair =
    changed(scene, 56, [&](double u, int k, int, int y, double) { return u + offset(y, k); });
  const GapReport report = diagnose(pair);
  expectFirst(report, "banding", "rows");
  EXPECT_EQ(report.causes.front().form, "row_offsets");
  ASSERT_FALSE(report.notes.empty());
  EXPECT_NE(report.notes.front().find("the three sines that come nearest"), std::string::npos);
}

// The columns of a detector behind a filter wheel: the same in every channel, which is no sign of another effect.
TEST(FieldGap, GainsOfColumnsAreTheSameInEveryChannel)
{
  const TestScene scene(48, 8);
  const msi::CounterRandom random(8, 3);
  const GapReport report = diagnose(changed(scene, 58,
    [&](double u, int, int x, int, double)
    { return u * (1.0 + 0.05 * random.normal(static_cast<std::uint64_t>(x))); }));
  expectFirst(report, "banding", "columns");
  EXPECT_GT(report.probabilityOf("banding"), 0.7);
  EXPECT_LT(report.probabilityOf("unknown"), 0.3);
}

// Where the training blocks of some columns are dark, these say nothing of the columns' gains.
TEST(FieldGap, ColumnsInTheDarkSayNothing)
{
  const TestScene scene(49);
  const msi::CounterRandom random(9, 3);
  TestPair pair = changed(scene, 59,
    [&](double u, int, int x, int, double)
    { return u * (1.0 + 0.05 * random.normal(static_cast<std::uint64_t>(x))); });
  const msi::FieldData data = msi::prepareFieldData(pair.pair(), msi::GapOptions{}.seed,
    [](int count, const std::function<void(int)>& body)
    {
      for (int i = 0; i < count; ++i)
      {
        body(i);
      }
    });
  int dark = 0;
  for (const msi::FieldBlock& block : data.blocks)
  {
    const bool inDark = block.window.x >= 32 && block.window.x < 80 && block.fold >= 0;
    dark += inDark ? 1 : 0;
    for (int y = 0; inDark && y < block.window.height; ++y)
    {
      for (int i = 0; i < 3 * block.window.width; ++i)
      {
        const std::size_t at =
          3 * pair.pair().index(block.window.x, block.window.y + y) + static_cast<std::size_t>(i);
        pair.real[at] -= 0.999F * pair.simulated[at];
        pair.simulated[at] *= 0.001F;
      }
    }
  }
  ASSERT_GT(dark, 10);
  const GapReport report = diagnose(pair);
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "banding");
  EXPECT_GT(report.gap.shrink, 0.3);
}

TEST(FieldGap, OneDeadColumnIsNoBanding)
{
  const TestScene scene(46);
  const GapReport report = diagnose(
    changed(scene, 57, [](double u, int, int x, int, double) { return x == 80 ? 0.1 * u : u; }));
  SCOPED_TRACE(describe(report));
  EXPECT_TRUE(report.causes.empty());
  EXPECT_EQ(report.verdict, GapVerdict::Unexplained);
}

// Uneven light does the same as stripes that are nearly as wide as the image.
TEST(FieldStarts, StripesBelowFourCyclesAreSlow)
{
  const std::vector<msi::FieldChoice> choices = msi::fieldChoices({});
  const auto profile = std::find_if(choices.begin(), choices.end(),
    [](const msi::FieldChoice& choice)
    { return msi::isProfile(choice) && msi::isOfRows(choice) && !msi::isOffset(choice); });
  ASSERT_NE(profile, choices.end());
  constexpr Eigen::Index Lines = 160;
  const auto slowAt = [&](double cycles)
  {
    msi::FieldModel model(2);
    model[profile->terms.front().parameter].setOnes();
    const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(Lines, 0.5, Lines - 0.5) / Lines;
    const Eigen::ArrayXXd values = (2.0 * Pi * cycles * place + 0.4).sin().replicate(1, 2);
    model.stripes(true).profile =
      std::make_shared<const msi::FieldProfile>(msi::FieldProfile{ { values }, { values } });
    return msi::isSlow(*profile, model);
  };
  EXPECT_TRUE(slowAt(1.0));
  EXPECT_TRUE(slowAt(3.0));
  EXPECT_FALSE(slowAt(5.0));
  EXPECT_FALSE(slowAt(20.0));
}
