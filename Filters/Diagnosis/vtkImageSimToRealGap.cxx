#include "vtkImageSimToRealGap.h"

#include "AlgorithmSupport.h"
#include "DiagnosisRun.h"
#include "GapReportTables.h"
#include "ImagePieces.h"
#include "SpectralImage.h"
#include "ThreadedParts.h"

#include "vtkDataObject.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include "Kernels/Gap/Field/FieldCorrection.h"
#include "Kernels/Gap/Field/FieldOddPixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkImageSimToRealGap);

namespace
{
constexpr const char* NameOfInput[] = { "the real image", "the simulated image",
  "the label image" };
constexpr int WindowSide = 128;

vtkSmartPointer<vtkFloatArray> newArray(const char* name, vtkFloatArray* like)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(like->GetNumberOfComponents());
  array->SetNumberOfTuples(like->GetNumberOfTuples());
  return array;
}

std::vector<int> labelsOf(vtkImageData* image, vtkIdType pixels)
{
  if (!image)
  {
    return {};
  }
  auto* array = msi::requireSpectralArray(image, NameOfInput[2]);
  msi::requireOneLabelPerPixel(array, NameOfInput[2]);
  std::vector<int> labels;
  for (vtkIdType i = 0; i < pixels; ++i)
  {
    const double label = array->GetComponent(i, 0);
    labels.push_back(std::isfinite(label) ? static_cast<int>(label) : 0);
  }
  return labels;
}

// The simulated image with the model's effects, and what is left of the gap.
void writeGap(const msi::FieldPair& pair, const msi::FieldGap& found, float* gap, float* after,
  float* corrected)
{
  const msi::FieldCorrection correction(pair, found.model);
  const Eigen::ArrayXf white = found.unit.inverse().cast<float>();
  const int columns = (pair.extent.width + WindowSide - 1) / WindowSide;
  const int rows = (pair.extent.height + WindowSide - 1) / WindowSide;
  const std::size_t K = pair.channels.size();
  vtkSMPThreadLocal<msi::CorrectionWorkspace> workspaces;
  msi::forParts(static_cast<vtkIdType>(columns) * rows,
    [&](vtkIdType number)
    {
      const int x = static_cast<int>(number % columns) * WindowSide;
      const int y = static_cast<int>(number / columns) * WindowSide;
      const msi::ImageWindow window{ x, y, std::min(WindowSide, pair.extent.width - x),
        std::min(WindowSide, pair.extent.height - y) };
      std::vector<float> values(window.pixels() * K);
      correction(window, values.data(), workspaces.Local());
      const float* value = values.data();
      for (int v = y; v < y + window.height; ++v)
      {
        for (std::size_t i = pair.index(x, v) * K; i < pair.index(x + window.width, v) * K; ++i)
        {
          const float real = pair.real[i] * white[static_cast<Eigen::Index>(i % K)];
          corrected[i] = *value++;
          gap[i] = real - pair.simulated[i];
          after[i] = real - corrected[i];
        }
      }
    });
}
}

vtkImageSimToRealGap::vtkImageSimToRealGap()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(NUMBER_OF_OUTPUTS);
}

void vtkImageSimToRealGap::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Without:";
  for (const auto& effect : this->Without)
  {
    os << " " << effect;
  }
  os << "\n"
     << indent << "MaximumCauses: " << this->MaximumCauses << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "AddRest: " << this->AddRest << "\n";
}

void vtkImageSimToRealGap::AddWithout(const char* effect)
{
  if (effect && effect[0] != '\0')
  {
    this->Without.emplace_back(effect);
    this->Modified();
  }
}

void vtkImageSimToRealGap::ClearWithout()
{
  if (!this->Without.empty())
  {
    this->Without.clear();
    this->Modified();
  }
}

int vtkImageSimToRealGap::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkImageSimToRealGap::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == GAP_MAP ? "vtkImageData" : "vtkTable");
  return 1;
}

int vtkImageSimToRealGap::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* real = inputs[0]->GetInformationObject(0);
      for (int port = 1; port < 3; ++port)
      {
        if (inputs[port]->GetNumberOfInformationObjects() > 0)
        {
          msi::requireSameSize(inputs[port]->GetInformationObject(0), NameOfInput[port], real,
            NameOfInput[0], "register and crop both to the same pixels");
        }
      }
    });
}

// The neighbourhood of every pixel counts: all of the images, whatever is asked for.
int vtkImageSimToRealGap::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 3; ++port)
  {
    msi::requestWhole(inputs, port);
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      auto* info = inputs[port]->GetInformationObject(i);
      std::array<int, 6> whole{};
      info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole.data(), 6);
    }
  }
  return 1;
}

int vtkImageSimToRealGap::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* realImage = vtkImageData::GetData(inputs[0]);
      auto* simulatedImage = vtkImageData::GetData(inputs[1]);
      auto* realArray = msi::requireSpectralArray(realImage, NameOfInput[0]);
      const auto real = msi::asFloats(realArray);
      const auto simulated =
        msi::asFloats(msi::requireSpectralArray(simulatedImage, NameOfInput[1]));
      const msi::SpectralAxis axis = msi::axisOf(realImage, realArray);
      msi::requireSameChannels(
        msi::axisOf(simulatedImage, simulated), NameOfInput[1], axis, NameOfInput[0]);
      if (simulated->GetNumberOfTuples() != real->GetNumberOfTuples())
      {
        throw std::invalid_argument("the simulated image shows another region than the real image");
      }
      const auto labels = labelsOf(vtkImageData::GetData(inputs[2]), real->GetNumberOfTuples());

      std::array<int, 3> size{};
      realImage->GetDimensions(size.data());
      msi::FieldPair pair;
      pair.extent = { size[0], size[1] };
      pair.channels = axis.names;
      pair.real = real->GetPointer(0);
      pair.simulated = simulated->GetPointer(0);
      pair.labels = labels.empty() ? nullptr : labels.data();
      pair = withoutFrame(std::move(pair));
      msi::GapOptions options;
      options.without = this->Without;
      options.maximumCauses = this->MaximumCauses;
      options.seed = static_cast<std::uint64_t>(this->Seed);
      options.addRest = this->AddRest;
      const msi::FieldGap found = msi::runDiagnosis(this, pair, options);

      auto* output = vtkImageData::GetData(outputs, GAP_MAP);
      output->CopyStructure(realImage);
      const auto gap = newArray("Gap", real);
      const auto after = newArray("GapAfter", real);
      const auto corrected = newArray("Corrected", real);
      writeGap(pair, found, gap->GetPointer(0), after->GetPointer(0), corrected->GetPointer(0));
      for (vtkFloatArray* array : { corrected.Get(), after.Get(), gap.Get() })
      {
        msi::setAxis(output, array, axis);
        output->GetPointData()->AddArray(array);
      }
      output->GetPointData()->SetActiveScalars("Gap");

      const auto table = [outputs](OutputPort port) { return vtkTable::GetData(outputs, port); };
      msi::writeSummary(found.report, table(SUMMARY));
      msi::writeEffects(found.report, pair.channels, table(SUMMARY));
      msi::writeWhere(found.report, table(WHERE));
      msi::writeCauses(found.report, table(CAUSES));
      msi::writeCandidates(found.report, table(CANDIDATES));
      msi::writeNotes(found.report, table(NOTES));
    });
}
