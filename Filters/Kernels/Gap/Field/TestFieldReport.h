// Image pairs made pixel by pixel, and what a test expects of their diagnosis.
#pragma once

#include "Kernels/Gap/Field/FieldTestScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

namespace msi::test
{

inline std::string describe(const GapReport& report)
{
  std::ostringstream text;
  text << nameOf(report.verdict) << ": rms " << report.gap.rmsBefore << " -> "
       << report.gap.rmsAfter << ", floor " << report.gap.noiseFloor << ", shrink "
       << report.gap.shrink << "\n";
  for (const auto& axis : report.where)
  {
    text << "  where " << axis.axis << " " << axis.share << "\n";
  }
  for (const auto& cause : report.causes)
  {
    text << "  cause " << cause.effect << " (" << cause.form << ") share " << cause.share;
    for (const auto& name : cause.equivalent)
    {
      text << " ~" << name;
    }
    for (const auto& parameter : cause.parameters)
    {
      text << "\n    " << parameter.name << " " << parameter.value << " +- "
           << parameter.standardError;
    }
    text << "\n";
  }
  for (const auto& note : report.notes)
  {
    text << "  note " << note << "\n";
  }
  return text.str();
}

// Within four standard errors or the tolerance that the forms' approximations leave.
inline void expectParameter(const GapReport& report, const std::string& effect,
  const std::string& name, double planted, double tolerance)
{
  const GapParameter* parameter = findParameter(report, effect, name);
  ASSERT_NE(parameter, nullptr) << effect << " " << name;
  EXPECT_NEAR(parameter->value, planted, std::fmax(tolerance, 4.0 * parameter->standardError))
    << effect << " " << name;
}

inline void expectFirst(
  const GapReport& report, const std::string& effect, const char* axis, double shrink = 0.85)
{
  SCOPED_TRACE(describe(report));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, effect);
  EXPECT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_GT(report.gap.shrink, shrink);
  ASSERT_FALSE(report.where.empty());
  EXPECT_EQ(report.where.front().axis, axis);
  EXPECT_FALSE(report.candidates.empty());
}

// Every pixel of the nominal image through change(u, channel, x, y, mean of the channel).
template <typename Change>
TestPair changed(const TestScene& scene, std::uint64_t seed, Change change)
{
  return makePair(
    scene,
    [&](int k)
    {
      ImagePlane plane = scene.pixels(scene.fine(k));
      const double mean = meanOf(plane);
      for (int y = 0; y < plane.height; ++y)
      {
        for (int x = 0; x < plane.width; ++x)
        {
          plane.at(x, y) = change(plane.at(x, y), k, x, y, mean);
        }
      }
      return plane;
    },
    seed);
}

inline GapReport diagnose(const TestPair& pair)
{
  return diagnoseField(pair.pair())->report;
}

} // namespace msi::test
