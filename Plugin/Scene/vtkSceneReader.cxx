#include "vtkSceneReader.h"

#include "AlgorithmSupport.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkFlatFieldCorrection.h"
#include "vtkImageData.h"
#include "vtkLabelImageReader.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSampleTableReader.h"
#include "vtkSmartPointer.h"
#include "vtkSpectralImageReader.h"
#include "vtkTable.h"

#include "Formats/FileKind.h"
#include "Formats/SceneFolder.h"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkSceneReader);

namespace
{
enum OutputPort
{
  ImagePort,
  LabelPort,
  PatchPort,
  ChartPort,
  SwatchPort,
  NumberOfPorts
};

// The first error of the algorithms inside, and their warnings, become those of the reader.
class MessagesOfParts : public vtkCommand
{
public:
  vtkTypeMacro(MessagesOfParts, vtkCommand);
  static MessagesOfParts* New() { return new MessagesOfParts; }

  void watch(vtkAlgorithm* part)
  {
    for (vtkObject* object :
      { static_cast<vtkObject*>(part), static_cast<vtkObject*>(part->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, this);
      object->AddObserver(vtkCommand::WarningEvent, this);
    }
  }

  // The text between "vtkClass (0xaddress): " and the end.
  static std::string textOf(const char* message)
  {
    std::string text(message ? message : "");
    const auto start = text.find("): ");
    text = start == std::string::npos ? text : text.substr(start + 3);
    text.erase(text.find_last_not_of(" \n") + 1);
    return text;
  }

  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    auto& texts = event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings;
    texts.push_back(textOf(static_cast<const char*>(data)));
  }

  void throwFirstError()
  {
    if (!this->Errors.empty())
    {
      const std::string first = this->Errors.front();
      this->Errors.clear();
      throw std::runtime_error(first);
    }
  }

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

vtkSmartPointer<vtkSpectralImageReader> readerOf(const std::vector<std::string>& files)
{
  if (files.empty())
  {
    return nullptr;
  }
  auto reader = vtkSmartPointer<vtkSpectralImageReader>::New();
  for (const auto& file : files)
  {
    reader->AddFileName(file.c_str());
  }
  reader->SetArrayKind(vtkSpectralImageReader::RESPONSES);
  return reader;
}

vtkSmartPointer<vtkAlgorithm> tableReaderOf(const std::string& file)
{
  if (file.empty())
  {
    return nullptr;
  }
  auto reader = vtkSmartPointer<vtkSampleTableReader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

void note(std::string& notes, const char* part, const std::string& first, std::size_t count)
{
  if (count > 0)
  {
    notes += std::string(notes.empty() ? "" : "\n") + part + ": " +
      std::filesystem::path(first).filename().string() +
      (count > 1 ? " and " + std::to_string(count - 1) + " more" : "");
  }
}

void note(std::string& notes, const char* part, const std::vector<std::string>& files)
{
  note(notes, part, files.empty() ? "" : files.front(), files.size());
}

std::string folderOf(const std::string& name)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path(name);
  if (fs::is_regular_file(path, error))
  {
    return path.has_parent_path() ? path.parent_path().string() : ".";
  }
  return name;
}
}

struct vtkSceneReader::Pipeline
{
  // By output; null where there is no file.
  std::array<vtkSmartPointer<vtkAlgorithm>, NumberOfPorts> last;
  vtkNew<MessagesOfParts> messages;
};

vtkSceneReader::vtkSceneReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NumberOfPorts);
}

vtkSceneReader::~vtkSceneReader() = default;

void vtkSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "WhiteReflectance: " << this->WhiteReflectance << "\n"
     << indent << "SaturationLevel: " << this->SaturationLevel << "\n"
     << indent << "Notes: " << this->Notes << "\n";
}

int vtkSceneReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port <= LabelPort ? "vtkImageData" : "vtkTable");
  return 1;
}

void vtkSceneReader::Open()
{
  if (this->Parts && this->OpenTime == this->GetMTime())
  {
    return;
  }
  this->Parts.reset();
  this->Notes.clear();
  if (this->FileName.empty())
  {
    throw std::invalid_argument("no scene is given; choose the folder of its image as File Name");
  }
  const auto scene = msi::findScene(folderOf(this->FileName));
  auto parts = std::make_unique<Pipeline>();
  auto raw = readerOf(scene.image);
  parts->messages->watch(raw);
  parts->last[ImagePort] = raw;
  if (!scene.white.empty() || !scene.dark.empty())
  {
    vtkNew<vtkFlatFieldCorrection> flat;
    raw->SetPreview(false);
    flat->SetInputConnection(0, raw->GetOutputPort());
    flat->SetWhiteReflectance(this->WhiteReflectance);
    flat->SetSaturationLevel(this->SaturationLevel);
    int port = 1;
    for (const auto* files : { &scene.white, &scene.dark })
    {
      if (auto frame = readerOf(*files))
      {
        frame->SetPreview(false);
        parts->messages->watch(frame);
        flat->SetInputConnection(port, frame->GetOutputPort());
      }
      ++port;
    }
    parts->messages->watch(flat);
    parts->last[ImagePort] = flat;
  }
  if (!scene.labels.empty())
  {
    auto labels = vtkSmartPointer<vtkLabelImageReader>::New();
    labels->SetFileName(scene.labels.c_str());
    parts->messages->watch(labels);
    parts->last[LabelPort] = labels;
  }
  const std::string* tables[] = { &scene.patches, &scene.calibration, &scene.tuning };
  for (int i = 0; i < 3; ++i)
  {
    if (auto table = tableReaderOf(*tables[i]))
    {
      parts->messages->watch(table);
      parts->last[static_cast<std::size_t>(PatchPort) + static_cast<std::size_t>(i)] = table;
    }
  }
  if (scene.white.empty())
  {
    this->Notes = "no white reference, so the colors are those of the camera and its lamp; put "
                  "images of a white tile into white/";
  }
  note(this->Notes, "image", scene.image);
  note(this->Notes, "white", scene.white);
  note(this->Notes, "dark", scene.dark);
  note(this->Notes, "labels", scene.labels, scene.labels.empty() ? 0 : 1);
  note(this->Notes, "patches", scene.patches, scene.patches.empty() ? 0 : 1);
  note(this->Notes, "chart", scene.calibration, scene.calibration.empty() ? 0 : 1);
  note(this->Notes, "swatches", scene.tuning, scene.tuning.empty() ? 0 : 1);
  this->Parts = std::move(parts);
  this->OpenTime = this->GetMTime();
}

int vtkSceneReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      using SDDP = vtkStreamingDemandDrivenPipeline;
      this->Open();
      for (const int port : { ImagePort, LabelPort })
      {
        auto* part = this->Parts->last[static_cast<std::size_t>(port)].GetPointer();
        auto* out = outputs->GetInformationObject(port);
        int extent[] = { 0, -1, 0, -1, 0, -1 };
        if (part)
        {
          part->UpdateInformation();
          this->Parts->messages->throwFirstError();
          auto* known = part->GetOutputInformation(0);
          known->Get(SDDP::WHOLE_EXTENT(), extent);
          out->CopyEntry(known, vtkDataObject::SPACING());
          out->CopyEntry(known, vtkDataObject::ORIGIN());
        }
        out->Set(SDDP::WHOLE_EXTENT(), extent, 6);
      }
      // The labels are small: each piece of the image may take them whole.
      outputs->GetInformationObject(ImagePort)->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      outputs->GetInformationObject(ImagePort)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    });
}

vtkTypeBool vtkSceneReader::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // The image is computed when it is asked for, not with the labels and tables; VTK then leaves what stands there, and knows
  // which part of the image that is.
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()) &&
    request->Get(vtkExecutive::FROM_OUTPUT_PORT()) > ImagePort)
  {
    outputs->GetInformationObject(ImagePort)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkSceneReader::RequestData(
  vtkInformation* request, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->Open();
      const int asked = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
      for (int port = 0; port < NumberOfPorts; ++port)
      {
        auto* part = this->Parts->last[static_cast<std::size_t>(port)].GetPointer();
        if (!part)
        {
          continue;
        }
        if (port == ImagePort)
        {
          if (asked > 0)
          {
            continue; // ProcessRequest
          }
          int extent[6];
          outputs->GetInformationObject(port)->Get(
            vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
          part->UpdateExtent(extent);
        }
        else
        {
          part->Update();
        }
        this->Parts->messages->throwFirstError();
        vtkDataObject::GetData(outputs, port)->ShallowCopy(part->GetOutputDataObject(0));
      }
      for (const auto& warning : this->Parts->messages->Warnings)
      {
        vtkWarningMacro(<< warning);
      }
      this->Parts->messages->Warnings.clear();
    });
}

int vtkSceneReader::CanReadFile(const char* name)
{
  std::error_code error;
  if (!name || !std::filesystem::is_directory(name, error) ||
    msi::fileKind(name) == msi::FileKind::Capture)
  {
    return 0;
  }
  try
  {
    msi::findScene(name);
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}
