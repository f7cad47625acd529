#include "Formats/GapReportText.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace
{
using Json = nlohmann::json;

msi::GapReport filledReport()
{
  msi::GapReport report;
  report.verdict = msi::GapVerdict::PartlyExplained;
  report.gap = { 0.021, 0.003, 0.0009, 0.94, { 0.92, 0.96 } };
  report.where = { { "channel", 0.7, { { "C3", 0.3 }, { "C1", 0.2 } } }, { "medium", 0.1, {} } };
  report.causes = { { "filter_shift", "common", "", 0.9, 0.85, { "illuminant_drift" },
    { { "shift", 2.9, "nm", 0.05 } }, 0.6 } };
  report.probabilities = { { "filter_shift", 0.6 }, { "illuminant_drift", 0.3 },
    { "unknown", 0.1 } };
  report.candidates = { { "filter_shift", "common", "", 0.85, { 0.8, 0.9 } } };
  report.unexplained = { 0.06, "medium fabric", { { "medium", 0.8 }, { "level", 0.1 } }, 0.0015 };
  report.nextCaptures = { { "lamp spectrum", { "filter_shift", "illuminant_drift" }, 0.75, 5.0 },
    { "monochromator", { "filter_shift", "illuminant_drift" }, 0.5, 60.0 } };
  report.notes = { "One medium only." };
  return report;
}

// The example of the contract, with the keys that go beyond it.
TEST(GapReportText, WritesTheContract)
{
  const Json expected = Json::parse(R"({
    "verdict": "partly explained",
    "gap": {"rms_before": 0.021, "rms_after": 0.003, "noise_floor": 0.0009, "shrink": 0.94,
            "shrink_interval": [0.92, 0.96]},
    "where": [{"axis": "channel", "share": 0.7,
               "worst": [{"cell": "C3", "share": 0.3}, {"cell": "C1", "share": 0.2}]},
              {"axis": "medium", "share": 0.1, "worst": []}],
    "change_points": [],
    "causes": [{"effect": "filter_shift", "form": "common", "medium": "", "share": 0.9,
                "probability": 0.6, "shrink": 0.85, "equivalent": ["illuminant_drift"],
                "alternatives": [{"effect": "illuminant_drift", "probability": 0.3}],
                "parameters": [{"name": "shift", "value": 2.9, "unit": "nm", "standard_error": 0.05}]}],
    "probabilities": {"filter_shift": 0.6, "illuminant_drift": 0.3, "unknown": 0.1},
    "candidates": [{"effect": "filter_shift", "form": "common", "medium": "", "shrink": 0.85,
                    "shrink_interval": [0.8, 0.9]}],
    "unexplained": {"share": 0.06, "where": "medium fabric", "depends_on": {"medium": 0.8, "level": 0.1},
                    "rms_with_rest": 0.0015},
    "next_capture": {"capture": "lamp spectrum", "separates": ["filter_shift", "illuminant_drift"],
                     "expected_bits": 0.75, "minutes": 5.0,
                     "others": [{"capture": "monochromator", "separates": ["filter_shift", "illuminant_drift"],
                                 "expected_bits": 0.5, "minutes": 60.0}]},
    "notes": ["One medium only."]})");
  EXPECT_EQ(Json::parse(msi::gapReportText(filledReport())), expected);
}

TEST(GapReportText, KeysStandInTheOrderOfReading)
{
  const std::string text = msi::gapReportText(filledReport());
  EXPECT_LT(text.find("\"verdict\""), text.find("\"gap\""));
  EXPECT_LT(text.find("\"gap\""), text.find("\"where\""));
  EXPECT_LT(text.find("\"where\""), text.find("\"causes\""));
  EXPECT_EQ(text.back(), '\n');
}

TEST(GapReportText, AnEmptyReportHasEveryKey)
{
  const Json json = Json::parse(msi::gapReportText({}));
  EXPECT_EQ(json["verdict"], "no gap");
  EXPECT_EQ(json["causes"], Json::array());
  EXPECT_EQ(json["next_capture"], Json::parse(R"({"capture": "", "separates": [], "others": []})"));
}

TEST(GapReportText, WhatIsNoNumberIsNull)
{
  msi::GapReport report;
  report.gap.shrink = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Json::parse(msi::gapReportText(report))["gap"]["shrink"].is_null());
}

TEST(GapReportText, NamesThatAreNoUtf8AreWrittenAllTheSame)
{
  msi::GapReport report;
  report.unexplained.where = "medium \xff";
  EXPECT_EQ(Json::parse(msi::gapReportText(report))["unexplained"]["where"], "medium \xef\xbf\xbd");
}
}
