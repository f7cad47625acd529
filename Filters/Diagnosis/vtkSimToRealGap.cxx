#include "vtkSimToRealGap.h"

#include "AlgorithmSupport.h"
#include "DiagnosisRun.h"
#include "GapReportTables.h"
#include "GapTables.h"
#include "SampleColumns.h"
#include "SampleSpread.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Camera/Effects/Effect.h"

vtkStandardNewMacro(vtkSimToRealGap);

namespace
{
// Effects of light from neighbouring samples, which samples that were left out no longer give.
void leaveOutNeighbours(std::vector<std::string>& without)
{
  for (const auto& effect : msi::effectRegistry())
  {
    if (effect.surround == msi::Surround::Near)
    {
      without.push_back(effect.definition.name);
    }
  }
}

std::string noteOnSubset(Eigen::Index used, Eigen::Index all, bool hasPositions)
{
  return std::to_string(used) + " of " + std::to_string(all) +
    " samples were used, spread evenly over media, scenes and levels (Maximum Samples)." +
    (hasPositions ? " Effects of light from neighbouring samples were not tried." : "");
}
}

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
     << indent << "MaximumSamples: " << this->MaximumSamples << "\n"
     << indent << "Folds: " << this->Folds << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "AddRest: " << this->AddRest << "\n"
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
      msi::GapCapture capture = msi::gapCaptureOf(camera, samples, responses);

      msi::GapOptions options;
      options.without = this->Without;
      options.maximumCauses = this->MaximumCauses;
      options.folds = this->Folds;
      options.seed = static_cast<std::uint64_t>(this->Seed);
      options.addRest = this->AddRest;
      if (this->ReflectanceNoise >= 0.0)
      {
        options.reflectanceNoise = this->ReflectanceNoise;
      }
      const auto all = capture.samples.reflectance.cols();
      vtkNew<vtkTable> chosen;
      if (this->MaximumSamples > 0 && all > this->MaximumSamples)
      {
        const auto rows = msi::spreadSamples(capture, this->MaximumSamples);
        capture = msi::capturedSubset(capture, rows);
        msi::copyRows(samples, rows, chosen);
        samples = chosen;
        if (capture.samples.x.size() > 0)
        {
          leaveOutNeighbours(options.without);
        }
      }
      msi::GapReport report = msi::runDiagnosis(this, capture, options);
      const auto used = capture.samples.reflectance.cols();
      if (used < all)
      {
        report.notes.insert(
          report.notes.begin(), noteOnSubset(used, all, capture.samples.x.size() > 0));
      }

      const auto output = [outputs](OutputPort port) { return vtkTable::GetData(outputs, port); };
      msi::writeSummary(report, output(SUMMARY));
      msi::writeWhere(report, output(WHERE));
      msi::writeCauses(report, output(CAUSES));
      msi::writeCandidates(report, output(CANDIDATES));
      msi::writeHeatMap(report, capture, output(HEAT_MAP));
      msi::writeTrend(report, capture, output(TREND));
      msi::writeSamples(report, capture, samples, output(SAMPLES));
      msi::writeCorrectedCamera(report, camera, output(CORRECTED_CAMERA));
      msi::writeNotes(report, output(NOTES));
    });
}
