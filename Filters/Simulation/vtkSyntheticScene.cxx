#include "vtkSyntheticScene.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Kernels/Scenes/SyntheticScene.h"

#include <algorithm>
#include <cstdint>
#include <string>

vtkStandardNewMacro(vtkSyntheticScene);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

void writePatches(const msi::scenes::SyntheticScene& scene, vtkTable* table)
{
  const msi::scenes::PatchLayout& layout = scene.layout();
  vtkNew<vtkStringArray> sample;
  sample->SetName("sample");
  vtkNew<vtkStringArray> medium;
  medium->SetName("medium");
  vtkNew<vtkIntArray> label;
  label->SetName("label");
  const Eigen::Index count = scene.patchReflectance().cols();
  Eigen::VectorXd x(count);
  Eigen::VectorXd y(count);
  for (int patch = 0; patch < layout.count(); ++patch)
  {
    sample->InsertNextValue(scene.samples()[static_cast<std::size_t>(patch)]);
    medium->InsertNextValue(scene.medium());
    label->InsertNextValue(patch + 1);
    const int column = patch % layout.columns;
    const int row = patch / layout.columns;
    x[patch] = layout.left + column * layout.pitch + 0.5 * (layout.patchWidth - 1);
    y[patch] = layout.top + row * layout.pitch + 0.5 * (layout.patchHeight - 1);
  }
  table->AddColumn(sample);
  table->AddColumn(medium);
  table->AddColumn(label);
  msi::setNumbers(table, "x", x);
  msi::setNumbers(table, "y", y);
  msi::setSpectra(table, msi::SampleQuantity::Reflectance, msi::axisOf(scene.wavelengths()),
    scene.patchReflectance());
}

msi::scenes::SyntheticScene sceneOf(vtkSyntheticScene* source)
{
  msi::scenes::SceneOptions options;
  options.subject = source->GetSubject() == vtkSyntheticScene::FABRIC
    ? msi::scenes::SceneSubject::Fabric
    : source->GetSubject() == vtkSyntheticScene::CHART_140 ? msi::scenes::SceneSubject::Chart140
                                                           : msi::scenes::SceneSubject::Chart24;
  options.width = source->GetSize()[0];
  options.height = source->GetSize()[1];
  options.seed = static_cast<std::uint64_t>(source->GetSeed());
  options.texture = source->GetTexture();
  options.interreflection = source->GetInterreflection();
  options.yarnWidth = source->GetYarnWidth();
  return { msi::WavelengthGrid::uniform(
             source->GetWavelengths()[0], source->GetWavelengths()[1], source->GetWavelengths()[2]),
    options };
}

void draw(vtkAlgorithm* algorithm, const msi::scenes::SyntheticScene& scene, const int* extent,
  vtkImageData* output)
{
  output->Initialize();
  int region[6];
  std::copy_n(extent, 6, region);
  output->SetExtent(region);
  output->SetSpacing(1.0, 1.0, 1.0);
  output->SetOrigin(0.0, 0.0, 0.0);
  const vtkIdType bands = scene.wavelengths().size();
  const int width = extent[1] - extent[0] + 1;
  const int height = extent[3] - extent[2] + 1;
  vtkNew<vtkFloatArray> reflectance;
  reflectance->SetName(msi::ReflectanceArray);
  reflectance->SetNumberOfComponents(static_cast<int>(bands));
  reflectance->SetNumberOfTuples(output->GetNumberOfPoints());
  vtkNew<vtkIntArray> labels;
  labels->SetName(msi::LabelArray);
  labels->SetNumberOfTuples(output->GetNumberOfPoints());
  float* values = reflectance->GetPointer(0);
  int* label = labels->GetPointer(0);
  constexpr vtkIdType Run = 64;
  const vtkIdType runs = (width + Run - 1) / Run;
  msi::forBlocks(algorithm, runs * height,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType run = begin; run < end; ++run)
      {
        const vtkIdType row = run / runs;
        const vtkIdType first = run % runs * Run;
        const auto count = static_cast<int>(std::min(Run, width - first));
        const int x = extent[0] + static_cast<int>(first);
        // VTK counts rows from the bottom, the scene from the top.
        const int y = scene.layout().height - 1 - (extent[2] + static_cast<int>(row));
        const vtkIdType pixel = row * width + first;
        scene.reflectance(x, y, count, values + pixel * bands);
        for (int i = 0; i < count; ++i)
        {
          label[pixel + i] = scene.label(x + i, y);
        }
      }
    });
  output->GetPointData()->AddArray(labels);
  msi::setAxis(output, reflectance, msi::axisOf(scene.wavelengths()));
  msi::replaceArray(output, nullptr, reflectance);
}
}

vtkSyntheticScene::vtkSyntheticScene()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

void vtkSyntheticScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
  os << indent << "Subject: " << this->Subject << "\n"
     << indent << "Size: " << this->Size[0] << ", " << this->Size[1] << "\n"
     << indent << "Wavelengths: " << this->Wavelengths[0] << ", " << this->Wavelengths[1] << ", "
     << this->Wavelengths[2] << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "Texture: " << this->Texture << "\n"
     << indent << "Interreflection: " << this->Interreflection << "\n"
     << indent << "YarnWidth: " << this->YarnWidth << "\n";
}

int vtkSyntheticScene::FillOutputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkTable");
    return 1;
  }
  return this->Superclass::FillOutputPortInformation(port, info);
}

int vtkSyntheticScene::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const msi::scenes::SyntheticScene scene = sceneOf(this);
      auto* out = outputs->GetInformationObject(0);
      const int extent[] = { 0, this->Size[0] - 1, 0, this->Size[1] - 1, 0, 0 };
      const double spacing[] = { 1.0, 1.0, 1.0 };
      const double origin[] = { 0.0, 0.0, 0.0 };
      out->Set(Pipeline::WHOLE_EXTENT(), extent, 6);
      out->Set(vtkDataObject::SPACING(), spacing, 3);
      out->Set(vtkDataObject::ORIGIN(), origin, 3);
      out->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      vtkDataObject::SetPointDataActiveScalarInfo(
        out, VTK_FLOAT, static_cast<int>(scene.wavelengths().size()));
    });
}

int vtkSyntheticScene::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const msi::scenes::SyntheticScene scene = sceneOf(this);
      writePatches(scene, vtkTable::GetData(outputs, 1));
      // Who asks for the patches alone need not wait for the image.
      if (request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()) != 1)
      {
        const int* extent = outputs->GetInformationObject(0)->Get(Pipeline::UPDATE_EXTENT());
        auto* output = vtkImageData::GetData(outputs, 0);
        draw(this, scene, extent, output);
        if (this->Preview)
        {
          msi::setPicture(this, output, output->GetPointData()->GetScalars());
        }
      }
    });
}
