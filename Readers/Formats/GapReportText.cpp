#include "Formats/GapReportText.h"

#include <nlohmann/json.hpp>

namespace msi
{

namespace
{
// Keys in the order of writing.
using OrderedJson = nlohmann::ordered_json;

OrderedJson whereOf(const GapReport& report)
{
  OrderedJson where = OrderedJson::array();
  for (const GapAxis& axis : report.where)
  {
    OrderedJson worst = OrderedJson::array();
    for (const GapCell& cell : axis.worst)
    {
      worst.push_back({ { "cell", cell.cell }, { "share", cell.share } });
    }
    where.push_back({ { "axis", axis.axis }, { "share", axis.share }, { "worst", worst } });
  }
  return where;
}

OrderedJson causesOf(const GapReport& report)
{
  OrderedJson causes = OrderedJson::array();
  for (const GapCause& cause : report.causes)
  {
    OrderedJson parameters = OrderedJson::array();
    for (const GapParameter& parameter : cause.parameters)
    {
      parameters.push_back({ { "name", parameter.name }, { "value", parameter.value },
        { "unit", parameter.unit }, { "standard_error", parameter.standardError } });
    }
    OrderedJson alternatives = OrderedJson::array();
    for (const std::string& other : cause.equivalent)
    {
      alternatives.push_back(
        { { "effect", other }, { "probability", report.probabilityOf(other) } });
    }
    causes.push_back({ { "effect", cause.effect }, { "form", cause.form },
      { "medium", cause.medium }, { "share", cause.share }, { "probability", cause.probability },
      { "shrink", cause.shrink }, { "equivalent", cause.equivalent },
      { "alternatives", alternatives }, { "parameters", parameters } });
  }
  return causes;
}

// Names and numbers, in their order.
OrderedJson namedNumbers(const std::vector<std::pair<std::string, double>>& numbers)
{
  OrderedJson json = OrderedJson::object();
  for (const auto& [name, number] : numbers)
  {
    json[name] = number;
  }
  return json;
}

OrderedJson candidatesOf(const GapReport& report)
{
  OrderedJson candidates = OrderedJson::array();
  for (const GapCandidate& candidate : report.candidates)
  {
    candidates.push_back(
      { { "effect", candidate.effect }, { "form", candidate.form }, { "medium", candidate.medium },
        { "shrink", candidate.shrink }, { "shrink_interval", candidate.shrinkInterval } });
  }
  return candidates;
}

OrderedJson unexplainedOf(const GapRemainder& rest)
{
  OrderedJson json = { { "share", rest.share }, { "where", rest.where },
    { "depends_on", namedNumbers(rest.dependsOn) } };
  if (rest.rmsWithRest)
  {
    json["rms_with_rest"] = *rest.rmsWithRest;
  }
  return json;
}

OrderedJson captureOf(const GapNextCapture& next)
{
  OrderedJson json = { { "capture", next.capture }, { "separates", next.separates } };
  if (next.expectedBits && next.minutes)
  {
    json["expected_bits"] = *next.expectedBits;
    json["minutes"] = *next.minutes;
  }
  return json;
}

OrderedJson nextCaptureOf(const GapReport& report)
{
  const std::vector<GapNextCapture>& all = report.nextCaptures;
  OrderedJson json = captureOf(all.empty() ? GapNextCapture{} : all.front());
  OrderedJson others = OrderedJson::array();
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    others.push_back(captureOf(all[i]));
  }
  json["others"] = others;
  return json;
}

OrderedJson changePointsOf(const GapReport& report)
{
  OrderedJson points = OrderedJson::array();
  for (const GapChangePoint& point : report.changePoints)
  {
    points.push_back(
      { { "order", point.order }, { "change", point.change }, { "deviations", point.deviations } });
  }
  return points;
}
}

std::string gapReportText(const GapReport& report)
{
  const GapFigures& gap = report.gap;
  const OrderedJson json = { { "verdict", nameOf(report.verdict) },
    { "gap",
      { { "rms_before", gap.rmsBefore }, { "rms_after", gap.rmsAfter },
        { "noise_floor", gap.noiseFloor }, { "shrink", gap.shrink },
        { "shrink_interval", gap.shrinkInterval } } },
    { "where", whereOf(report) }, { "change_points", changePointsOf(report) },
    { "causes", causesOf(report) }, { "probabilities", namedNumbers(report.probabilities) },
    { "candidates", candidatesOf(report) }, { "unexplained", unexplainedOf(report.unexplained) },
    { "next_capture", nextCaptureOf(report) }, { "notes", report.notes } };
  // Names come from the user's tables: bytes that are no UTF-8 must not end the writing.
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

} // namespace msi
