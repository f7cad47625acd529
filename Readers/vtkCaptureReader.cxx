#include "vtkCaptureReader.h"

#include "AlgorithmSupport.h"
#include "CameraTable.h"
#include "SampleTableConversion.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Formats/Capture.h"
#include "Formats/FileKind.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>

vtkStandardNewMacro(vtkCaptureReader);

namespace
{
std::string folderOf(const std::string& name)
{
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path(name);
  if (path.filename() == "capture.json" && !fs::is_directory(path, error))
  {
    return path.has_parent_path() ? path.parent_path().string() : ".";
  }
  return name;
}

msi::CameraTable cameraOf(const msi::Capture& capture)
{
  const auto& curves = capture.camera;
  const auto& dark = capture.description.dark;
  Eigen::VectorXd offset = Eigen::VectorXd::Zero(curves.values.cols());
  std::copy(dark.begin(), dark.end(), offset.begin());
  msi::CameraTable camera{ { curves.wavelengths, curves.values.transpose(), std::move(offset),
    curves.names } };
  const auto& noise = capture.description.noise;
  if (noise.read && noise.shot)
  {
    camera.noise = msi::CameraNoise{};
    camera.noise->read = *noise.read;
    camera.noise->shot = *noise.shot;
  }
  return camera;
}

// Names stay text, so that "01" in one table is "01" in the other.
void addNames(const char* name, const std::vector<std::string>& names, vtkTable* table)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name);
  for (const auto& text : names)
  {
    column->InsertNextValue(text);
  }
  table->AddColumn(column);
}

void writeReadings(const msi::RepeatedResponses& readings, vtkTable* table)
{
  addNames("sample", readings.sample, table);
  vtkNew<vtkIntArray> repeat;
  repeat->SetName("repeat");
  for (const int number : readings.repeat)
  {
    repeat->InsertNextValue(number);
  }
  table->AddColumn(repeat);
  msi::SampleTable rest;
  rest.metadata = readings.metadata;
  rest.responses = readings.responses;
  rest.channelNames = readings.channelNames;
  msi::toVTK(rest, table);
}

std::vector<std::string> notesOf(const msi::Capture& capture)
{
  std::vector<std::string> notes = capture.description.notes;
  notes.insert(notes.end(), capture.camera.notes.begin(), capture.camera.notes.end());
  notes.insert(notes.end(), capture.samples.notes.begin(), capture.samples.notes.end());
  const auto& noise = capture.description.noise;
  if (noise.read.has_value() != noise.shot.has_value())
  {
    notes.emplace_back(
      "capture.json gives one of read and shot noise only: the repeats decide on both");
  }
  return notes;
}
}

vtkCaptureReader::vtkCaptureReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(3);
}

void vtkCaptureReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Notes: " << this->Notes << "\n";
  for (const std::string& name : this->FurtherCaptures)
  {
    os << indent << "FurtherCapture: " << name << "\n";
  }
}

void vtkCaptureReader::AddFurtherCapture(const char* name)
{
  if (name && *name)
  {
    this->FurtherCaptures.emplace_back(name);
    this->Modified();
  }
}

void vtkCaptureReader::ClearFurtherCaptures()
{
  if (!this->FurtherCaptures.empty())
  {
    this->FurtherCaptures.clear();
    this->Modified();
  }
}

int vtkCaptureReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Notes.clear();
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (this->FileName.empty())
      {
        throw std::invalid_argument(
          "no capture is given; choose its folder, or the capture.json in it, as File Name");
      }
      std::vector<std::string> folders{ folderOf(this->FileName) };
      std::transform(this->FurtherCaptures.begin(), this->FurtherCaptures.end(),
        std::back_inserter(folders), folderOf);
      const msi::Capture capture = msi::readCaptures(folders);
      msi::write(cameraOf(capture), vtkTable::GetData(outputs, 0));
      auto* samples = vtkTable::GetData(outputs, 1);
      msi::toVTK(capture.samples, samples);
      addNames("sample", capture.samples.sampleNames(), samples);
      writeReadings(capture.readings, vtkTable::GetData(outputs, 2));
      vtkNew<vtkStringArray> notes;
      notes->SetName("Notes");
      for (const auto& note : notesOf(capture))
      {
        this->Notes += (this->Notes.empty() ? "" : "\n") + note;
        notes->InsertNextValue(note);
      }
      if (notes->GetNumberOfValues() > 0)
      {
        samples->GetFieldData()->AddArray(notes);
      }
    });
}

int vtkCaptureReader::CanReadFile(const char* name)
{
  return name && msi::fileKind(name) == msi::FileKind::Capture ? 1 : 0;
}
