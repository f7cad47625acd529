#include "vtkMetamerismCorrection.h"

#include "AlgorithmSupport.h"
#include "FitSummaryTable.h"
#include "ResponseRange.h"
#include "SampleColumns.h"
#include "TransformTable.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Estimation/EstimationMethod.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkMetamerismCorrection);

namespace
{
void writeHistory(const std::vector<msi::MetamerismRound>& history, vtkTable* table)
{
  vtkNew<vtkDoubleArray> columns[4];
  const char* names[] = { "round", "response_residual_rms", "reflectance_residual_rms",
    "mean_dE00" };
  for (int i = 0; i < 4; ++i)
  {
    columns[i]->SetName(names[i]);
    table->AddColumn(columns[i]);
  }
  for (std::size_t round = 0; round < history.size(); ++round)
  {
    columns[0]->InsertNextValue(static_cast<double>(round + 1));
    columns[1]->InsertNextValue(history[round].responseResidualRms);
    columns[2]->InsertNextValue(history[round].reflectanceResidualRms);
    columns[3]->InsertNextValue(history[round].meanColorDifference.value_or(std::nan("")));
  }
}
}

vtkMetamerismCorrection::vtkMetamerismCorrection()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
}

void vtkMetamerismCorrection::SetMethod(int method)
{
  const int last = static_cast<int>(msi::estimationMethods().size()) - 1;
  const int clamped = std::min(std::max(method, 0), last);
  if (this->Method != clamped)
  {
    this->Method = clamped;
    this->Modified();
  }
}

void vtkMetamerismCorrection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n"
     << indent << "Structure: " << this->Structure << "\n"
     << indent << "MaximumRounds: " << this->MaximumRounds << "\n"
     << indent << "StopOnColor: " << this->StopOnColor << "\n"
     << indent << "ColorThreshold: " << this->ColorThreshold << "\n"
     << indent << "Illuminant: " << this->Illuminant << "\n"
     << indent << "Observer: " << this->Observer << "\n"
     << indent << "TuningWeight: " << this->TuningWeight << "\n";
}

int vtkMetamerismCorrection::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkMetamerismCorrection::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  msi::requestWhole(inputs, 1);
  return 1;
}

int vtkMetamerismCorrection::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const auto chart =
        msi::requireMeasuredSamples(vtkTable::GetData(inputs[0]), "the calibration table");
      const auto medium =
        msi::requireMeasuredSamples(vtkTable::GetData(inputs[1]), "the tuning table");
      msi::requireAlike(chart, medium);
      msi::writeResponseRange(
        vtkTable::GetData(outputs, 0), { chart.samples.response, medium.samples.response });
      msi::EstimationOptions options;
      options.metamerism.structure = static_cast<msi::BandStructure>(this->Structure);
      options.metamerism.channelWavelengths = chart.channels.wavelengths;
      options.metamerism.maximumRounds = this->MaximumRounds;
      options.metamerism.tuningWeight = this->TuningWeight;
      if (this->StopOnColor)
      {
        const msi::TristimulusTransform color(*chart.bands.wavelengths,
          msi::Illuminant::named(this->Illuminant), msi::StandardObserver::named(this->Observer));
        options.metamerism.colorStop =
          msi::ColorStopRule{ color.weights(), color.whitePoint(), this->ColorThreshold };
      }
      const auto& methods = msi::estimationMethods();
      const auto& method = methods[static_cast<std::size_t>(this->Method)];
      const std::string name(method.name);
      const auto fit = method.fit(chart.samples, medium.samples, options);
      if (!fit.summary.complete && !fit.estimator->knowsUncertainty())
      {
        vtkWarningMacro(<< name << ": " << fit.summary.status);
      }
      auto* transform = vtkTable::GetData(outputs, 0);
      if (fit.factors)
      {
        msi::write(
          msi::ReflectanceTransform{ chart.bands, chart.channels, fit.factors->reflectance },
          transform);
      }
      else
      {
        msi::write(msi::EstimationModel{ chart.bands, chart.channels, fit.estimator }, transform);
      }
      msi::write(msi::MetamerismTransform{ chart.channels,
                   fit.factors ? fit.factors->metamerism
                               : msi::AffineTransform::identity(chart.samples.channels()) },
        vtkTable::GetData(outputs, 1));
      msi::write(name, fit.summary, vtkTable::GetData(outputs, 2));
      writeHistory(fit.history, vtkTable::GetData(outputs, 3));
      for (const auto& doubt : msi::doubtsOf(chart, &medium))
      {
        vtkWarningMacro(<< doubt);
      }
    });
}
