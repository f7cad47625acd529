#include "vtkLabelImageReader.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include "Formats/LabelImage.h"

#include <algorithm>
#include <stdexcept>

vtkStandardNewMacro(vtkLabelImageReader);

vtkLabelImageReader::vtkLabelImageReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

vtkLabelImageReader::~vtkLabelImageReader() = default;

void vtkLabelImageReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}

void vtkLabelImageReader::Open()
{
  if (this->Image && this->OpenTime == this->GetMTime())
  {
    return;
  }
  this->Image.reset();
  if (this->FileName.empty())
  {
    throw std::invalid_argument("no file is given; set FileName to a label image");
  }
  this->Image = std::make_unique<msi::LabelImage>(msi::readLabelImage(this->FileName));
  this->OpenTime = this->GetMTime();
}

int vtkLabelImageReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->Open();
      auto* out = outputs->GetInformationObject(0);
      const int extent[] = { 0, this->Image->width - 1, 0, this->Image->height - 1, 0, 0 };
      const double unit[] = { 1.0, 1.0, 1.0 };
      const double zero[] = { 0.0, 0.0, 0.0 };
      out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
      out->Set(vtkDataObject::SPACING(), unit, 3);
      out->Set(vtkDataObject::ORIGIN(), zero, 3);
      out->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      out->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
      vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_INT, 1);
    });
}

int vtkLabelImageReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      this->Open();
      auto* output = vtkImageData::GetData(outputs, 0);
      int extent[6];
      outputs->GetInformationObject(0)->Get(
        vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
      output->SetExtent(extent);
      output->SetSpacing(1.0, 1.0, 1.0);
      output->SetOrigin(0.0, 0.0, 0.0);
      vtkNew<vtkIntArray> labels;
      labels->SetName(msi::LabelArray);
      labels->SetNumberOfTuples(output->GetNumberOfPoints());
      int* next = labels->GetPointer(0);
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        const auto row =
          static_cast<std::ptrdiff_t>(this->Image->height - 1 - y) * this->Image->width;
        const auto* first = this->Image->labels.data() + row;
        next = std::copy(first + extent[0], first + extent[1] + 1, next);
      }
      output->GetPointData()->SetScalars(labels);
    });
}
