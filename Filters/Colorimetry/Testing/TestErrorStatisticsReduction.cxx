#include "ErrorStatisticsReduction.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

TEST(ErrorStatisticsReduction, SummarizesWhatThisProcessHolds)
{
  vtkNew<vtkFloatArray> values;
  for (const float value : { 4.0f, 1.0f, std::numeric_limits<float>::quiet_NaN(), 2.0f, 3.0f })
  {
    values->InsertNextValue(value);
  }
  const auto summary = msi::summarize(values, nullptr);
  EXPECT_EQ(summary.count, 4);
  EXPECT_EQ(summary.nonFinite, 1);
  EXPECT_EQ(summary.mean, 2.5);
  EXPECT_EQ(summary.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.p95, 3.85);
  EXPECT_EQ(summary.max, 4.0);
}

TEST(ErrorStatisticsReduction, GivesNaNForNoValues)
{
  vtkNew<vtkFloatArray> values;
  const auto summary = msi::summarize(values, nullptr);
  EXPECT_EQ(summary.count, 0);
  EXPECT_TRUE(std::isnan(summary.mean));
  EXPECT_TRUE(std::isnan(summary.max));
}
}
