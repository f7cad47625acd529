#include "vtkChartFinder.h"

#include "AlgorithmSupport.h"
#include "ChartOverlay.h"
#include "ImagePicture.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include "Kernels/Sampling/ChartLayout.h"
#include "Kernels/Sampling/ChartSearch.h"
#include "Kernels/Sampling/PatchQuality.h"
#include "Kernels/Spectra/Interpolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

vtkStandardNewMacro(vtkChartFinder);

namespace
{
constexpr const char* ChartLabelColumn = "label";
constexpr int MostChartPatches = 65535; // of labels in a file of 16 bits
// From these shares on a patch is marked.
constexpr double Clipped = 0.01;
constexpr double Uneven = 0.02;
constexpr double Sloped = 0.1;

// Of each row of the reference.
std::vector<int> labelsOf(vtkTable* reference, int columns, int rows)
{
  std::vector<int> labels;
  if (auto* column = vtkDataArray::SafeDownCast(reference->GetColumnByName(ChartLabelColumn)))
  {
    std::set<int> seen;
    for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
    {
      const double label = column->GetComponent(row, 0);
      if (!(label >= 1.0 && label <= static_cast<double>(columns) * rows) ||
        label != std::floor(label) || !seen.insert(static_cast<int>(label)).second)
      {
        throw std::invalid_argument("row " + std::to_string(row + 1) +
          " of the reference has a label that stands twice or is not within 1 to " +
          std::to_string(columns * rows) + ", the patches of the chart");
      }
      labels.push_back(static_cast<int>(label));
    }
    return labels;
  }
  std::vector<std::string> names(static_cast<std::size_t>(reference->GetNumberOfRows()));
  if (auto* column = reference->GetColumnByName("sample"))
  {
    for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
    {
      names[static_cast<std::size_t>(row)] = column->GetVariantValue(row).ToString();
    }
  }
  return msi::patchNumbers(names, columns, rows);
}

// Reflectance at the channels' wavelengths, else its mean over the bands; NaN for patches that are not listed.
Eigen::MatrixXd expectedResponses(vtkTable* reference, const std::vector<int>& labels,
  const msi::SpectralAxis& channels, int patches)
{
  const auto measured =
    msi::requireSpectra(reference, msi::SampleQuantity::Reflectance, "the reference");
  const auto count = static_cast<Eigen::Index>(channels.size());
  const auto bands = measured.values.rows();
  const Eigen::MatrixXd operation = channels.wavelengths
    ? msi::resamplingMatrix(
        *measured.axis.wavelengths, *channels.wavelengths, msi::InterpolationMethod::Linear)
    : Eigen::MatrixXd(Eigen::MatrixXd::Constant(count, bands, 1.0 / static_cast<double>(bands)));
  const Eigen::MatrixXd seen = operation * measured.values;
  Eigen::MatrixXd expected =
    Eigen::MatrixXd::Constant(count, patches, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    expected.col(labels[i] - 1) = seen.col(static_cast<Eigen::Index>(i));
  }
  return expected;
}

// VTK counts rows from the bottom, charts are searched from the top.
Eigen::MatrixXf fromTheTop(vtkFloatArray* array, int width, int height)
{
  const auto channels = array->GetNumberOfComponents();
  const Eigen::Map<const Eigen::MatrixXf> pixels(
    array->GetPointer(0), channels, array->GetNumberOfTuples());
  Eigen::MatrixXf turned(channels, pixels.cols());
  for (int y = 0; y < height; ++y)
  {
    turned.middleCols(static_cast<Eigen::Index>(y) * width, width) =
      pixels.middleCols(static_cast<Eigen::Index>(height - 1 - y) * width, width);
  }
  return turned;
}

Eigen::VectorXf clippingLevels(const Eigen::Map<const Eigen::MatrixXf>& pixels, double saturation)
{
  constexpr double Share = 0.001;
  Eigen::VectorXf levels =
    Eigen::VectorXf::Constant(pixels.rows(), std::numeric_limits<float>::infinity());
  for (Eigen::Index k = 0; k < pixels.rows(); ++k)
  {
    if (saturation > 0.0)
    {
      levels[k] = static_cast<float>(saturation);
      continue;
    }
    float largest = -std::numeric_limits<float>::infinity();
    for (Eigen::Index i = 0; i < pixels.cols(); ++i)
    {
      largest = std::isfinite(pixels(k, i)) ? std::max(largest, pixels(k, i)) : largest;
    }
    const auto count = static_cast<double>((pixels.row(k).array() == largest).count());
    if (largest > 0.0F && count > std::max(1.0, Share * static_cast<double>(pixels.cols())))
    {
      levels[k] = largest;
    }
  }
  return levels;
}

std::vector<msi::PatchQuality> qualities(
  vtkImageData* image, vtkFloatArray* array, const msi::PatchGrid& grid, double saturation)
{
  const Eigen::Map<const Eigen::MatrixXf> pixels(
    array->GetPointer(0), array->GetNumberOfComponents(), array->GetNumberOfTuples());
  const Eigen::VectorXf clipping = clippingLevels(pixels, saturation);
  std::vector<std::vector<vtkIdType>> members(static_cast<std::size_t>(grid.patches()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    double place[3];
    image->GetPoint(i, place);
    const int label = grid.labelAt(place[0], place[1]);
    if (label > 0)
    {
      members[static_cast<std::size_t>(label - 1)].push_back(i);
    }
  }
  std::vector<msi::PatchQuality> result;
  for (std::size_t patch = 0; patch < members.size(); ++patch)
  {
    const auto& points = members[patch];
    if (points.empty())
    {
      throw std::invalid_argument("patch " + std::to_string(patch + 1) +
        " has no pixel; the corners do not enclose the chart, or the image is too small for " +
        std::to_string(grid.patches()) + " patches");
    }
    const auto count = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXf values(pixels.rows(), count);
    Eigen::Matrix2Xd places(2, count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const vtkIdType point = points[static_cast<std::size_t>(i)];
      double place[3];
      image->GetPoint(point, place);
      values.col(i) = pixels.col(point);
      places.col(i) << place[0], place[1];
    }
    result.push_back(msi::patchQuality(values, places, clipping));
  }
  return result;
}

std::string noteOf(const msi::PatchQuality& quality)
{
  std::string note;
  const auto add = [&note](bool applies, const char* text)
  { note += applies ? (note.empty() ? "" : ", ") + std::string(text) : ""; };
  add(quality.clipped >= Clipped, "clipped");
  add(quality.outliers >= Uneven, "spots");
  add(quality.slope >= Sloped, "uneven");
  return note;
}

std::vector<msi::OutlineColor> outlineColors(const std::vector<msi::PatchQuality>& qualities)
{
  std::vector<msi::OutlineColor> colors;
  for (const auto& quality : qualities)
  {
    const bool spotted = quality.outliers >= Uneven || quality.slope >= Sloped;
    colors.push_back(quality.clipped >= Clipped ? msi::OutlineColor{ 230, 20, 20 }
        : spotted                               ? msi::OutlineColor{ 255, 140, 0 }
                                                : msi::OutlineColor{ 0, 220, 60 });
  }
  return colors;
}

void writePatches(vtkTable* reference, std::vector<int> labels,
  const std::vector<msi::PatchQuality>& qualities, vtkTable* output)
{
  if (reference)
  {
    output->ShallowCopy(reference);
  }
  else
  {
    labels.resize(qualities.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      labels[i] = static_cast<int>(i) + 1;
    }
  }
  const auto rows = static_cast<Eigen::Index>(labels.size());
  vtkNew<vtkIntArray> column;
  column->SetName(ChartLabelColumn);
  vtkNew<vtkStringArray> notes;
  notes->SetName("note");
  Eigen::MatrixX3d shares(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i)
  {
    const int label = labels[static_cast<std::size_t>(i)];
    const auto& quality = qualities[static_cast<std::size_t>(label - 1)];
    column->InsertNextValue(label);
    notes->InsertNextValue(noteOf(quality));
    shares.row(i) << quality.clipped, quality.outliers, quality.slope;
  }
  output->RemoveColumnByName(ChartLabelColumn);
  output->AddColumn(column);
  const char* names[] = { "clipped", "outliers", "slope" };
  for (int i = 0; i < 3; ++i)
  {
    msi::setNumbers(output, names[i], shares.col(i));
  }
  output->AddColumn(notes);
}

void writePlacement(const msi::ChartPlacement& placement, vtkTable* output)
{
  const auto add = [output](const std::string& name, double value)
  { msi::setNumbers(output, name, Eigen::VectorXd::Constant(1, value)); };
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::string corner = "corner " + std::to_string(i + 1);
    add(corner + " x", placement.corners[i].x());
    add(corner + " y", placement.corners[i].y());
  }
  add("patches seen", placement.seen);
  add("residual", placement.residual);
  add("agreement", placement.agreement);
  add("second agreement", placement.secondAgreement);
}

// All zero: the whole image, first patch at the top left.
msi::PatchGrid::Corners givenCorners(vtkChartFinder* self, vtkImageData* image)
{
  const double* corners[] = { self->GetCorner1(), self->GetCorner2(), self->GetCorner3(),
    self->GetCorner4() };
  msi::PatchGrid::Corners points;
  bool given = false;
  for (std::size_t i = 0; i < 4; ++i)
  {
    points[i] = { corners[i][0], corners[i][1] };
    given = given || !points[i].isZero();
  }
  if (!given)
  {
    const double* b = image->GetBounds();
    const double dx = 0.5 * image->GetSpacing()[0];
    const double dy = 0.5 * image->GetSpacing()[1];
    points = { { { b[0] - dx, b[3] + dy }, { b[1] + dx, b[3] + dy }, { b[1] + dx, b[2] - dy },
      { b[0] - dx, b[2] - dy } } };
  }
  return points;
}

// Of the pixels of `extent`.
vtkSmartPointer<vtkUnsignedCharArray> pictureOf(
  vtkAlgorithm* self, vtkImageData* image, vtkFloatArray* spectra, const int* extent)
{
  vtkNew<vtkImageData> part;
  part->ShallowCopy(image);
  if (!msi::findPicture(part))
  {
    msi::setPicture(self, part, spectra);
  }
  part->Crop(extent);
  return msi::findPicture(part);
}
}

vtkChartFinder::vtkChartFinder()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

void vtkChartFinder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Placement: " << this->Placement << "\n"
     << indent << "GridColumns: " << this->GridColumns << "\n"
     << indent << "GridRows: " << this->GridRows << "\n"
     << indent << "PatchFraction: " << this->PatchFraction << "\n"
     << indent << "SaturationLevel: " << this->SaturationLevel << "\n";
  const double* corners[] = { this->Corner1, this->Corner2, this->Corner3, this->Corner4 };
  for (int i = 0; i < 4; ++i)
  {
    os << indent << "Corner" << i + 1 << ": " << corners[i][0] << ", " << corners[i][1] << "\n";
  }
}

int vtkChartFinder::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkTable");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkChartFinder::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

int vtkChartFinder::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  auto* image = inputs[0]->GetInformationObject(0);
  int whole[6];
  image->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  image->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), whole, 6);
  msi::requestWhole(inputs, 0);
  msi::requestWhole(inputs, 1);
  return 1;
}

int vtkChartFinder::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* image = vtkImageData::GetData(inputs[0]);
      auto* reference = vtkTable::GetData(inputs[1]);
      auto* array = msi::requireSpectralArray(image, "the image");
      const auto axis = msi::axisOf(image, array);
      const auto spectra = msi::asFloats(array);
      const int patches = this->GridColumns * this->GridRows;
      if (patches > MostChartPatches)
      {
        throw std::invalid_argument("a chart of " + std::to_string(patches) +
          " patches; expected at most " + std::to_string(MostChartPatches));
      }
      int whole[6];
      image->GetExtent(whole);
      const int width = whole[1] - whole[0] + 1;
      const int height = whole[3] - whole[2] + 1;

      std::vector<int> labels;
      msi::ChartSearchOptions options;
      options.columns = this->GridColumns;
      options.rows = this->GridRows;
      if (reference)
      {
        labels = labelsOf(reference, this->GridColumns, this->GridRows);
        options.expected = expectedResponses(reference, labels, axis, patches);
      }

      const double* origin = image->GetOrigin();
      const double* spacing = image->GetSpacing();
      msi::ChartPlacement placement;
      if (this->Placement == AUTOMATIC)
      {
        placement = msi::findChart(
          msi::makeChartImage(fromTheTop(spectra, width, height), width, height), options);
        for (auto& corner : placement.corners)
        {
          corner = { origin[0] + spacing[0] * (whole[0] + corner.x()),
            origin[1] + spacing[1] * (whole[3] - corner.y()) };
        }
      }
      else
      {
        placement.corners = givenCorners(this, image);
        placement.seen = patches;
        placement.agreement = placement.secondAgreement = std::numeric_limits<double>::quiet_NaN();
      }
      const msi::PatchGrid grid(
        this->GridColumns, this->GridRows, placement.corners, this->PatchFraction);
      const auto quality = qualities(image, spectra, grid, this->SaturationLevel);

      auto* output = vtkImageData::GetData(outputs, 0);
      int extent[6];
      outputs->GetInformationObject(0)->Get(
        vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
      output->SetOrigin(image->GetOrigin());
      output->SetSpacing(image->GetSpacing());
      output->SetExtent(extent);
      const auto picture = pictureOf(this, image, spectra, extent);
      constexpr double LinesAcross = 400.0; // pixels of the longer side per width of a line
      const double line = std::max(1.0, std::max(width, height) / LinesAcross) * spacing[0];
      msi::drawChart(this, grid, outlineColors(quality), picture, line, output);
      writePatches(reference, labels, quality, vtkTable::GetData(outputs, 1));
      writePlacement(placement, vtkTable::GetData(outputs, 2));
    });
}
