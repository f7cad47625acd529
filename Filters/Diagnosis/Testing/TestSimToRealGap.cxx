#include "vtkSimToRealGap.h"

#include "GapTestTables.h"
#include "Support/vtk/Runs.h"

#include "vtkFieldData.h"
#include "vtkStringArray.h"

#include "Formats/EffectList.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
using msi::testing::cell;
using msi::testing::GapTestTables;
using msi::testing::textCell;

// A camera that answers 0.9 of what was simulated.
constexpr double Gain = 0.9;

class SimToRealGap : public ::testing::Test
{
protected:
  explicit SimToRealGap(double gain = Gain)
    : Tables(gain)
  {
    Gap->SetInputDataObject(0, Tables.camera);
    Gap->SetInputDataObject(1, Tables.samples);
    Gap->SetInputDataObject(2, Tables.responses);
  }
  void exchangeTwoSamples()
  {
    auto* names = vtkStringArray::SafeDownCast(Tables.responses->GetColumnByName("sample"));
    names->SetValue(3, "s18");
    names->SetValue(18, "s3");
  }
  vtkTable* output(int port) { return vtkTable::SafeDownCast(Gap->GetOutputDataObject(port)); }
  std::set<std::string> texts(int port, const std::string& column)
  {
    std::set<std::string> found;
    for (vtkIdType row = 0; row < output(port)->GetNumberOfRows(); ++row)
    {
      found.insert(textCell(output(port), row, column));
    }
    return found;
  }

  GapTestTables Tables;
  vtkNew<vtkSimToRealGap> Gap;
};

class NoGap : public SimToRealGap
{
protected:
  NoGap()
    : SimToRealGap(1.0)
  {
  }
};

TEST_F(SimToRealGap, FindsAGainAndPutsItBack)
{
  EXPECT_EQ(msi::testing::errorOf(Gap), "");
  auto* summary = output(vtkSimToRealGap::SUMMARY);
  EXPECT_EQ(textCell(summary, 0, "verdict"), "explained");
  EXPECT_GT(cell(summary, 0, "shrink"), 0.95);
  EXPECT_LE(cell(summary, 0, "shrink_low"), cell(summary, 0, "shrink"));
  auto* causes = output(vtkSimToRealGap::CAUSES);
  EXPECT_EQ(textCell(causes, 0, "effect"), "exposure_gain");
  EXPECT_EQ(textCell(causes, 0, "parameter"), "gain");
  EXPECT_NEAR(cell(causes, 0, "value"), Gain, 5.0 * cell(causes, 0, "standard_error"));
  EXPECT_LT(cell(causes, 0, "standard_error"), 0.002);
  EXPECT_EQ(textCell(causes, 0, "title"), "Exposure gain");

  const auto corrected = msi::readCamera(output(vtkSimToRealGap::CORRECTED_CAMERA), "corrected");
  const auto effects =
    msi::parseEffectList("corrected", corrected.effects, corrected.camera.channels());
  ASSERT_FALSE(effects.empty());
  EXPECT_EQ(effects[0].name, "exposure_gain");
  EXPECT_EQ(effects[0].parameters[0], cell(causes, 0, "value"));
  const auto given = msi::readCamera(Tables.camera, "given");
  EXPECT_EQ(corrected.camera.responsivity(), given.camera.responsivity());
}

TEST_F(SimToRealGap, ReportIsTheTextOfTheTables)
{
  Gap->Update();
  auto* field = output(vtkSimToRealGap::SUMMARY)->GetFieldData();
  const std::string report = field->GetAbstractArray("Report")->GetVariantValue(0).ToString();
  EXPECT_EQ(report.rfind("{\n  \"verdict\": \"explained\",", 0), 0u) << report.substr(0, 60);
  EXPECT_NE(report.find("\"effect\": \"exposure_gain\""), std::string::npos);
}

TEST_F(SimToRealGap, GapOfEachSampleIsTheGain)
{
  Gap->Update();
  auto* samples = output(vtkSimToRealGap::SAMPLES);
  ASSERT_EQ(samples->GetNumberOfRows(), GapTestTables::Samples);
  EXPECT_EQ(samples->GetColumnByName("R400"), nullptr);
  double sum = 0.0;
  for (vtkIdType row = 0; row < samples->GetNumberOfRows(); ++row)
  {
    // Four channels of noise, relative to the sum of their responses, which is 0.2 at least.
    EXPECT_NEAR(
      cell(samples, row, "gap_before"), Gain - 1.0, 5.0 * 2.0 * GapTestTables::ReadNoise / 0.2);
    sum += cell(samples, row, "gap_before");
  }
  EXPECT_NEAR(sum / GapTestTables::Samples, Gain - 1.0, 0.01);
  EXPECT_EQ(textCell(samples, 3, "sample"), "s3");
  EXPECT_EQ(textCell(samples, 3, "medium"), "fabric");
}

TEST_F(SimToRealGap, TrendFollowsTheOrder)
{
  Gap->Update();
  auto* trend = output(vtkSimToRealGap::TREND);
  ASSERT_EQ(trend->GetNumberOfRows(), GapTestTables::Samples);
  for (vtkIdType row = 0; row < trend->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(cell(trend, row, "order"), static_cast<double>(row + 1));
    EXPECT_NEAR(cell(trend, row, "level"), Gain - 1.0, 0.01); // no change point
  }
  EXPECT_EQ(textCell(trend, 0, "sample"), "s39");
}

TEST_F(SimToRealGap, SamplesThatWereExchangedAreNamedAndLeftOut)
{
  exchangeTwoSamples();
  Gap->Update();
  const std::set<std::string> notes = texts(vtkSimToRealGap::NOTES, "note");
  EXPECT_EQ(
    notes.count("Mixed up? Samples s3 and s18 fit much better when they are exchanged."), 1u);
  EXPECT_EQ(notes.count("Odd? s3 and s18 (2 of 40 samples) left out: far from what is found in all "
                        "others. Look at label, patch and readings."),
    1u);
  EXPECT_EQ(textCell(output(vtkSimToRealGap::SUMMARY), 0, "verdict"), "explained");
  EXPECT_EQ(textCell(output(vtkSimToRealGap::CAUSES), 0, "effect"), "exposure_gain");
}

TEST_F(NoGap, IsBesideTwoExchangedSamples)
{
  exchangeTwoSamples();
  Gap->Update();
  const std::set<std::string> notes = texts(vtkSimToRealGap::NOTES, "note");
  EXPECT_EQ(
    notes.count("Mixed up? Samples s3 and s18 fit much better when they are exchanged."), 1u);
  EXPECT_EQ(
    notes.count("Odd? s3 and s18 (2 of 40 samples), without which there is no gap: far from "
                "what is found in all others. Look at label, patch and readings."),
    1u);
}

TEST_F(SimToRealGap, HeatMapHasEveryChannelOfEveryGroup)
{
  Gap->Update();
  auto* map = output(vtkSimToRealGap::HEAT_MAP);
  // Two media, fifths of reflectance and order, nine places.
  EXPECT_EQ(map->GetNumberOfRows(), 4 * (2 + 5 + 5 + 9));
  EXPECT_EQ(texts(vtkSimToRealGap::HEAT_MAP, "kind"),
    (std::set<std::string>{ "medium", "reflectance", "order", "position" }));
  for (vtkIdType row = 0; row < map->GetNumberOfRows(); ++row)
  {
    EXPECT_LT(cell(map, row, "mean_before"), 0.0);
    EXPECT_GE(cell(map, row, "rms_before"), std::abs(cell(map, row, "mean_before")));
  }
}

TEST_F(SimToRealGap, UsesNoMoreSamplesThanAskedForAndSaysSo)
{
  Gap->SetMaximumSamples(24);
  EXPECT_EQ(msi::testing::errorOf(Gap), "");
  auto* samples = output(vtkSimToRealGap::SAMPLES);
  ASSERT_EQ(samples->GetNumberOfRows(), 24);
  int paper = 0;
  std::set<std::string> names;
  for (vtkIdType row = 0; row < samples->GetNumberOfRows(); ++row)
  {
    paper += textCell(samples, row, "medium") == "paper" ? 1 : 0;
    names.insert(textCell(samples, row, "sample"));
    // Each sample kept its own readings.
    EXPECT_NEAR(
      cell(samples, row, "gap_before"), Gain - 1.0, 5.0 * 2.0 * GapTestTables::ReadNoise / 0.2);
  }
  EXPECT_EQ(paper, 12);
  EXPECT_EQ(names.size(), 24u);
  EXPECT_EQ(textCell(output(vtkSimToRealGap::CAUSES), 0, "effect"), "exposure_gain");
  EXPECT_EQ(textCell(output(vtkSimToRealGap::NOTES), 0, "note"),
    "24 of 40 samples were used, spread evenly over media, scenes and levels (Maximum Samples). "
    "Effects of light from "
    "neighbouring samples were not tried.");
  EXPECT_EQ(texts(vtkSimToRealGap::CANDIDATES, "effect").count("local_stray_light"), 0u);
  Gap->SetMaximumSamples(0);
  Gap->Update();
  EXPECT_EQ(output(vtkSimToRealGap::SAMPLES)->GetNumberOfRows(), GapTestTables::Samples);
}

TEST_F(SimToRealGap, WithoutAnEffectAnotherIsNamed)
{
  Gap->AddWithout("exposure_gain");
  Gap->AddWithout("channel_gain");
  EXPECT_EQ(msi::testing::errorOf(Gap), "");
  EXPECT_EQ(texts(vtkSimToRealGap::CANDIDATES, "effect").count("exposure_gain"), 0u);
  EXPECT_EQ(texts(vtkSimToRealGap::CAUSES, "effect").count("exposure_gain"), 0u);
  EXPECT_EQ(texts(vtkSimToRealGap::CAUSES, "effect").count("channel_gain"), 0u);
  Gap->ClearWithout();
  Gap->Update();
  EXPECT_EQ(textCell(output(vtkSimToRealGap::CAUSES), 0, "effect"), "exposure_gain");
}

TEST_F(SimToRealGap, ResponsesMayStandInTheSamplesTable)
{
  for (const char* name : { "C1", "C2", "C3", "C4" })
  {
    Tables.samples->AddColumn(Tables.responses->GetColumnByName(name));
  }
  vtkNew<vtkSimToRealGap> together;
  together->SetInputDataObject(0, Tables.camera);
  together->SetInputDataObject(1, Tables.samples);
  together->Update();
  Gap->Update();
  for (int port = 0; port < vtkSimToRealGap::NUMBER_OF_OUTPUTS; ++port)
  {
    EXPECT_TRUE(msi::testing::bytesOf(together->GetOutputDataObject(port)) ==
      msi::testing::bytesOf(Gap->GetOutputDataObject(port)))
      << "output " << port;
  }
}

TEST_F(SimToRealGap, SameBytesInThreads)
{
  msi::testing::expectSameBytesInThreads(Gap);
}

TEST_F(SimToRealGap, CanBeStopped)
{
  EXPECT_EQ(msi::testing::errorWhenStopped(Gap), "stopped by the user");
}

TEST_F(NoGap, IsQuiet)
{
  EXPECT_EQ(msi::testing::errorOf(Gap), "");
  EXPECT_EQ(textCell(output(vtkSimToRealGap::SUMMARY), 0, "verdict"), "no gap");
  EXPECT_EQ(cell(output(vtkSimToRealGap::SUMMARY), 0, "shrink"), 0.0);
  EXPECT_EQ(output(vtkSimToRealGap::CAUSES)->GetNumberOfRows(), 0);
  const auto camera = msi::readCamera(output(vtkSimToRealGap::CORRECTED_CAMERA), "corrected");
  EXPECT_EQ(camera.effects, "");
}
}
