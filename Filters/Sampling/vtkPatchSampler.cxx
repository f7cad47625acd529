#include "vtkPatchSampler.h"

#include "AlgorithmSupport.h"
#include "ImagePieces.h"
#include "PatchSampling.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include "Kernels/Sampling/PatchGrid.h"
#include "Kernels/Sampling/PatchStatistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>
#include <stdexcept>

vtkStandardNewMacro(vtkPatchSampler);

namespace
{
constexpr const char* LabelColumn = "label";

vtkDataArray* requireLabelColumn(vtkTable* table)
{
  auto* column = vtkDataArray::SafeDownCast(table->GetColumnByName(LabelColumn));
  if (!column)
  {
    throw std::invalid_argument(
      "the patch table has no column of numbers 'label'; expected the patch "
      "number of each row");
  }
  return column;
}

// The label of each output row.
std::vector<int> rowLabels(vtkTable* patchTable, const msi::PatchStatistics& statistics)
{
  std::vector<int> labels;
  if (!patchTable)
  {
    for (int label = 1; label <= statistics.patches(); ++label)
    {
      if (statistics.count(label) + statistics.leftOut(label) > 0)
      {
        labels.push_back(label);
      }
    }
    return labels;
  }
  auto* column = requireLabelColumn(patchTable);
  for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
  {
    const double label = column->GetComponent(row, 0);
    if (!(label >= 1.0 && label <= statistics.patches()) || label != std::floor(label) ||
      statistics.count(static_cast<int>(label)) == 0)
    {
      std::ostringstream text;
      text << label;
      throw std::invalid_argument("row " + std::to_string(row + 1) +
        " of the patch table asks for label " + text.str() +
        ", which has no finite pixel in the image; labels go from 1 to " +
        std::to_string(statistics.patches()));
    }
    labels.push_back(static_cast<int>(label));
  }
  return labels;
}

void writeRows(const msi::PatchStatistics& statistics, const msi::SpectralAxis& axis,
  msi::SampleQuantity quantity, vtkTable* patchTable, vtkTable* output)
{
  const auto labels = rowLabels(patchTable, statistics);
  const auto rows = static_cast<Eigen::Index>(labels.size());
  if (patchTable)
  {
    output->ShallowCopy(patchTable);
  }
  else
  {
    vtkNew<vtkIntArray> column;
    column->SetName(LabelColumn);
    for (const int label : labels)
    {
      column->InsertNextValue(label);
    }
    output->AddColumn(column);
  }
  Eigen::MatrixXd mean(statistics.channels(), rows);
  Eigen::MatrixXd deviation(statistics.channels(), rows);
  Eigen::MatrixXd place(4, rows);
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const int label = labels[static_cast<std::size_t>(row)];
    mean.col(row) = statistics.mean(label);
    deviation.col(row) = statistics.standardDeviation(label);
    place.col(row) << statistics.center(label), static_cast<double>(statistics.count(label)),
      static_cast<double>(statistics.leftOut(label));
  }
  const char* names[] = { "x", "y", "count", "left_out" };
  for (int i = 0; i < 4; ++i)
  {
    msi::setNumbers(output, names[i], place.row(i));
  }
  msi::setSpectra(output, quantity, axis, mean);
  for (std::size_t k = 0; k < axis.size(); ++k)
  {
    const std::string channel =
      axis.wavelengths ? static_cast<char>(quantity) + axis.names[k] : axis.names[k];
    msi::setNumbers(output, "deviation " + channel, deviation.row(static_cast<Eigen::Index>(k)));
  }
}
}

struct vtkPatchSampler::Sampling : msi::PatchSampling
{
  bool isReflectance = false;
};

vtkPatchSampler::vtkPatchSampler()
  : Current(std::make_unique<Sampling>())
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(1);
}

vtkPatchSampler::~vtkPatchSampler() = default;

void vtkPatchSampler::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "GridColumns: " << this->GridColumns << "\n"
     << indent << "GridRows: " << this->GridRows << "\n"
     << indent << "PatchFraction: " << this->PatchFraction << "\n"
     << indent << "BlockSize: " << this->BlockSize << "\n";
  const double* corners[] = { this->Corner1, this->Corner2, this->Corner3, this->Corner4 };
  for (int i = 0; i < 4; ++i)
  {
    os << indent << "Corner" << i + 1 << ": " << corners[i][0] << ", " << corners[i][1] << "\n";
  }
}

int vtkPatchSampler::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 2 ? "vtkTable" : "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkPatchSampler::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  msi::declareCollective(outputs);
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      msi::requireSameSize(inputs[1]->GetInformationObject(0), "the label image",
        inputs[0]->GetInformationObject(0), "the image", "expected one label per pixel");
    });
}

int vtkPatchSampler::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // Each rank samples its own rows of the image, whatever piece of the table is asked for: the sums are
  // reduced over all ranks.
  auto& blocks = this->Current->blocks;
  blocks.setBlockBytes(static_cast<long long>(this->BlockSize) << 20);
  if (blocks.request(inputs, { 0, 1 }))
  {
    this->Current->restart();
  }
  msi::requestWhole(inputs, 2);
  return 1;
}

int vtkPatchSampler::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->Current->takeBlock(this, request, [&] { this->AddBlock(inputs); }))
  {
    return 1;
  }
  auto* outInfo = outputs->GetInformationObject(0);
  const int done = msi::runAlgorithm(
    this, outputs, [&] { this->WriteTable(vtkTable::GetData(inputs[2]), outInfo); });
  const bool firstPiece =
    outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) == 0;
  if (done && firstPiece && !vtkImageData::GetData(inputs[1]) && !this->HasCorners())
  {
    vtkWarningMacro("neither labels nor corners are given, so the patches are a grid of "
      << this->GridColumns << " x " << this->GridRows
      << " over the whole image; choose Labels, or set Corner1 to Corner4 to the outer corners of "
         "the chart");
  }
  return done;
}

bool vtkPatchSampler::HasCorners() const
{
  const double* corners[] = { this->Corner1, this->Corner2, this->Corner3, this->Corner4 };
  return std::any_of(std::begin(corners), std::end(corners),
    [](const double* corner) { return corner[0] != 0.0 || corner[1] != 0.0; });
}

void vtkPatchSampler::AddBlock(vtkInformationVector** inputs)
{
  auto& sampling = *this->Current;
  if (sampling.blocks.isEmpty())
  {
    return; // more ranks than rows
  }
  const auto& block = sampling.blocks.block();
  const auto image = msi::partOf(vtkImageData::GetData(inputs[0]), block);
  const auto labels = msi::partOf(vtkImageData::GetData(inputs[1]), block);
  auto* array = msi::requireSpectralArray(image, "the image", this->SpectralArray.c_str());
  const auto map = labels ? msi::mapFromLabels(labels, image)
                          : msi::mapFromGrid(this->MakeGrid(inputs[0]->GetInformationObject(0)));
  sampling.isReflectance =
    array->GetName() && std::string(array->GetName()) == msi::ReflectanceArray;
  sampling.add(this, image, array, map);
}

void vtkPatchSampler::WriteTable(vtkTable* patchTable, vtkInformation* outInfo)
{
  auto& sampling = *this->Current;
  const auto& statistics = sampling.gather("patches");

  // A piece of the table: the first rank of many has all rows, a rank that asked for the whole too.
  if (outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) == 0)
  {
    const bool measured =
      patchTable && msi::findSpectra(patchTable, msi::SampleQuantity::Reflectance);
    const auto quantity = !sampling.isReflectance ? msi::SampleQuantity::Response
      : measured                                  ? msi::SampleQuantity::Estimate
                                                  : msi::SampleQuantity::Reflectance;
    writeRows(statistics, sampling.axis, quantity, patchTable, vtkTable::GetData(outInfo));
  }
  sampling.restart();
}

msi::PatchGrid vtkPatchSampler::MakeGrid(vtkInformation* imageInfo) const
{
  const double* corners[] = { this->Corner1, this->Corner2, this->Corner3, this->Corner4 };
  msi::PatchGrid::Corners points;
  for (std::size_t i = 0; i < 4; ++i)
  {
    points[i] = { corners[i][0], corners[i][1] };
  }
  if (!this->HasCorners())
  {
    int whole[6];
    double origin[3] = { 0.0, 0.0, 0.0 };
    double spacing[3] = { 1.0, 1.0, 1.0 };
    imageInfo->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
    if (imageInfo->Has(vtkDataObject::ORIGIN()))
    {
      imageInfo->Get(vtkDataObject::ORIGIN(), origin);
      imageInfo->Get(vtkDataObject::SPACING(), spacing);
    }
    const double left = origin[0] + spacing[0] * (whole[0] - 0.5);
    const double right = origin[0] + spacing[0] * (whole[1] + 0.5);
    const double bottom = origin[1] + spacing[1] * (whole[2] - 0.5);
    const double top = origin[1] + spacing[1] * (whole[3] + 0.5);
    points = { { { left, top }, { right, top }, { right, bottom }, { left, bottom } } };
  }
  return msi::PatchGrid(this->GridColumns, this->GridRows, points, this->PatchFraction);
}
