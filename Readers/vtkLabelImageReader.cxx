#include "vtkLabelImageReader.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include "Formats/FileKind.h"
#include "Formats/LabelImage.h"
#include "Formats/Storage/AvailableMemory.h"

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
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Stride: " << this->Stride[0] << ", " << this->Stride[1] << "\n";
}

// Where the last row lies that is read.
double vtkLabelImageReader::Bottom() const
{
  return this->File->wholeHeight() - 1.0 - (this->File->height() - 1.0) * this->Stride[1];
}

void vtkLabelImageReader::Open()
{
  if (this->File && this->OpenTime == this->GetMTime())
  {
    return;
  }
  this->File.reset();
  if (this->FileName.empty())
  {
    throw std::invalid_argument("no file is given; choose a label image as File Name");
  }
  this->File =
    std::make_unique<msi::LabelImageFile>(this->FileName, this->Stride[0], this->Stride[1]);
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
      const int extent[] = { 0, this->File->width() - 1, 0, this->File->height() - 1, 0, 0 };
      const double spacing[] = { static_cast<double>(this->Stride[0]),
        static_cast<double>(this->Stride[1]), 1.0 };
      const double origin[] = { 0.0, this->Bottom(), 0.0 };
      out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
      out->Set(vtkDataObject::SPACING(), spacing, 3);
      out->Set(vtkDataObject::ORIGIN(), origin, 3);
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
      output->SetSpacing(this->Stride[0], this->Stride[1], 1.0);
      output->SetOrigin(0.0, this->Bottom(), 0.0);
      vtkNew<vtkIntArray> labels;
      labels->SetName(msi::LabelArray);
      msi::requireMemory(static_cast<double>(output->GetNumberOfPoints()) * sizeof(int),
        this->FileName + ": the label image", "read less of it: set Stride of the reader");
      labels->SetNumberOfTuples(output->GetNumberOfPoints());
      // VTK counts rows from the bottom, files from the top.
      const int height = this->File->height();
      const std::ptrdiff_t width = extent[1] - extent[0] + 1;
      this->File->read({ extent[0], extent[1] + 1, height - 1 - extent[3], height - extent[2] },
        labels->GetPointer((extent[3] - extent[2]) * width), -width);
      output->GetPointData()->SetScalars(labels);
    });
}

int vtkLabelImageReader::CanReadFile(const char* name)
{
  return name && msi::fileKind(name) == msi::FileKind::LabelImage ? 1 : 0;
}
