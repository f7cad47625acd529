#include "vtkCameraModelFit.h"

#include "AlgorithmSupport.h"
#include "CameraFitTables.h"
#include "CameraTable.h"
#include "SampleColumns.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/EffectList.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraModelFit.h"

#include <cstdint>
#include <stdexcept>

vtkStandardNewMacro(vtkCameraModelFit);

namespace
{
// A camera's channels are named as the columns of its responses.
std::vector<std::string> columnsOf(const msi::SpectralAxis& channels)
{
  std::vector<std::string> names;
  for (const std::string& name : channels.names)
  {
    names.push_back(channels.wavelengths ? "C" + name : name);
  }
  return names;
}
}

vtkCameraModelFit::vtkCameraModelFit()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(4);
}

void vtkCameraModelFit::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PassbandWidth: " << this->PassbandWidth << "\n"
     << indent << "Folds: " << this->Folds << "\n"
     << indent << "Draws: " << this->Draws << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "DetectorCurve: " << this->DetectorCurve << "\n"
     << indent << "KeepDark: " << this->KeepDark << "\n";
}

int vtkCameraModelFit::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkCameraModelFit::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  msi::requestWhole(inputs, 1);
  return 1;
}

int vtkCameraModelFit::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const auto chart = msi::readSamples(vtkTable::GetData(inputs[0]), "the chart");
      msi::CameraModelFitOptions options;
      options.channels = columnsOf(chart.channels);
      options.passbandWidth = this->PassbandWidth;
      options.folds = this->Folds;
      options.draws = this->Draws;
      options.detectorCurve = this->DetectorCurve;
      options.seed = static_cast<std::uint64_t>(this->Seed);
      double whiteLevel = 1.0;
      if (auto* table = vtkTable::GetData(inputs[1]))
      {
        const auto nominal = msi::readCamera(table, "the nominal camera");
        whiteLevel = nominal.whiteLevel;
        options.nominal = msi::resampled(nominal.camera, *chart.bands.wavelengths);
      }
      if (this->KeepDark)
      {
        if (!options.nominal)
        {
          throw std::invalid_argument(
            "KeepDark is on, but there is no nominal camera on the second "
            "input; connect one or turn KeepDark off");
        }
        options.dark = options.nominal->dark();
      }
      const auto fit = msi::fitCameraModel(
        *chart.bands.wavelengths, chart.samples.reflectance, chart.samples.response, options);
      msi::CameraTable camera{ fit.camera };
      camera.whiteLevel = whiteLevel;
      if (this->DetectorCurve && fit.curve && fit.curve->found())
      {
        camera.effects = msi::effectListText(
          { { "detector_nonlinearity", "anchored", "", { fit.curve->square } } },
          fit.camera.channels());
      }
      msi::write(camera, vtkTable::GetData(outputs, 0));
      msi::writeUncertainty(fit, vtkTable::GetData(outputs, 1));
      msi::writeSummary(fit, vtkTable::GetData(outputs, 2));
      msi::writeChannels(fit, vtkTable::GetData(outputs, 3));
      for (const auto& doubt : msi::doubtsOf(chart))
      {
        vtkWarningMacro(<< doubt);
      }
    });
}
