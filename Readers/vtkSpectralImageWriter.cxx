#include "vtkSpectralImageWriter.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include "Formats/SpectralImageWriter.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkSpectralImageWriter);

namespace
{
constexpr int BlockTag = 7041;
constexpr vtkIdType MiB = 1 << 20;

void requireRows(vtkImageData* image, const int whole[6], int first, int last)
{
  int extent[6];
  image->GetExtent(extent);
  if (extent[0] > whole[0] || extent[1] < whole[1] || extent[2] > first || extent[3] < last)
  {
    std::ostringstream message;
    message << "the pipeline gave columns " << extent[0] << " to " << extent[1] << ", rows "
            << extent[2] << " to " << extent[3] << " where columns " << whole[0] << " to "
            << whole[1] << ", rows " << first << " to " << last << " were asked for";
    throw std::runtime_error(message.str());
  }
}

int componentsOf(const std::vector<vtkDataArray*>& arrays)
{
  return std::accumulate(arrays.begin(), arrays.end(), 0,
    [](int sum, vtkDataArray* array) { return sum + array->GetNumberOfComponents(); });
}

// Rows [first, last] of an image as floats, top row first.
std::vector<float> rowsTopDown(vtkImageData* image, const std::vector<vtkDataArray*>& arrays,
  const int whole[6], int first, int last)
{
  requireRows(image, whole, first, last);
  const vtkIdType width = whole[1] - whole[0] + 1;
  const int components = componentsOf(arrays);
  const int* extent = image->GetExtent();
  const vtkIdType rowPoints = extent[1] - extent[0] + 1;
  std::vector<float> rows(
    static_cast<std::size_t>(last - first + 1) * static_cast<std::size_t>(width * components));
  int band = 0;
  for (auto* array : arrays)
  {
    auto* floats = vtkFloatArray::FastDownCast(array);
    const int count = array->GetNumberOfComponents();
    float* out = rows.data() + band;
    for (int y = last; y >= first; --y)
    {
      const vtkIdType start = (y - extent[2]) * rowPoints + (whole[0] - extent[0]);
      for (vtkIdType point = start; point < start + width; ++point, out += components)
      {
        for (int c = 0; c < count; ++c)
        {
          out[c] = floats ? floats->GetValue(point * count + c)
                          : static_cast<float>(array->GetComponent(point, c));
        }
      }
    }
    band += count;
  }
  return rows;
}

// As many as there are bands, or none.
std::vector<double> fieldNumbers(vtkImageData* image, const char* name, std::size_t bands)
{
  std::vector<double> numbers;
  auto* array = image->GetFieldData()->GetArray(name);
  if (array && array->GetNumberOfTuples() == static_cast<vtkIdType>(bands))
  {
    for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    {
      numbers.push_back(array->GetComponent(i, 0));
    }
  }
  return numbers;
}

// The reader's lines "key = value".
std::map<std::string, std::string> metadataOf(vtkImageData* image)
{
  constexpr const char* separator = " = ";
  std::map<std::string, std::string> metadata;
  auto* lines =
    vtkStringArray::SafeDownCast(image->GetFieldData()->GetAbstractArray(msi::FileMetadataArray));
  for (vtkIdType i = 0; lines && i < lines->GetNumberOfValues(); ++i)
  {
    const std::string line = lines->GetValue(i);
    const std::size_t at = line.find(separator);
    if (at != std::string::npos)
    {
      metadata.emplace(line.substr(0, at), line.substr(at + std::strlen(separator)));
    }
  }
  return metadata;
}

msi::SpectralImageInfo infoOf(
  vtkImageData* image, const std::vector<vtkDataArray*>& arrays, const int whole[6])
{
  msi::SpectralImageInfo info;
  info.width = whole[1] - whole[0] + 1;
  info.height = whole[3] - whole[2] + 1;
  if (arrays.size() > 1)
  {
    for (auto* array : arrays)
    {
      const std::string name = array->GetName() ? array->GetName() : "";
      for (int c = 0; c < array->GetNumberOfComponents(); ++c)
      {
        const char* component = array->GetComponentName(c);
        info.bandNames.push_back(array->GetNumberOfComponents() == 1 ? name
            : component                                              ? name + " " + component
                        : name + " " + std::to_string(c + 1));
      }
    }
    return info;
  }
  auto* array = arrays.front();
  const auto axis = msi::axisOf(image, array);
  info.bandNames = axis.names;
  if (axis.wavelengths)
  {
    info.wavelengths = axis.wavelengths->values();
    info.fwhm = fieldNumbers(image, msi::FwhmArray, axis.size());
    for (const double good : fieldNumbers(image, msi::GoodBandsArray, axis.size()))
    {
      info.goodBands.push_back(good != 0.0);
    }
  }
  info.metadata = metadataOf(image);
  const std::string name = array->GetName() ? array->GetName() : "";
  info.quantity = name == msi::ReflectanceArray ? "reflectance"
    : name == msi::ResponsesArray               ? "responses"
                                                : "";
  return info;
}

// What an algorithm and all before it hold of the block that was asked for.
unsigned long long bytesUpstream(vtkAlgorithm* algorithm, std::set<vtkAlgorithm*>& seen)
{
  if (!algorithm || !seen.insert(algorithm).second)
  {
    return 0;
  }
  constexpr unsigned long long KiB = 1024;
  unsigned long long bytes = 0;
  for (int port = 0; port < algorithm->GetNumberOfOutputPorts(); ++port)
  {
    if (auto* image = vtkImageData::SafeDownCast(algorithm->GetOutputDataObject(port)))
    {
      bytes += KiB * image->GetActualMemorySize();
    }
  }
  for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
    {
      bytes += bytesUpstream(algorithm->GetInputAlgorithm(port, i), seen);
    }
  }
  return bytes;
}

unsigned long long bytesUpstream(vtkAlgorithm* algorithm)
{
  std::set<vtkAlgorithm*> seen;
  return bytesUpstream(algorithm, seen);
}

msi::SampleType typeOf(int type)
{
  constexpr msi::SampleType Types[] = { msi::SampleType::Float32, msi::SampleType::Float64,
    msi::SampleType::UInt8, msi::SampleType::Int16, msi::SampleType::UInt16, msi::SampleType::Int32,
    msi::SampleType::UInt32 };
  return Types[type];
}
}

void vtkSpectralImageWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "PointArrays:";
  for (const auto& name : this->PointArrays)
  {
    os << " '" << name << "'";
  }
  os << "\n"
     << indent << "Interleave: " << this->Interleave << "\n"
     << indent << "SampleType: " << this->SampleType << "\n"
     << indent << "BigEndian: " << this->BigEndian << "\n"
     << indent << "ScaleFactor: " << this->ScaleFactor << "\n"
     << indent << "BlockSize: " << this->BlockSize << "\n";
}

void vtkSpectralImageWriter::AddPointArray(const char* name)
{
  if (name && *name)
  {
    this->PointArrays.emplace_back(name);
    this->Modified();
  }
}

void vtkSpectralImageWriter::ClearPointArrays()
{
  this->PointArrays.clear();
  this->Modified();
}

int vtkSpectralImageWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkSpectralImageWriter::Write()
{
  try
  {
    this->SetErrorCode(vtkErrorCode::NoError);
    this->InvokeEvent(vtkCommand::StartEvent);
    this->WriteBlocks();
    this->InvokeEvent(vtkCommand::EndEvent);
    return 1;
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

std::vector<vtkDataArray*> vtkSpectralImageWriter::ArraysOf(vtkImageData* image) const
{
  constexpr const char* Name = "the image to write";
  if (this->PointArrays.empty())
  {
    return { msi::requireSpectralArray(image, Name, this->SpectralArray.c_str()) };
  }
  std::vector<vtkDataArray*> arrays;
  for (const auto& name : this->PointArrays)
  {
    arrays.push_back(msi::requireSpectralArray(image, Name, name.c_str()));
  }
  return arrays;
}

std::unique_ptr<msi::SpectralImageWriter> vtkSpectralImageWriter::CreateFile(
  vtkImageData* image, const std::vector<vtkDataArray*>& arrays, const int whole[6]) const
{
  auto info = infoOf(image, arrays, whole);
  if (!(this->ScaleFactor > 0.0))
  {
    throw std::invalid_argument(
      "ScaleFactor is " + std::to_string(this->ScaleFactor) + "; expected more than 0");
  }
  info.reflectanceScale = this->ScaleFactor;
  msi::EnviWriteOptions options;
  const auto named = msi::interleaveOfName(this->FileName);
  options.interleave = named.value_or(msi::Interleave::BIL);
  if (this->Interleave != FROM_NAME)
  {
    constexpr msi::Interleave Interleaves[] = { msi::Interleave::BSQ, msi::Interleave::BIL,
      msi::Interleave::BIP };
    constexpr const char* Names[] = { "BSQ", "BIL", "BIP" };
    options.interleave = Interleaves[this->Interleave - BSQ];
    if (named && *named != options.interleave)
    {
      throw std::invalid_argument(this->FileName +
        ": the name says another interleave than the property "
        "Interleave, which is " +
        Names[this->Interleave - BSQ] + "; change one of them");
    }
  }
  options.type = typeOf(this->SampleType);
  options.byteOrder = this->BigEndian ? msi::ByteOrder::Big : msi::ByteOrder::Little;
  return msi::createSpectralImage(this->FileName, info, options);
}

void vtkSpectralImageWriter::WriteBlocks()
{
  if (this->FileName.empty())
  {
    throw std::invalid_argument("no file is given; choose where to write as File Name");
  }
  int port = 0;
  auto* source =
    this->GetNumberOfInputConnections(0) > 0 ? this->GetInputAlgorithm(0, 0, port) : nullptr;
  if (!source)
  {
    throw std::invalid_argument("there is no input; connect a spectral image");
  }
  source->UpdateInformation();
  int whole[6];
  auto* information = this->GetInputInformation();
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  if (whole[1] < whole[0] || whole[3] < whole[2])
  {
    throw std::invalid_argument("the input is an empty image");
  }

  auto* controller = msi::controllerOfTables();
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  const int rank = controller ? controller->GetLocalProcessId() : 0;
  std::unique_ptr<msi::SpectralImageWriter> writer;
  int rowsPerRank = 1; // until the first row has told what a row takes
  bool measured = false;
  for (int next = whole[3]; next >= whole[2];)
  {
    // The block [bottom, next], top part first, in one share of rows a rank.
    const int bottom = std::max(whole[2], next - rowsPerRank * ranks + 1);
    const auto share = [&](int r)
    {
      const int last = next - r * rowsPerRank;
      return std::make_pair(std::max(bottom, last - rowsPerRank + 1), last);
    };
    // A rank beyond the last rows updates one row all the same: updates may be collective.
    const auto [first, last] = share(rank);
    const bool mine = last >= bottom;
    int extent[6];
    std::copy(whole, whole + 6, extent);
    extent[2] = mine ? first : bottom;
    extent[3] = mine ? last : bottom;
    vtkNew<vtkInformation> request;
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    vtkNew<vtkInformationVector> requests;
    requests->SetInformationObject(port, request);
    source->Update(port, requests);
    auto* image = vtkImageData::SafeDownCast(this->GetInputDataObject(0, 0));
    const auto arrays = this->ArraysOf(image);
    const auto rows = mine ? rowsTopDown(image, arrays, whole, first, last) : std::vector<float>();
    if (rank > 0)
    {
      const vtkIdType size = static_cast<vtkIdType>(rows.size());
      controller->Send(&size, 1, 0, BlockTag);
      if (size > 0)
      {
        controller->Send(rows.data(), size, 0, BlockTag);
      }
    }
    else
    {
      if (!writer)
      {
        writer = this->CreateFile(image, arrays, whole);
      }
      writer->writeRows(last - first + 1, rows.data());
      for (int r = 1; r < ranks; ++r)
      {
        vtkIdType size = 0;
        controller->Receive(&size, 1, r, BlockTag);
        if (size > 0)
        {
          std::vector<float> received(static_cast<std::size_t>(size));
          controller->Receive(received.data(), size, r, BlockTag);
          const auto rowsOfRank = share(r);
          writer->writeRows(rowsOfRank.second - rowsOfRank.first + 1, received.data());
        }
      }
    }
    next = bottom - 1;
    if (!measured)
    {
      // All ranks alike, as the first one found.
      const auto held =
        std::max<unsigned long long>(1, bytesUpstream(source) / (extent[3] - extent[2] + 1));
      rowsPerRank = static_cast<int>(std::clamp<unsigned long long>(
        static_cast<unsigned long long>(this->BlockSize * MiB) / held, 1, whole[3] - whole[2] + 1));
      if (controller)
      {
        controller->Broadcast(&rowsPerRank, 1, 0);
      }
      measured = true;
    }
    this->UpdateProgress(static_cast<double>(whole[3] - next) / (whole[3] - whole[2] + 1));
    if (this->GetAbortExecute())
    {
      throw std::runtime_error("stopped by the user");
    }
  }
  if (writer)
  {
    writer->finish();
  }
  if (controller)
  {
    controller->Barrier(); // whoever reads the file next finds it
  }
}
