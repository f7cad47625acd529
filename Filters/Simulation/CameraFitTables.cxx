#include "CameraFitTables.h"

#include "SampleColumns.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <string>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr double TwoSided95 = 1.96; // standard errors

void addWords(vtkTable* table, const char* name, const std::vector<std::string>& words)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name);
  for (const std::string& word : words)
  {
    column->InsertNextValue(word);
  }
  table->AddColumn(column);
}

void addCount(vtkTable* table, const char* name, Eigen::Index count)
{
  vtkNew<vtkIntArray> column;
  column->SetName(name);
  column->InsertNextValue(static_cast<int>(count));
  table->AddColumn(column);
}
}

void writeUncertainty(const CameraModelFit& fit, vtkTable* table)
{
  setNumbers(table, "wavelength", fit.camera.wavelengths().vector());
  for (Eigen::Index k = 0; k < fit.responsivityError.rows(); ++k)
  {
    setNumbers(table, fit.camera.channels()[static_cast<std::size_t>(k)],
      fit.responsivityError.row(k).transpose());
  }
  setNumbers(table, "resolution", fit.resolution);
  const Eigen::MatrixXd& m = fit.camera.responsivity();
  for (Eigen::Index k = 0; k < fit.responsivityError.rows(); ++k)
  {
    const std::string& name = fit.camera.channels()[static_cast<std::size_t>(k)];
    const auto width = TwoSided95 * fit.responsivityError.row(k);
    setNumbers(table, "low " + name, (m.row(k) - width).cwiseMax(0.0).transpose());
    setNumbers(table, "high " + name, (m.row(k) + width).transpose());
  }
  if (fit.darkError.size() > 0)
  {
    vtkNew<vtkDoubleArray> dark;
    dark->SetName("Dark");
    for (const double value : fit.darkError)
    {
      dark->InsertNextValue(value);
    }
    table->GetFieldData()->AddArray(dark);
  }
}

void writeSummary(const CameraModelFit& fit, vtkTable* table)
{
  const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  addCount(table, "samples", fit.summary.samples);
  addCount(table, "channels", fit.camera.channelCount());
  setNumbers(table, "held_out_rms", one(fit.heldOutRms));
  setNumbers(table, "residual_rms", one(fit.summary.residualRms));
  setNumbers(table, "locality", one(fit.chosen.locality));
  setNumbers(table, "smoothness", one(fit.chosen.smoothness));
  setNumbers(table, "freedom", one(fit.chosen.freedom));
  if (fit.curve)
  {
    setNumbers(table, "curve_square", one(fit.curve->square));
    setNumbers(table, "curve_held_out_rms", one(fit.curve->heldOutRms));
    setNumbers(table, "curve_deviations", one(fit.curve->deviations));
  }
  addCount(table, "determined", fit.determined);
  addCount(table, "directions", fit.camera.wavelengths().size());
  setNumbers(table, "condition", one(fit.summary.condition));
  addCount(table, "complete", fit.summary.complete ? 1 : 0);
  addWords(table, "status", { fit.summary.status });
}

void writeChannels(const CameraModelFit& fit, vtkTable* table)
{
  addWords(table, "channel", fit.camera.channels());
  setNumbers(table, "centroid", fit.camera.centroids());
  setNumbers(table, "dark", fit.camera.dark());
  if (fit.darkError.size() > 0)
  {
    setNumbers(table, "dark_error", fit.darkError);
  }
  setNumbers(table, "rms", fit.channelRms);
}

} // namespace msi
