#include "vtkSpectralProfile.h"

#include "AlgorithmSupport.h"
#include "PatchSampling.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

vtkStandardNewMacro(vtkSpectralProfile);

namespace
{
// Pixels by their index in the image, x and y, both ends included.
struct PixelRange
{
  int first[2];
  int last[2];
};

std::string text(double x, double y)
{
  std::ostringstream out;
  out << "(" << x << ", " << y << ")";
  return out.str();
}
}

struct vtkSpectralProfile::Sampling : msi::PatchSampling
{
  std::vector<PixelRange> places; // none: by labels
};

vtkSpectralProfile::vtkSpectralProfile()
  : Current(std::make_unique<Sampling>())
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

vtkSpectralProfile::~vtkSpectralProfile() = default;

void vtkSpectralProfile::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SpectralArray: " << this->SpectralArray << "\n" << indent << "Points:";
  for (const auto& point : this->Points)
  {
    os << " " << text(point[0], point[1]);
  }
  os << "\n"
     << indent << "Place: " << this->Place << "\n"
     << indent << "Handle: " << text(this->Handle[0], this->Handle[1]) << "\n"
     << indent << "LineStart: " << text(this->LineStart[0], this->LineStart[1]) << "\n"
     << indent << "LineEnd: " << text(this->LineEnd[0], this->LineEnd[1]) << "\n"
     << indent << "LineCount: " << this->LineCount << "\n"
     << indent << "Region: " << this->Region[0] << ", " << this->Region[1] << ", "
     << this->Region[2] << ", " << this->Region[3] << "\n";
}

void vtkSpectralProfile::AddPoint(double x, double y)
{
  this->Points.push_back({ x, y });
  this->Modified();
}

void vtkSpectralProfile::ClearPoints()
{
  this->Points.clear();
  this->Modified();
}

std::vector<std::array<double, 2>> vtkSpectralProfile::PlacesOfPoints() const
{
  if (this->Place == HANDLE)
  {
    return { { this->Handle[0], this->Handle[1] } };
  }
  if (this->Place != LINE)
  {
    return this->Points;
  }
  std::vector<std::array<double, 2>> places;
  for (int i = 0; i < this->LineCount; ++i)
  {
    const double part = static_cast<double>(i) / (this->LineCount - 1);
    places.push_back({ this->LineStart[0] + part * (this->LineEnd[0] - this->LineStart[0]),
      this->LineStart[1] + part * (this->LineEnd[1] - this->LineStart[1]) });
  }
  return places;
}

int vtkSpectralProfile::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSpectralProfile::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  msi::declareCollective(outputs);
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* image = inputs[0]->GetInformationObject(0);
      auto* labels = inputs[1]->GetInformationObject(0);
      msi::requireSameSize(
        labels, "the label image", image, "the image", "expected one label per pixel");
      this->FindPlaces(image, labels != nullptr);
    });
}

void vtkSpectralProfile::FindPlaces(vtkInformation* image, bool labelled)
{
  auto& sampling = *this->Current;
  sampling.places.clear();
  sampling.blocks.setRows(0, -1);
  int whole[6];
  double origin[3] = { 0.0, 0.0, 0.0 };
  double spacing[3] = { 1.0, 1.0, 1.0 };
  image->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  if (image->Has(vtkDataObject::ORIGIN()))
  {
    image->Get(vtkDataObject::ORIGIN(), origin);
    image->Get(vtkDataObject::SPACING(), spacing);
  }
  if (labelled)
  {
    return;
  }
  const auto index = [&](std::ptrdiff_t axis, double x)
  { return (x - origin[axis]) / spacing[axis]; };
  const auto require = [&](const PixelRange& place, const std::string& name)
  {
    for (std::ptrdiff_t axis = 0; axis < 2; ++axis)
    {
      if (place.first[axis] < whole[2 * axis] || place.last[axis] > whole[2 * axis + 1] ||
        place.first[axis] > place.last[axis])
      {
        const auto at = [&](int a, int i) { return origin[a] + spacing[a] * i; };
        throw std::invalid_argument(name + " is not in the image, which reaches from " +
          text(at(0, whole[0]), at(1, whole[2])) + " to " + text(at(0, whole[1]), at(1, whole[3])));
      }
    }
    sampling.places.push_back(place);
  };
  const auto points = this->PlacesOfPoints();
  for (const auto& point : points)
  {
    const int x = static_cast<int>(std::lround(index(0, point[0])));
    const int y = static_cast<int>(std::lround(index(1, point[1])));
    require({ { x, y }, { x, y } }, "the point " + text(point[0], point[1]));
  }
  if (points.empty())
  {
    const auto& r = this->Region;
    PixelRange place{ { whole[0], whole[2] }, { whole[1], whole[3] } };
    if (r[0] != 0.0 || r[1] != 0.0 || r[2] != 0.0 || r[3] != 0.0)
    {
      for (std::ptrdiff_t axis = 0; axis < 2; ++axis)
      {
        place.first[axis] = static_cast<int>(std::ceil(index(axis, r[2 * axis])));
        place.last[axis] = static_cast<int>(std::floor(index(axis, r[2 * axis + 1])));
      }
    }
    require(place, "the region from " + text(r[0], r[2]) + " to " + text(r[1], r[3]));
  }
  int first = whole[3];
  int last = whole[2];
  for (const auto& place : sampling.places)
  {
    first = std::min(first, place.first[1]);
    last = std::max(last, place.last[1]);
  }
  sampling.blocks.setRows(first, last);
}

int vtkSpectralProfile::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  if (this->Current->blocks.request(inputs, { 0, 1 }))
  {
    this->Current->restart();
  }
  return 1;
}

int vtkSpectralProfile::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->Current->takeBlock(this, request, [&] { this->AddBlock(inputs); }))
  {
    return 1;
  }
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->WriteTable(
        outputs->GetInformationObject(0), inputs[1]->GetNumberOfInformationObjects() > 0);
    });
}

void vtkSpectralProfile::AddBlock(vtkInformationVector** inputs)
{
  auto& sampling = *this->Current;
  if (sampling.blocks.isEmpty())
  {
    return; // more ranks than rows
  }
  const auto& block = sampling.blocks.block();
  const auto image = msi::partOf(vtkImageData::GetData(inputs[0]), block);
  auto* array = msi::requireSpectralArray(image, "the image", this->SpectralArray.c_str());
  if (!std::equal(block.begin(), block.end(), image->GetExtent()))
  {
    const int* has = image->GetExtent();
    throw std::runtime_error("the image came without some of the pixels asked for: columns " +
      std::to_string(has[0]) + " to " + std::to_string(has[1]) + " of " + std::to_string(block[0]) +
      " to " + std::to_string(block[1]) + ", rows " + std::to_string(has[2]) + " to " +
      std::to_string(has[3]) + " of " + std::to_string(block[2]) + " to " +
      std::to_string(block[3]));
  }
  if (auto* labelImage = vtkImageData::GetData(inputs[1]))
  {
    const auto labels = msi::partOf(labelImage, block);
    sampling.add(this, image, array, msi::mapFromLabels(labels, image));
    return;
  }
  auto& statistics = sampling.prepare(image, array, static_cast<int>(sampling.places.size()));
  // Places may share pixels.
  for (std::size_t i = 0; i < sampling.places.size(); ++i)
  {
    const auto& place = sampling.places[i];
    msi::Extent part = block;
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      part[2 * axis] = std::max(part[2 * axis], place.first[axis]);
      part[2 * axis + 1] = std::min(part[2 * axis + 1], place.last[axis]);
    }
    if (part[0] > part[1] || part[2] > part[3])
    {
      continue;
    }
    const auto pixels = msi::partOf(image, part);
    const int label = static_cast<int>(i) + 1;
    msi::addPixels(this, pixels,
      msi::requireSpectralArray(pixels, "the image", this->SpectralArray.c_str()),
      { label, [label](vtkIdType, double, double) { return label; } }, statistics);
  }
}

void vtkSpectralProfile::WriteTable(vtkInformation* outInfo, bool labelled)
{
  auto& sampling = *this->Current;
  const auto& statistics = sampling.gather("labels");
  // A piece of the table: the first rank of many has all rows.
  if (outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) == 0)
  {
    auto* table = vtkTable::GetData(outInfo);
    const auto& axis = sampling.axis;
    const auto channels = statistics.channels();
    Eigen::VectorXd rows = Eigen::VectorXd::LinSpaced(channels, 1.0, channels);
    if (axis.wavelengths)
    {
      const auto& nm = axis.wavelengths->values();
      rows = Eigen::Map<const Eigen::VectorXd>(nm.data(), channels);
    }
    msi::setNumbers(table, axis.wavelengths ? "wavelength" : "channel", rows);
    const bool isRegion = this->PlacesOfPoints().empty();
    vtkNew<vtkStringArray> names;
    vtkNew<vtkIdTypeArray> counts;
    names->SetName("Profile");
    counts->SetName("Count");
    for (int label = 1; label <= statistics.patches(); ++label)
    {
      if (labelled && statistics.count(label) + statistics.leftOut(label) == 0)
      {
        continue;
      }
      const std::string number = std::to_string(label);
      const std::string name = labelled ? "label " + number
        : isRegion                      ? "region"
                                        : "point " + number;
      const Eigen::VectorXd mean = statistics.mean(label);
      msi::setNumbers(table, name, mean);
      if (labelled || isRegion)
      {
        const Eigen::VectorXd deviation = statistics.standardDeviation(label);
        msi::setNumbers(table, name + " deviation", deviation);
        msi::setNumbers(table, name + " -s", mean - deviation);
        msi::setNumbers(table, name + " +s", mean + deviation);
      }
      names->InsertNextValue(name);
      counts->InsertNextValue(statistics.count(label));
    }
    table->GetFieldData()->AddArray(names);
    table->GetFieldData()->AddArray(counts);
  }
  sampling.restart();
}
