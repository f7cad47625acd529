#include "vtkSimToRealGap.h"

#include "AlgorithmSupport.h"
#include "DiagnosisRun.h"
#include "GapReportTables.h"
#include "GapTables.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkSimToRealGap);

vtkSimToRealGap::vtkSimToRealGap()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(NUMBER_OF_OUTPUTS);
}

void vtkSimToRealGap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Without:";
  for (const auto& effect : this->Without)
  {
    os << " " << effect;
  }
  os << "\n"
     << indent << "MaximumCauses: " << this->MaximumCauses << "\n"
     << indent << "Folds: " << this->Folds << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "ReflectanceNoise: " << this->ReflectanceNoise << "\n";
}

void vtkSimToRealGap::AddWithout(const char* effect)
{
  if (effect && effect[0] != '\0')
  {
    this->Without.emplace_back(effect);
    this->Modified();
  }
}

void vtkSimToRealGap::ClearWithout()
{
  if (!this->Without.empty())
  {
    this->Without.clear();
    this->Modified();
  }
}

int vtkSimToRealGap::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSimToRealGap::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    msi::requestWhole(inputs, port);
  }
  return 1;
}

int vtkSimToRealGap::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* camera = vtkTable::GetData(inputs[0]);
      auto* samples = vtkTable::GetData(inputs[1]);
      auto* responses = vtkTable::GetData(inputs[2]);
      const msi::NamedGapCapture named = msi::gapCaptureOf(camera, samples, responses);

      msi::GapOptions options;
      options.without = this->Without;
      options.maximumCauses = this->MaximumCauses;
      options.folds = this->Folds;
      options.seed = static_cast<std::uint64_t>(this->Seed);
      if (this->ReflectanceNoise >= 0.0)
      {
        options.reflectanceNoise = this->ReflectanceNoise;
      }
      msi::GapReport report = msi::runDiagnosis(this, named.capture, options);
      msi::nameSamples(report, named.sampleNames);

      const auto output = [outputs](OutputPort port) { return vtkTable::GetData(outputs, port); };
      msi::writeSummary(report, output(SUMMARY));
      msi::writeWhere(report, output(WHERE));
      msi::writeCauses(report, output(CAUSES));
      msi::writeCandidates(report, output(CANDIDATES));
      msi::writeHeatMap(report, named.capture, output(HEAT_MAP));
      msi::writeTrend(report, named, output(TREND));
      msi::writeSamples(report, named, samples, output(SAMPLES));
      msi::writeCorrectedCamera(report, camera, output(CORRECTED_CAMERA));
      msi::writeNotes(report, output(NOTES));
    });
}
