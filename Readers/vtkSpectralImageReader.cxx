#include "vtkSpectralImageReader.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "SpectralImage.h"
#include "SpectralPreview.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"

#include "Formats/FileKind.h"
#include "Formats/ImageSelection.h"
#include "Formats/Images/ArrayImage.h"
#include "Formats/Images/StackFiles.h"
#include "Formats/SpectralImageFile.h"
#include "Formats/Storage/AvailableMemory.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

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

template <typename ArrayType, typename Values>
void addField(vtkImageData* image, const char* name, const Values& values)
{
  if (values.empty())
  {
    return;
  }
  vtkNew<ArrayType> array;
  array->SetName(name);
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  image->GetFieldData()->AddArray(array);
}

// What else the file says, as field data.
void addDescription(vtkImageData* image, const msi::SpectralImageInfo& info)
{
  addField<vtkDoubleArray>(image, msi::FwhmArray, info.fwhm);
  addField<vtkUnsignedCharArray>(image, msi::GoodBandsArray, info.goodBands);
  addField<vtkStringArray>(image, "Notes", info.notes);
  std::vector<std::string> metadata;
  metadata.reserve(info.metadata.size());
  for (const auto& [key, value] : info.metadata)
  {
    metadata.push_back(key);
    metadata.back().append(" = ").append(value);
  }
  addField<vtkStringArray>(image, msi::FileMetadataArray, metadata);
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
     << indent << "Bands: " << this->Bands << "\n"
     << indent << "WavelengthRange: " << this->WavelengthRange[0] << ", "
     << this->WavelengthRange[1] << "\n"
     << indent << "OnlyGoodBands: " << this->OnlyGoodBands << "\n"
     << indent << "Preview: " << this->Preview << "\n"
     << indent << "WholeStack: " << this->WholeStack << "\n"
     << indent << "StackPattern: " << this->StackPattern << "\n"
     << indent << "Region: " << this->Region[0] << ", " << this->Region[1] << ", "
     << this->Region[2] << ", " << this->Region[3] << "\n"
     << indent << "Stride: " << this->Stride[0] << ", " << this->Stride[1] << "\n"
     << indent << "Variables: " << this->Variables << "\n"
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

std::vector<std::string> vtkSpectralImageReader::FilesToRead()
{
  this->StackPattern.clear();
  this->Warning.clear();
  if (this->FileNames.size() != 1)
  {
    return this->FileNames;
  }
  auto stack = msi::stackOf(this->FileNames.front());
  if (stack.files.empty())
  {
    return this->FileNames;
  }
  const std::string count = std::to_string(stack.files.size());
  if (this->WholeStack)
  {
    this->StackPattern = stack.pattern;
    this->Notes = count + " channels were read: " + stack.pattern;
    return std::move(stack.files);
  }
  this->Notes = "one channel of the " + count + " of " + stack.pattern;
  this->Warning = "this is one channel of " + count + " (" + stack.pattern +
    "), shown as gray levels; set Whole Stack to read them as one image";
  return this->FileNames;
}

void vtkSpectralImageReader::Open()
{
  if (this->File && this->OpenTime == this->GetMTime())
  {
    return;
  }
  this->File.reset();
  this->Picture.reset();
  this->Notes.clear();
  if (this->FileNames.empty())
  {
    throw std::invalid_argument(
      "no file is given; choose one spectral image, or one file per channel, as File Names");
  }
  msi::SpectralImageOptions options;
  options.wavelengths = this->Wavelengths;
  options.integers =
    this->ScaleIntegers ? msi::IntegerScaling::UnitRange : msi::IntegerScaling::Raw;
  options.variable = this->Variable;
  const auto files = this->FilesToRead();
  this->Variables.clear();
  for (const auto& name :
    files.size() == 1 ? msi::imageVariables(files.front()) : std::vector<std::string>{})
  {
    this->Variables += (this->Variables.empty() ? "" : "\n") + name;
  }
  auto file = msi::openSpectralImage(files, options);
  const int height = file->info().height;
  msi::ImageSelection selection;
  selection.bands = this->Bands;
  selection.shortestWavelength = this->WavelengthRange[0];
  selection.longestWavelength = this->WavelengthRange[1];
  selection.onlyGoodBands = this->OnlyGoodBands;
  selection.region = { this->Region[0], this->Region[1] + 1, this->Region[2], this->Region[3] + 1 };
  selection.strideX = this->Stride[0];
  selection.strideY = this->Stride[1];
  this->File = msi::selectFrom(std::move(file), selection, this->FileNames.front());
  this->Origin[0] = selection.region.x0;
  this->Origin[1] = height - 1 -
    (selection.region.y0 +
      (this->File->info().height - 1) * static_cast<double>(selection.strideY));
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
      auto* out = outputs->GetInformationObject(0);
      try
      {
        this->Open();
      }
      catch (const std::exception&)
      {
        // Which of several variables is asked in the panel: without an answer reading is what fails.
        if (!this->Variable.empty() || this->Variables.find('\n') == std::string::npos)
        {
          throw;
        }
        const int onePixel[6] = {};
        out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), onePixel, 6);
        return;
      }
      const auto& info = this->File->info();
      const int extent[] = { 0, info.width - 1, 0, info.height - 1, 0, 0 };
      const double spacing[] = { static_cast<double>(this->Stride[0]),
        static_cast<double>(this->Stride[1]), 1.0 };
      const double origin[] = { this->Origin[0], this->Origin[1], 0.0 };
      out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
      out->Set(vtkDataObject::SPACING(), spacing, 3);
      out->Set(vtkDataObject::ORIGIN(), origin, 3);
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
      output->SetSpacing(this->Stride[0], this->Stride[1], 1.0);
      output->SetOrigin(this->Origin[0], this->Origin[1], 0.0);

      const bool reflectance = this->ArrayKind == REFLECTANCE ||
        (this->ArrayKind == FROM_FILE && info.quantity == "reflectance");
      vtkNew<vtkFloatArray> array;
      array->SetName(reflectance ? msi::ReflectanceArray : msi::ResponsesArray);
      array->SetNumberOfComponents(info.bands());
      const double pixels = static_cast<double>(output->GetNumberOfPoints());
      msi::requireMemory(
        pixels * (info.bands() * static_cast<double>(sizeof(float)) + (this->Preview ? 3 : 0)),
        this->FileNames.front() + ": an image of " + std::to_string(extent[1] - extent[0] + 1) +
          " x " + std::to_string(extent[3] - extent[2] + 1) + " pixels and " +
          std::to_string(info.bands()) + " bands",
        "read less of it: set Region, Stride or Bands of the reader");
      array->SetNumberOfTuples(output->GetNumberOfPoints());
      const std::ptrdiff_t rowSize =
        static_cast<std::ptrdiff_t>(info.bands()) * (extent[1] - extent[0] + 1);
      // A few megabytes a call, so that progress moves and a stop is heard.
      constexpr std::ptrdiff_t BlockValues = 4 << 20;
      // More ranks than pixels leave a rank without any.
      const int rowsPerBlock = static_cast<int>(std::clamp<std::ptrdiff_t>(
        BlockValues / std::max<std::ptrdiff_t>(rowSize, 1), 1, info.height));
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

      addDescription(output, info);
      if (this->Preview)
      {
        this->AddPreview(output, array);
      }
    });
}

void vtkSpectralImageReader::WarnOfPicture()
{
  const auto& info = this->File->info();
  if (this->Picture->isScreenPicture())
  {
    vtkWarningMacro(<< "an ordinary color picture: its values are encoded for a screen and are no "
                    << "camera responses; it is shown, but nothing can be measured in it: "
                    << this->FileNames.front());
  }
  else if (info.wavelengths.empty() && info.bands() > 1)
  {
    vtkWarningMacro(<< info.bands() << " channels without wavelengths; enter them in nm in the "
                    << "property Wavelengths; until then the picture is in false color, and colors "
                    << "cannot be computed: " << this->FileNames.front());
  }
  if (!this->Warning.empty())
  {
    vtkWarningMacro(<< this->Warning << ": " << this->FileNames.front());
  }
}

void vtkSpectralImageReader::AddPreview(vtkImageData* image, vtkFloatArray* spectra)
{
  if (!this->Picture)
  {
    this->Picture = std::make_unique<msi::SpectralPreview>(*this->File, this->ScaleIntegers);
    this->WarnOfPicture();
  }
  vtkNew<vtkUnsignedCharArray> picture;
  picture->SetName(this->Picture->isColorimetric() || this->Picture->isScreenPicture()
      ? msi::PictureArray
      : msi::FalseColorArray);
  picture->SetNumberOfComponents(3);
  picture->SetNumberOfTuples(spectra->GetNumberOfTuples());
  const float* in = spectra->GetPointer(0);
  unsigned char* out = picture->GetPointer(0);
  const vtkIdType bands = spectra->GetNumberOfComponents();
  msi::forBlocks(this, spectra->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    { this->Picture->apply(in + begin * bands, end - begin, out + 3 * begin); });
  msi::replaceArray(image, nullptr, picture);
  msi::setPictureWhite(image, this->Picture->white());
}

int vtkSpectralImageReader::CanReadFile(const char* name)
{
  return name && msi::fileKind(name) == msi::FileKind::SpectralImage ? 1 : 0;
}
