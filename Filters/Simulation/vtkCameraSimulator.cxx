#include "vtkCameraSimulator.h"

#include "AlgorithmSupport.h"
#include "CameraTable.h"
#include "ImagePicture.h"
#include "ImageSimulation.h"
#include "NameList.h"
#include "SampleColumns.h"
#include "SceneTable.h"
#include "SpectralImage.h"
#include "UsefulData.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include "Formats/EffectList.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraSimulator.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"
#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkCameraSimulator);

struct vtkCameraSimulator::Work
{
  msi::CameraModel camera;
  std::vector<msi::CameraEffect> effects;
  bool whiteAfterEffects;
  msi::CameraNoise noise;
  double whiteLevel;
};

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

msi::Extent wholeExtent(vtkInformation* information)
{
  msi::Extent extent{};
  information->Get(Pipeline::WHOLE_EXTENT(), extent.data());
  return extent;
}

// The responses of a table's own take the place of those that were there.
void removeResponses(vtkTable* table)
{
  if (const auto old = msi::findSpectra(table, msi::SampleQuantity::Response))
  {
    for (const std::string& name : old->columns)
    {
      table->RemoveColumnByName(name.c_str());
    }
  }
}
}

vtkCameraSimulator::vtkCameraSimulator()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

vtkCameraSimulator::~vtkCameraSimulator() = default;

void vtkCameraSimulator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
  os << indent << "Effects: " << this->Effects << "\n"
     << indent << "EffectList: " << this->EffectList << "\n"
     << indent << "EffectFile: " << this->EffectFile << "\n"
     << indent << "WhiteAfterEffects: " << this->WhiteAfterEffects << "\n"
     << indent << "Exposure: " << this->Exposure << "\n"
     << indent << "Noise: " << this->Noise << "\n"
     << indent << "ReadNoise: " << this->ReadNoise << "\n"
     << indent << "ShotNoise: " << this->ShotNoise << "\n"
     << indent << "FixedPatternGain: " << this->FixedPatternGain << "\n"
     << indent << "FixedPatternOffset: " << this->FixedPatternOffset << "\n"
     << indent << "QuantisationStep: " << this->QuantisationStep << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "ExposureNumber: " << this->ExposureNumber << "\n"
     << indent << "Repeats: " << this->Repeats << "\n"
     << indent << "ReflectanceArray: " << this->ReflectanceArray << "\n"
     << indent << "Media: " << this->Media << "\n"
     << indent << "MediumArray: " << this->MediumArray << "\n";
}

int vtkCameraSimulator::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port == 0)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  }
  return 1;
}

int vtkCameraSimulator::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  msi::requestWhole(inputs, 1);
  auto* input = inputs[0]->GetInformationObject(0);
  auto* output = outputs->GetInformationObject(0);
  if (!input->Has(Pipeline::WHOLE_EXTENT()) || this->WholeImage)
  {
    msi::requestWhole(inputs, 0);
  }
  if (!input->Has(Pipeline::WHOLE_EXTENT()))
  {
    return 1;
  }
  const auto whole = wholeExtent(input);
  if (this->WholeImage)
  {
    input->Set(Pipeline::UPDATE_EXTENT(), whole.data(), 6);
  }
  else
  {
    msi::requestWithMargin(input, output, this->Margin);
  }
  return 1;
}

vtkCameraSimulator::Work vtkCameraSimulator::Prepare(vtkTable* table)
{
  const msi::CameraTable camera = msi::readCamera(table, "the camera");
  if (!(this->Exposure > 0.0))
  {
    throw std::invalid_argument(
      "Exposure is " + std::to_string(this->Exposure) + "; expected more than 0");
  }
  const msi::CameraModel& model = camera.camera;
  Work work{ model.with(this->Exposure * model.responsivity(), model.dark()), {},
    this->WhiteAfterEffects, {}, camera.whiteLevel };
  if (this->Effects == OF_CAMERA && !camera.effects.empty())
  {
    work.effects = msi::parseEffectList("Effects", camera.effects, model.channels());
    work.whiteAfterEffects = work.whiteAfterEffects || camera.whiteAfterEffects;
  }
  else if (this->Effects == EFFECT_LIST)
  {
    work.effects = msi::parseEffectList("EffectList", this->EffectList, model.channels());
  }
  else if (this->Effects == EFFECT_FILE)
  {
    work.effects = msi::readEffectList(this->EffectFile, model.channels());
  }
  if (this->Noise == NOISE_OF_CAMERA)
  {
    work.noise = camera.noise.value_or(msi::CameraNoise());
  }
  else if (this->Noise == NOISE_AS_GIVEN)
  {
    work.noise = { this->ReadNoise, this->ShotNoise, this->FixedPatternGain,
      this->FixedPatternOffset, this->QuantisationStep };
  }
  return work;
}

void vtkCameraSimulator::SimulateTable(const Work& work, vtkTable* input, vtkTable* output)
{
  const msi::SampleScene scene = msi::sceneOf(input, work.camera.wavelengths(), "the sample table");
  const auto measured =
    msi::requireSpectra(input, msi::SampleQuantity::Reflectance, "the sample table");
  msi::requirePossibleReflectance(measured.values, "the sample table");
  const auto useless = msi::uselessChannel(work.camera, *measured.axis.wavelengths, "the camera");
  const msi::CameraSimulator simulator(work.camera, work.effects, { work.whiteAfterEffects });
  const msi::NoiseGenerator noise =
    simulator.noiseGenerator(work.noise, static_cast<std::uint64_t>(this->Seed));
  const Eigen::MatrixXd ideal = simulator.respond(scene);
  const Eigen::Index samples = scene.size();
  Eigen::MatrixXd response = ideal.replicate(1, this->Repeats);
  std::vector<Eigen::Index> rows;
  vtkNew<vtkIntArray> repeat;
  repeat->SetName("repeat");
  for (int i = 0; i < this->Repeats; ++i)
  {
    noise(response.middleCols(i * samples, samples), 0,
      static_cast<std::uint32_t>(this->ExposureNumber) + static_cast<std::uint32_t>(i));
    for (Eigen::Index row = 0; row < samples; ++row)
    {
      rows.push_back(row);
      repeat->InsertNextValue(i + 1);
    }
  }
  msi::copyRows(input, rows, output);
  removeResponses(output);
  if (this->Repeats > 1)
  {
    output->RemoveColumnByName("repeat");
    output->AddColumn(repeat);
  }
  msi::setSpectra(output, msi::SampleQuantity::Response, msi::channelsOf(work.camera), response);
  msi::setWhiteLevel(output, work.whiteLevel);
  if (!useless.empty())
  {
    vtkWarningMacro(<< useless);
  }
}

bool vtkCameraSimulator::SimulateImage(const Work& work, vtkInformation* information,
  vtkImageData* image, vtkInformation* outputInformation, vtkImageData* output)
{
  auto* array = msi::requireReflectanceArray(image, "the image", this->ReflectanceArray.c_str());
  const auto axis = msi::axisOf(image, array);
  if (!axis.wavelengths)
  {
    throw std::invalid_argument(
      "the image has no wavelengths; expected reflectance with the field data 'Wavelength'");
  }
  msi::ImageSimulationInput input{ image, this->ReflectanceArray, this->MediumArray,
    wholeExtent(information), msi::requestedExtent(outputInformation) };
  if (input.whole[4] != input.whole[5])
  {
    throw std::invalid_argument("the image has " +
      std::to_string(input.whole[5] - input.whole[4] + 1) + " layers; expected one");
  }
  msi::ImageSimulatorOptions options;
  options.noise = work.noise;
  options.seed = static_cast<std::uint64_t>(this->Seed);
  options.exposure = static_cast<std::uint32_t>(this->ExposureNumber);
  options.whiteAfterEffects = work.whiteAfterEffects;
  options.media = msi::namesIn(this->Media);
  const auto window =
    msi::ImageExtent{ input.whole[1] - input.whole[0] + 1, input.whole[3] - input.whole[2] + 1 };
  auto effects = work.effects;
  if (this->Effects == OF_CAMERA)
  {
    // The corrected camera of a diagnosis may have it.
    const auto drift = std::remove_if(effects.begin(), effects.end(),
      [](const msi::CameraEffect& effect) { return effect.name == "session_drift"; });
    if (drift != effects.end())
    {
      effects.erase(drift, effects.end());
      vtkWarningMacro("the camera's session_drift is left out: it changes samples that are "
                      "captured one after the other, and an image is captured at one time");
    }
  }
  const msi::ImageSimulator simulator(
    msi::resampled(work.camera, *axis.wavelengths), effects, window, options);
  if (simulator.needsMedium() && options.media.empty())
  {
    throw std::invalid_argument("an effect acts on one medium, but the image's media are not "
                                "named; set Media, and MediumArray where there are several");
  }
  this->Margin = simulator.halo();
  this->WholeImage = simulator.needsSceneMean();
  msi::Extent available{};
  image->GetExtent(available.data());
  const auto needed =
    this->WholeImage ? input.whole : msi::grown(input.extent, this->Margin, input.whole);
  if (!msi::contains(available, needed))
  {
    return false;
  }
  msi::simulateImage(this, simulator, input, work.camera, output);
  msi::setWhiteLevel(output, work.whiteLevel);
  msi::removePicture(output);
  if (this->Preview)
  {
    msi::setPicture(this, output, output->GetPointData()->GetScalars());
  }
  if (outputInformation->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0)
  {
    auto own = msi::requestedExtentWithoutGhosts(outputInformation);
    output->GenerateGhostArray(own.data());
  }
  return true;
}

int vtkCameraSimulator::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool second = request->Has(Pipeline::CONTINUE_EXECUTING()) != 0;
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const Work work = this->Prepare(vtkTable::GetData(inputs[1]));
      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        this->SimulateTable(work, table, vtkTable::GetData(outputs, 0));
        return;
      }
      auto* image = vtkImageData::GetData(inputs[0]);
      if (!image)
      {
        throw std::invalid_argument(
          "the first input is neither an image of reflectance nor a sample table");
      }
      if (image->GetNumberOfPoints() == 0)
      {
        return; // a piece without pixels
      }
      const bool done = this->SimulateImage(work, inputs[0]->GetInformationObject(0), image,
        outputs->GetInformationObject(0), vtkImageData::GetData(outputs, 0));
      if (!done && second)
      {
        throw std::runtime_error("the image's source gives fewer pixels than it was asked for");
      }
      if (!done)
      {
        // What an effect reaches is known only now that the camera is: once more, with that margin.
        request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
      }
    });
}
