#include "vtkPatchReferenceImage.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkPatchReferenceImage);

namespace
{
// The row of the table for each label.
std::map<double, Eigen::Index> rowsByLabel(vtkTable* table)
{
  auto* column = vtkDataArray::SafeDownCast(table->GetColumnByName("label"));
  if (!column)
  {
    throw std::invalid_argument(
      "the patch table has no column of numbers 'label'; expected the patch "
      "number of each row");
  }
  std::map<double, Eigen::Index> rows;
  for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
  {
    const double label = column->GetComponent(row, 0);
    if (!(label >= 1.0 && label == std::floor(label)))
    {
      throw std::invalid_argument("row " + std::to_string(row + 1) +
        " of the patch table has the label " + std::to_string(label) +
        "; expected a whole number from 1 on");
    }
    if (!rows.emplace(label, row).second)
    {
      throw std::invalid_argument("rows " + std::to_string(rows[label] + 1) + " and " +
        std::to_string(row + 1) + " of the patch table have the same label");
    }
  }
  return rows;
}
}

vtkPatchReferenceImage::vtkPatchReferenceImage()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

void vtkPatchReferenceImage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
}

int vtkPatchReferenceImage::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkTable");
  return 1;
}

int vtkPatchReferenceImage::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  msi::requestWhole(inputs, 1);
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkPatchReferenceImage::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* labelImage = vtkImageData::GetData(inputs[0]);
      auto* table = vtkTable::GetData(inputs[1]);
      auto* labels = msi::requireSpectralArray(labelImage, "the label image");
      msi::requireOneLabelPerPixel(labels, "the label image");
      const auto measured =
        msi::requireSpectra(table, msi::SampleQuantity::Reflectance, "the patch table");
      const auto rows = rowsByLabel(table);
      const auto bands = measured.values.rows();
      const Eigen::MatrixXf spectra = measured.values.cast<float>();

      auto* output = vtkImageData::GetData(outputs, 0);
      output->CopyStructure(labelImage);
      vtkNew<vtkFloatArray> reflectance;
      reflectance->SetName(msi::ReflectanceArray);
      reflectance->SetNumberOfComponents(static_cast<int>(bands));
      reflectance->SetNumberOfTuples(labels->GetNumberOfTuples());
      float* out = reflectance->GetPointer(0);
      msi::forBlocks(this, labels->GetNumberOfTuples(),
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType point = begin; point < end; ++point)
          {
            const auto row = rows.find(labels->GetComponent(point, 0));
            if (row == rows.end())
            {
              std::fill_n(out + point * bands, bands, std::numeric_limits<float>::quiet_NaN());
            }
            else
            {
              std::copy_n(spectra.col(row->second).data(), bands, out + point * bands);
            }
          }
        });
      msi::setAxis(output, reflectance, measured.axis);
      output->GetPointData()->SetScalars(reflectance);
      if (this->Preview)
      {
        msi::setPicture(this, output, reflectance);
      }
    });
}
