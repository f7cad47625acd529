// A source that gives exactly the extent asked for, as a reader of large files does.
#pragma once

#include "vtkImageAlgorithm.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace msi::testing
{

class PieceSource : public vtkImageAlgorithm
{
public:
  static PieceSource* New() { VTK_STANDARD_NEW_BODY(PieceSource); }
  vtkTypeMacro(PieceSource, vtkImageAlgorithm);

  void SetImage(vtkImageData* image)
  {
    this->Image = image;
    this->Modified();
  }
  // The largest number of points that was asked for at once.
  vtkIdType LargestRequest() const { return this->Largest; }

protected:
  PieceSource() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    auto* out = outputs->GetInformationObject(0);
    auto* scalars = this->Image->GetPointData()->GetScalars();
    out->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), this->Image->GetExtent(), 6);
    out->Set(vtkDataObject::SPACING(), this->Image->GetSpacing(), 3);
    out->Set(vtkDataObject::ORIGIN(), this->Image->GetOrigin(), 3);
    out->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
    vtkDataObject::SetPointDataActiveScalarInfo(
      out, scalars->GetDataType(), scalars->GetNumberOfComponents());
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    auto* output = vtkImageData::GetData(outputs, 0);
    int extent[6];
    outputs->GetInformationObject(0)->Get(
      vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent);
    output->ShallowCopy(this->Image);
    output->Crop(extent);
    this->Largest = std::max(this->Largest, output->GetNumberOfPoints());
    return 1;
  }

private:
  vtkSmartPointer<vtkImageData> Image;
  vtkIdType Largest = 0;
};

} // namespace msi::testing
