#include "vtkCIEDE2000Evaluator.h"

#include "AlgorithmSupport.h"
#include "ErrorMetrics.h"
#include "ErrorStatisticsReduction.h"
#include "ErrorSummaryTable.h"
#include "ImageBlocks.h"
#include "ImagePicture.h"
#include "ImagePieces.h"
#include "NameList.h"
#include "SampleColumns.h"
#include "SpectralImage.h"
#include "TransformTable.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkCIEDE2000Evaluator);

namespace
{
using ErrorArrays = std::vector<vtkSmartPointer<vtkFloatArray>>;

ErrorArrays newErrorArrays(const std::vector<msi::ErrorName>& names, vtkIdType pixels)
{
  ErrorArrays arrays;
  for (const auto& name : names)
  {
    arrays.push_back(vtkSmartPointer<vtkFloatArray>::New());
    arrays.back()->SetName(name.text().c_str());
    arrays.back()->SetNumberOfTuples(pixels);
  }
  return arrays;
}

void evaluateImage(vtkAlgorithm* self, const msi::ErrorMetrics& metrics,
  vtkDataArray* estimateArray, vtkDataArray* referenceArray, const ErrorArrays& errors)
{
  const auto estimate = msi::asFloats(estimateArray);
  const auto reference = msi::asFloats(referenceArray);
  const vtkIdType inputs = estimate->GetNumberOfComponents();
  const vtkIdType bands = reference->GetNumberOfComponents();
  const float* spectra[] = { estimate->GetPointer(0), reference->GetPointer(0) };
  msi::forBlocks(self, estimate->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float*> out;
      for (const auto& array : errors)
      {
        out.push_back(array->GetPointer(begin));
      }
      metrics.apply(spectra[0] + begin * inputs, spectra[1] + begin * bands, end - begin, out);
    });
}

// The errors of the pixels within 'owned': what this piece has to say about the whole.
vtkSmartPointer<vtkFloatArray> ownedValues(
  vtkImageData* image, vtkFloatArray* values, const msi::Extent& owned)
{
  const int* held = image->GetExtent();
  if (std::equal(owned.begin(), owned.end(), held))
  {
    return values;
  }
  auto mine = vtkSmartPointer<vtkFloatArray>::New();
  for (int z = owned[4]; z <= owned[5]; ++z)
  {
    for (int y = owned[2]; y <= owned[3]; ++y)
    {
      for (int x = owned[0]; x <= owned[1]; ++x)
      {
        int place[] = { x, y, z };
        mine->InsertNextValue(values->GetValue(image->ComputePointId(place)));
      }
    }
  }
  return mine;
}
}

vtkCIEDE2000Evaluator::vtkCIEDE2000Evaluator()
{
  this->SetNumberOfInputPorts(6);
  this->SetNumberOfOutputPorts(2);
}

void vtkCIEDE2000Evaluator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Metrics: " << this->Metrics << "\n"
     << indent << "Illuminants: " << this->Illuminants << "\n"
     << indent << "OtherIlluminants: " << this->OtherIlluminants << "\n"
     << indent << "IlluminantFile: " << this->IlluminantFile << "\n"
     << indent << "ObserverFile: " << this->ObserverFile << "\n"
     << indent << "Observer: " << this->Observer << "\n"
     << indent << "EstimateArray: " << this->EstimateArray << "\n"
     << indent << "ReferenceArray: " << this->ReferenceArray << "\n"
     << indent << "SpectralRms: " << this->SpectralRms << "\n"
     << indent << "KL: " << this->KL << "\n"
     << indent << "KC: " << this->KC << "\n"
     << indent << "KH: " << this->KH << "\n";
}

void vtkCIEDE2000Evaluator::AddMetric(const char* name)
{
  this->SetMetrics(msi::withNames(this->Metrics, name).c_str());
}

void vtkCIEDE2000Evaluator::ClearMetrics()
{
  this->SetMetrics("");
}

void vtkCIEDE2000Evaluator::AddIlluminant(const char* name)
{
  this->SetIlluminants(msi::withNames(this->Illuminants, name).c_str());
}

void vtkCIEDE2000Evaluator::ClearIlluminants()
{
  this->SetIlluminants("");
}

int vtkCIEDE2000Evaluator::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  if (port < 2)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  }
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkCIEDE2000Evaluator::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkCIEDE2000Evaluator::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      msi::requireSameSize(inputs[0]->GetInformationObject(0), "the estimate",
        inputs[1]->GetInformationObject(0), "the reference", "both must show the same region");
    });
}

int vtkCIEDE2000Evaluator::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* input = vtkDataObject::GetData(inputs[0]);
  if (!input)
  {
    return 0;
  }
  auto* errors = vtkDataObject::GetData(outputs, 0);
  if (!errors || !errors->IsA(input->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    fresh.TakeReference(input->NewInstance());
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
  if (!vtkTable::GetData(outputs, 1))
  {
    vtkNew<vtkTable> summary;
    outputs->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), summary);
  }
  return 1;
}

int vtkCIEDE2000Evaluator::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Tables are needed whole; images piece by piece.
  for (int port = 0; port < 6; ++port)
  {
    if (vtkTable::GetData(inputs[port]))
    {
      msi::requestWhole(inputs, port);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkCIEDE2000Evaluator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const msi::ViewingConditions conditions(vtkTable::GetData(inputs[2]),
        vtkTable::GetData(inputs[3]), this->Observer, { this->IlluminantFile, this->ObserverFile });
      msi::AskedErrors asked;
      asked.metrics = msi::namesIn(this->Metrics);
      asked.illuminants = conditions.withFile(
        msi::namesIn(msi::withNames(this->Illuminants, this->OtherIlluminants)));
      asked.factors = { this->KL, this->KC, this->KH };
      asked.rms = this->SpectralRms;
      const auto names = asked.names();
      std::optional<msi::EstimationModel> model;
      if (auto* transform = vtkTable::GetData(inputs[4]))
      {
        model = msi::readEstimator(transform, vtkTable::GetData(inputs[5]));
      }
      const auto metricsOf = [&](const msi::SpectralAxis& bands)
      { return msi::ErrorMetrics(bands, asked, conditions, model ? model->estimator : nullptr); };
      const auto requireBands = [&](
                                  const msi::SpectralAxis& own, const msi::SpectralAxis& reference)
      {
        if (model)
        {
          msi::requireSameChannels(
            own, "the first input", model->channels, "the reflectance transform");
        }
        msi::requireSameBands(
          model ? model->bands : own, "the estimate", reference, "the reference");
      };
      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        auto* second = vtkTable::GetData(inputs[1]);
        if (!second && vtkDataObject::GetData(inputs[1]))
        {
          throw std::invalid_argument("the estimate is a table of samples, but the reference is an "
                                      "image; give a table of the same samples, or none where the "
                                      "estimate's table holds the measured reflectance");
        }
        const auto estimate = msi::requireSpectra(table,
          model ? msi::SampleQuantity::Response : msi::SampleQuantity::Estimate, "the estimate");
        const auto reference = msi::requireSpectra(second ? second : table,
          msi::SampleQuantity::Reflectance, second ? "the reference" : "the estimate's own table");
        requireBands(estimate.axis, reference.axis);
        if (estimate.values.cols() != reference.values.cols())
        {
          throw std::invalid_argument("the estimate has " + std::to_string(estimate.values.cols()) +
            " samples, but the reference has " + std::to_string(reference.values.cols()) +
            "; both must list the same samples in the same order");
        }
        auto* output = vtkTable::GetData(outputs, 0);
        output->ShallowCopy(table);
        const msi::ErrorMetrics metrics = metricsOf(reference.axis);
        msi::ErrorSummaryTable summary(vtkTable::GetData(outputs, 1));
        const auto errors = metrics(estimate.values, reference.values);
        for (std::size_t i = 0; i < errors.size(); ++i)
        {
          msi::setNumbers(output, names[i].text(), errors[i]);
          summary.add(names[i], msi::summarize(errors[i]));
        }
        return;
      }
      vtkSmartPointer<vtkImageData> image = vtkImageData::GetData(inputs[0]);
      vtkSmartPointer<vtkImageData> referenceImage = vtkImageData::GetData(inputs[1]);
      if (!image || !referenceImage)
      {
        throw std::invalid_argument(
          "an estimated image needs a reference image of the same region as "
          "second input (see Patch Reference Image)");
      }
      const auto common = msi::commonExtent({ image, referenceImage });
      image = msi::partOf(image, common);
      referenceImage = msi::partOf(referenceImage, common);
      auto* controller = msi::controllerOfPieces(inputs[0]);
      auto* output = vtkImageData::GetData(outputs, 0);
      const auto errors = newErrorArrays(names, image->GetNumberOfPoints());
      msi::beforeRanksMeet(controller,
        [&]
        {
          if (controller && image->GetNumberOfPoints() == 0)
          {
            return; // more ranks than pixels
          }
          auto* estimate = (model ? msi::requireSpectralArray : msi::requireReflectanceArray)(
            image, "the estimate", this->EstimateArray.c_str());
          auto* reference = msi::requireReflectanceArray(
            referenceImage, "the reference", this->ReferenceArray.c_str());
          const auto bands = msi::axisOf(referenceImage, reference);
          requireBands(msi::axisOf(image, estimate), bands);
          if (estimate->GetNumberOfTuples() != reference->GetNumberOfTuples())
          {
            throw std::invalid_argument("the reference shows another region than the estimate");
          }
          evaluateImage(this, metricsOf(bands), estimate, reference, errors);
        });
      output->ShallowCopy(image);
      msi::removePicture(output);
      for (const auto& array : errors)
      {
        output->GetPointData()->AddArray(array);
      }
      output->GetPointData()->SetActiveScalars(errors.back()->GetName());

      vtkNew<vtkTable> whole;
      msi::ErrorSummaryTable summary(whole);
      const auto owned = msi::ownedExtent(inputs[0]->GetInformationObject(0), image);
      for (std::size_t i = 0; i < errors.size(); ++i)
      {
        summary.add(names[i], msi::summarize(ownedValues(output, errors[i], owned), controller));
      }
      if (!controller || controller->GetLocalProcessId() == 0)
      {
        vtkTable::GetData(outputs, 1)->ShallowCopy(whole);
      }
    });
}
