#include "GapReportTables.h"

#include "CameraTable.h"
#include "SampleColumns.h"
#include "TableRows.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Formats/EffectList.h"
#include "Formats/GapReportText.h"
#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Gap/GapProfile.h"
#include "Kernels/Spectra/Interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace msi
{

namespace
{
constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const auto& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

struct EffectTexts
{
  std::string title, meaning, formula;
};

EffectTexts textsOf(const std::string& effect, const std::string& form)
{
  const EffectDefinition* definition = findEffect(effect);
  const EffectForm* found = definition ? findForm(*definition, form) : nullptr;
  return { definition ? definition->title : effect, definition ? definition->meaning : "",
    found ? found->meaning : "" };
}

// "gain[C3]" means what "gain" means.
std::string meaningOf(const std::string& parameter, const GapCause& cause)
{
  const EffectDefinition* definition = findEffect(cause.effect);
  const EffectForm* form = definition ? findForm(*definition, cause.form) : nullptr;
  const std::string name = parameter.substr(0, parameter.find('['));
  for (const EffectParameter& known : form ? form->parameters : std::vector<EffectParameter>{})
  {
    if (known.name == name)
    {
      return known.meaning;
    }
  }
  return {};
}

Eigen::MatrixXd simulatedResponses(const GapCapture& capture)
{
  const auto& grid = capture.camera.wavelengths();
  const Eigen::MatrixXd& reflectance = capture.samples.reflectance;
  if (grid == capture.wavelengths)
  {
    return cameraResponse(capture.camera)(reflectance);
  }
  return cameraResponse(capture.camera)(
    (resamplingMatrix(capture.wavelengths, grid) * reflectance).eval());
}

Eigen::VectorXd rmsOfSamples(const Eigen::MatrixXd& gap)
{
  Eigen::VectorXd rms(gap.cols());
  for (Eigen::Index i = 0; i < gap.cols(); ++i)
  {
    const auto measured = gap.col(i).array().isFinite();
    const double count = measured.cast<double>().sum();
    const double square = measured.select(gap.col(i).array().square(), 0.0).sum();
    rms[i] = count > 0.0 ? std::sqrt(square / count) : Nothing;
  }
  return rms;
}
}

void writeSummary(const GapReport& report, vtkTable* table)
{
  TableRows rows(table,
    { { "verdict", TextColumn }, { "rms_before", NumberColumn }, { "rms_after", NumberColumn },
      { "noise_floor", NumberColumn }, { "shrink", NumberColumn }, { "shrink_low", NumberColumn },
      { "shrink_high", NumberColumn }, { "unexplained_share", NumberColumn },
      { "unexplained_where", TextColumn }, { "unknown_probability", NumberColumn },
      { "next_capture", TextColumn }, { "separates", TextColumn },
      { "expected_bits", NumberColumn }, { "minutes", NumberColumn },
      { "rms_with_rest", NumberColumn } });
  const GapFigures& gap = report.gap;
  const GapNextCapture next =
    report.nextCaptures.empty() ? GapNextCapture{} : report.nextCaptures.front();
  rows.add({ nameOf(report.verdict), gap.rmsBefore, gap.rmsAfter, gap.noiseFloor, gap.shrink,
    gap.shrinkInterval[0], gap.shrinkInterval[1], report.unexplained.share,
    report.unexplained.where, report.probabilityOf("unknown"), next.capture, joined(next.separates),
    next.expectedBits.value_or(Nothing), next.minutes.value_or(Nothing),
    report.unexplained.rmsWithRest.value_or(Nothing) });
  vtkNew<vtkStringArray> text;
  text->SetName("Report");
  text->InsertNextValue(gapReportText(report));
  table->GetFieldData()->AddArray(text);
}

void writeEffects(
  const GapReport& report, const std::vector<std::string>& channels, vtkTable* table)
{
  if (!report.correction.empty())
  {
    vtkNew<vtkStringArray> text;
    text->SetName("Effects");
    text->InsertNextValue(effectListText(report.correction, channels));
    table->GetFieldData()->AddArray(text);
  }
}

void writeWhere(const GapReport& report, vtkTable* table)
{
  TableRows rows(table,
    { { "rank", CountColumn }, { "axis", TextColumn }, { "cell", TextColumn },
      { "share", NumberColumn } });
  int rank = 0;
  for (const GapAxis& axis : report.where)
  {
    rows.add({ ++rank, axis.axis, std::string(), axis.share });
    for (const GapCell& cell : axis.worst)
    {
      rows.add({ rank, axis.axis, cell.cell, cell.share });
    }
  }
}

void writeCauses(const GapReport& report, vtkTable* table)
{
  TableRows rows(table,
    { { "rank", CountColumn }, { "effect", TextColumn }, { "form", TextColumn },
      { "medium", TextColumn }, { "share", NumberColumn }, { "probability", NumberColumn },
      { "shrink", NumberColumn }, { "equivalent", TextColumn }, { "parameter", TextColumn },
      { "value", NumberColumn }, { "unit", TextColumn }, { "standard_error", NumberColumn },
      { "title", TextColumn }, { "meaning", TextColumn }, { "formula", TextColumn },
      { "parameter_meaning", TextColumn }, { "next_capture", TextColumn },
      { "equivalent_title", TextColumn } });
  int rank = 0;
  for (const GapCause& cause : report.causes)
  {
    ++rank;
    const EffectTexts texts = textsOf(cause.effect, cause.form);
    std::vector<std::string> equivalentTitles;
    for (const std::string& name : cause.equivalent)
    {
      equivalentTitles.push_back(textsOf(name, "").title);
    }
    auto parameters = cause.parameters;
    if (parameters.empty())
    {
      parameters.push_back({ "", Nothing, "", Nothing });
    }
    for (const GapParameter& parameter : parameters)
    {
      rows.add({ rank, cause.effect, cause.form, cause.medium, cause.share, cause.probability,
        cause.shrink, joined(cause.equivalent), parameter.name, parameter.value, parameter.unit,
        parameter.standardError, texts.title, texts.meaning, texts.formula,
        meaningOf(parameter.name, cause), requireEffect(cause.effect).separatingCapture.name,
        joined(equivalentTitles) });
    }
  }
}

void writeCandidates(const GapReport& report, vtkTable* table)
{
  TableRows rows(table,
    { { "rank", CountColumn }, { "effect", TextColumn }, { "form", TextColumn },
      { "medium", TextColumn }, { "shrink", NumberColumn }, { "shrink_low", NumberColumn },
      { "shrink_high", NumberColumn }, { "cause", CountColumn },
      { "equivalent_to_cause", CountColumn }, { "title", TextColumn } });
  int rank = 0;
  for (const GapCandidate& candidate : report.candidates)
  {
    int own = 0;
    int equivalent = 0;
    for (std::size_t i = 0; i < report.causes.size(); ++i)
    {
      const GapCause& cause = report.causes[i];
      const int number = static_cast<int>(i) + 1;
      if (cause.effect == candidate.effect && cause.medium == candidate.medium)
      {
        own = number;
      }
      const auto& names = cause.equivalent;
      if (equivalent == 0 && std::find(names.begin(), names.end(), candidate.effect) != names.end())
      {
        equivalent = number;
      }
    }
    rows.add({ ++rank, candidate.effect, candidate.form, candidate.medium, candidate.shrink,
      candidate.shrinkInterval[0], candidate.shrinkInterval[1], own, equivalent,
      textsOf(candidate.effect, candidate.form).title });
  }
}

void writeNotes(const GapReport& report, vtkTable* table)
{
  TableRows rows(table, { { "note", TextColumn } });
  for (const auto& note : report.notes)
  {
    rows.add({ note });
  }
}

void writeHeatMap(const GapReport& report, const GapCapture& capture, vtkTable* table)
{
  TableRows rows(table,
    { { "column", CountColumn }, { "row", CountColumn }, { "kind", TextColumn },
      { "group", TextColumn }, { "samples", CountColumn }, { "channel", TextColumn },
      { "mean_before", NumberColumn }, { "rms_before", NumberColumn },
      { "mean_after", NumberColumn }, { "rms_after", NumberColumn } });
  const auto groups = groupSamples(capture.samples);
  const GroupedGap before = groupGap(report.gapBefore, groups);
  const GroupedGap after = groupGap(report.gapAfter, groups);
  for (Eigen::Index g = 0; g < before.mean.cols(); ++g)
  {
    const SampleGroup& group = groups[static_cast<std::size_t>(g)];
    for (Eigen::Index k = 0; k < before.mean.rows(); ++k)
    {
      rows.add({ static_cast<int>(g), static_cast<int>(k), group.kind, group.name,
        static_cast<int>(group.samples.size()),
        capture.camera.channels()[static_cast<std::size_t>(k)], before.mean(k, g), before.rms(k, g),
        after.mean(k, g), after.rms(k, g) });
    }
  }
}

void writeTrend(const GapReport& report, const GapCapture& capture, vtkTable* table)
{
  TableRows rows(table,
    { { "order", NumberColumn }, { "sample", TextColumn }, { "gap_before", NumberColumn },
      { "gap_after", NumberColumn }, { "level", NumberColumn } });
  const GapTrend trend = trendOf(capture.samples, report, simulatedResponses(capture));
  for (std::size_t i = 0; i < trend.sample.size(); ++i)
  {
    const auto at = static_cast<Eigen::Index>(i);
    rows.add({ trend.order[at], capture.names[static_cast<std::size_t>(trend.sample[i])],
      trend.before[at], trend.after[at], trend.level[at] });
  }
}

void writeSamples(
  const GapReport& report, const GapCapture& capture, vtkTable* samples, vtkTable* table)
{
  std::set<std::string> spectral;
  for (const auto quantity : { SampleQuantity::Reflectance, SampleQuantity::Response })
  {
    if (const auto spectra = findSpectra(samples, quantity))
    {
      spectral.insert(spectra->columns.begin(), spectra->columns.end());
    }
  }
  for (vtkIdType i = 0; i < samples->GetNumberOfColumns(); ++i)
  {
    const char* name = samples->GetColumnName(i);
    if (name && spectral.count(name) == 0)
    {
      table->AddColumn(samples->GetColumn(i));
    }
  }
  const Eigen::MatrixXd simulated = simulatedResponses(capture);
  setNumbers(table, "gap_before", relativeGap(report.gapBefore, simulated));
  setNumbers(table, "gap_after", relativeGap(report.gapAfter, simulated));
  setNumbers(table, "rms_before", rmsOfSamples(report.gapBefore));
  setNumbers(table, "rms_after", rmsOfSamples(report.gapAfter));
  const auto& channels = capture.camera.channels();
  for (std::size_t k = 0; k < channels.size(); ++k)
  {
    const auto row = static_cast<Eigen::Index>(k);
    setNumbers(table, "before " + channels[k], report.gapBefore.row(row).transpose());
    setNumbers(table, "after " + channels[k], report.gapAfter.row(row).transpose());
  }
}

void writeCorrectedCamera(const GapReport& report, vtkTable* camera, vtkTable* table)
{
  CameraTable corrected = readCamera(camera, "the camera table");
  corrected.effects = report.correction.empty()
    ? std::string()
    : effectListText(report.correction, corrected.camera.channels());
  corrected.whiteAfterEffects = report.whiteAfterEffects;
  write(corrected, table);
}

} // namespace msi
