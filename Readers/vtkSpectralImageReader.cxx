#include "vtkSpectralImageReader.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkDataObject.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include "Formats/SpectralImageFile.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkSpectralImageReader);

namespace
{
msi::SpectralAxis axisOfFile(const msi::SpectralImageInfo& info)
{
  if (!info.wavelengths.empty())
  {
    return msi::axisOf(msi::WavelengthGrid(info.wavelengths));
  }
  return { info.bandNames, {} };
}
}

vtkSpectralImageReader::vtkSpectralImageReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

vtkSpectralImageReader::~vtkSpectralImageReader() = default;

void vtkSpectralImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames:";
  for (const auto& name : this->FileNames)
  {
    os << " " << name;
  }
  os << "\n" << indent << "Wavelengths:";
  for (const double wavelength : this->Wavelengths)
  {
    os << " " << wavelength;
  }
  os << "\n"
     << indent << "ArrayKind: " << this->ArrayKind << "\n"
     << indent << "ScaleIntegers: " << this->ScaleIntegers << "\n"
     << indent << "Variable: " << this->Variable << "\n"
     << indent << "Notes: " << this->Notes << "\n";
}

void vtkSpectralImageReader::AddFileName(const char* name)
{
  if (name && *name)
  {
    this->FileNames.emplace_back(name);
    this->Modified();
  }
}

void vtkSpectralImageReader::ClearFileNames()
{
  this->FileNames.clear();
  this->Modified();
}

const char* vtkSpectralImageReader::GetFileName(int i) const
{
  return i >= 0 && i < this->GetNumberOfFileNames()
    ? this->FileNames[static_cast<std::size_t>(i)].c_str()
    : nullptr;
}

void vtkSpectralImageReader::AddWavelength(double nanometres)
{
  this->Wavelengths.push_back(nanometres);
  this->Modified();
}

void vtkSpectralImageReader::ClearWavelengths()
{
  this->Wavelengths.clear();
  this->Modified();
}

void vtkSpectralImageReader::Open()
{
  if (this->File && this->OpenTime == this->GetMTime())
  {
    return;
  }
  this->File.reset();
  this->Notes.clear();
  if (this->FileNames.empty())
  {
    throw std::invalid_argument(
      "no file is given; set FileNames to one spectral image or to one file per channel");
  }
  msi::SpectralImageOptions options;
  options.wavelengths = this->Wavelengths;
  options.integers =
    this->ScaleIntegers ? msi::IntegerScaling::UnitRange : msi::IntegerScaling::Raw;
  options.variable = this->Variable;
  this->File = msi::openSpectralImage(this->FileNames, options);
  for (const auto& note : this->File->info().notes)
  {
    this->Notes += (this->Notes.empty() ? "" : "\n") + note;
  }
  this->OpenTime = this->GetMTime();
}

int vtkSpectralImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->Open();
      const auto& info = this->File->info();
      auto* out = outputs->GetInformationObject(0);
      const int extent[] = { 0, info.width - 1, 0, info.height - 1, 0, 0 };
      const double unit[] = { 1.0, 1.0, 1.0 };
      const double zero[] = { 0.0, 0.0, 0.0 };
      out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
      out->Set(vtkDataObject::SPACING(), unit, 3);
      out->Set(vtkDataObject::ORIGIN(), zero, 3);
      out->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      out->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
      vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, info.bands());
    });
}

int vtkSpectralImageReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->Open();
      const auto& info = this->File->info();
      auto* outInfo = outputs->GetInformationObject(0);
      auto* output = vtkImageData::GetData(outputs, 0);
      int extent[6];
      outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
      output->SetExtent(extent);
      output->SetSpacing(1.0, 1.0, 1.0);
      output->SetOrigin(0.0, 0.0, 0.0);

      const bool reflectance = this->ArrayKind == REFLECTANCE ||
        (this->ArrayKind == FROM_FILE && info.quantity == "reflectance");
      vtkNew<vtkFloatArray> array;
      array->SetName(reflectance ? msi::ReflectanceArray : msi::ResponsesArray);
      array->SetNumberOfComponents(info.bands());
      array->SetNumberOfTuples(output->GetNumberOfPoints());
      const std::ptrdiff_t rowSize =
        static_cast<std::ptrdiff_t>(info.bands()) * (extent[1] - extent[0] + 1);
      // A few megabytes a call, so that progress moves and a stop is heard.
      constexpr std::ptrdiff_t BlockValues = 4 << 20;
      const int rowsPerBlock =
        static_cast<int>(std::clamp<std::ptrdiff_t>(BlockValues / rowSize, 1, info.height));
      for (int y = extent[2]; y <= extent[3]; y += rowsPerBlock)
      {
        if (this->GetAbortExecute())
        {
          throw std::runtime_error("stopped by the user");
        }
        const int last = std::min(y + rowsPerBlock - 1, extent[3]);
        // VTK counts rows from the bottom, files from the top.
        const msi::PixelRegion region{ extent[0], extent[1] + 1, info.height - 1 - last,
          info.height - y };
        this->File->readBlock(
          region, {}, array->GetPointer((last - extent[2]) * rowSize), -rowSize);
        this->UpdateProgress(
          static_cast<double>(last - extent[2] + 1) / (extent[3] - extent[2] + 1));
      }
      msi::setAxis(output, array, axisOfFile(info));
      output->GetPointData()->SetScalars(array);

      vtkNew<vtkStringArray> notes;
      notes->SetName("Notes");
      for (const auto& note : info.notes)
      {
        notes->InsertNextValue(note);
      }
      if (!info.notes.empty())
      {
        output->GetFieldData()->AddArray(notes);
      }
    });
}
