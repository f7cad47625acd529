#include "vtkMetamerismCorrection.h"

#include "AlgorithmSupport.h"
#include "FitSummaryTable.h"
#include "SampleColumns.h"
#include "TransformTable.h"

#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Estimation/MetamerismCorrection.h"
#include "Kernels/Estimation/MethodComparison.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RModelCorrection.h"

#include <cmath>

vtkStandardNewMacro(vtkMetamerismCorrection);

namespace
{
// What a method leaves behind, whatever the method.
struct Correction
{
  msi::FitSummary summary;
  msi::AffineTransform reflectance;
  msi::AffineTransform metamerism;
  std::vector<msi::MetamerismRound> history;
};

Correction linearCorrection(msi::AffineTransform transform, msi::FitSummary summary)
{
  auto identity = msi::AffineTransform::identity(transform.inputs());
  return { std::move(summary), std::move(transform), std::move(identity), {} };
}

Correction rModelCorrection(const msi::SampleSet& calibration, const msi::SampleSet& tuning)
{
  const auto direct = msi::fitPseudoinverse(calibration);
  const auto model = msi::fitRModel(direct.transform(tuning.response), tuning.reflectance);
  return linearCorrection(
    msi::AffineTransform::compose(model.correction, direct.transform), model.summary);
}

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
      msi::requireSameChannels(
        chart.channels, "the calibration table", medium.channels, "the tuning table");
      msi::requireSameBands(chart.bands, "the calibration table", medium.bands, "the tuning table");
      const auto method = static_cast<msi::EstimationMethod>(this->Method);
      const std::string name(msi::nameOf(method));

      auto* out = vtkTable::GetData(outputs, 0);
      if (method == msi::EstimationMethod::Transfer)
      {
        const auto fit = msi::fitTransfer(chart.samples, medium.samples);
        msi::write(msi::TransferModel{ chart.bands, chart.channels, fit.estimator }, out);
        msi::write(msi::MetamerismTransform{ chart.channels,
                     msi::AffineTransform::identity(chart.samples.channels()) },
          vtkTable::GetData(outputs, 1));
        msi::write(name, fit.summary, vtkTable::GetData(outputs, 2));
        writeHistory({}, vtkTable::GetData(outputs, 3));
        return;
      }
      const auto correction = [&]() -> Correction
      {
        switch (method)
        {
          case msi::EstimationMethod::Direct:
          {
            auto fit = msi::fitPseudoinverse(chart.samples);
            return linearCorrection(fit.transform, fit.summary);
          }
          case msi::EstimationMethod::Pinv:
          {
            auto fit = msi::fitPseudoinverse(medium.samples);
            return linearCorrection(fit.transform, fit.summary);
          }
          case msi::EstimationMethod::Pooled:
          {
            auto fit = msi::fitPooled(
              chart.samples, medium.samples, this->TuningWeight > 0.0 ? this->TuningWeight : 1.0);
            return linearCorrection(fit.transform, fit.summary);
          }
          case msi::EstimationMethod::RModel:
            return rModelCorrection(chart.samples, medium.samples);
          default:
            break;
        }
        msi::MetamerismOptions options;
        options.structure = static_cast<msi::BandStructure>(this->Structure);
        options.channelWavelengths = chart.channels.wavelengths;
        options.maximumRounds = this->MaximumRounds;
        options.tuningWeight = this->TuningWeight;
        if (this->StopOnColor)
        {
          const msi::TristimulusTransform color(*chart.bands.wavelengths,
            msi::Illuminant::named(this->Illuminant), msi::StandardObserver::named(this->Observer));
          options.colorStop =
            msi::ColorStopRule{ color.weights(), color.whitePoint(), this->ColorThreshold };
        }
        const auto fit = msi::fitMetamerismCorrection(chart.samples, medium.samples, options);
        return { fit.summary, fit.reflectance, fit.metamerism, fit.history };
      }();
      if (!correction.summary.complete)
      {
        vtkWarningMacro(<< name << ": " << correction.summary.status);
      }
      msi::write(
        msi::ReflectanceTransform{ chart.bands, chart.channels, correction.reflectance }, out);
      msi::write(msi::MetamerismTransform{ chart.channels, correction.metamerism },
        vtkTable::GetData(outputs, 1));
      msi::write(name, correction.summary, vtkTable::GetData(outputs, 2));
      writeHistory(correction.history, vtkTable::GetData(outputs, 3));
    });
}
