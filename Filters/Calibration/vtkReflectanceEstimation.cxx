#include "vtkReflectanceEstimation.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "ResponseRange.h"
#include "SampleColumns.h"
#include "SpectralImage.h"
#include "TransformTable.h"

#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

vtkStandardNewMacro(vtkReflectanceEstimation);

namespace
{
template <typename ArrayType>
vtkSmartPointer<ArrayType> newArray(const char* name, std::size_t components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(components));
  array->SetNumberOfTuples(tuples);
  return array;
}

// Null where a map is not asked for or not known.
struct QualityMapsOf
{
  std::optional<msi::ResponseRange> range;
  vtkSmartPointer<vtkFloatArray> outOfRange;
  vtkSmartPointer<vtkFloatArray> uncertainty;
};

template <typename Value>
void fillOutOfRange(const QualityMapsOf& maps, const Value* responses, vtkIdType channels,
  vtkIdType begin, vtkIdType end)
{
  for (vtkIdType pixel = begin; pixel < end; ++pixel)
  {
    const Eigen::Map<const Eigen::Array<Value, Eigen::Dynamic, 1>> values(
      responses + pixel * channels, channels);
    maps.outOfRange->SetValue(pixel,
      static_cast<float>(msi::excessOverRange(values.template cast<double>().eval(), *maps.range)));
  }
}

template <typename Value>
void fillUncertainty(const QualityMapsOf& maps, const Value* deviation, vtkIdType bands,
  vtkIdType begin, vtkIdType end)
{
  for (vtkIdType pixel = begin; pixel < end; ++pixel)
  {
    const Eigen::Map<const Eigen::Array<Value, Eigen::Dynamic, 1>> values(
      deviation + (pixel - begin) * bands, bands);
    maps.uncertainty->SetValue(pixel, static_cast<float>(std::sqrt(values.square().mean())));
  }
}

// When the table or one of its arrays changed last; 0 without a table.
vtkMTimeType newestOf(vtkTable* table)
{
  return table ? std::max({ table->GetMTime(), table->GetRowData()->GetMTime(),
                   table->GetFieldData()->GetMTime() })
               : 0;
}

template <typename ArrayType>
void estimateImage(vtkAlgorithm* self, const msi::EstimationModel& model, vtkDataArray* responses,
  bool withUncertainty, const QualityMapsOf& maps, vtkImageData* output)
{
  auto input = vtkSmartPointer<ArrayType>(ArrayType::FastDownCast(responses));
  if (!input)
  {
    input = newArray<ArrayType>("", model.channels.size(), 0);
    input->DeepCopy(responses);
  }
  const vtkIdType pixels = input->GetNumberOfTuples();
  auto reflectance = newArray<ArrayType>(msi::ReflectanceArray, model.bands.size(), pixels);
  vtkSmartPointer<ArrayType> uncertainty;
  if (withUncertainty)
  {
    uncertainty = newArray<ArrayType>(msi::UncertaintyArray, model.bands.size(), pixels);
  }
  const auto channels = static_cast<vtkIdType>(model.channels.size());
  const auto bands = static_cast<vtkIdType>(model.bands.size());
  const auto* in = input->GetPointer(0);
  auto* out = reflectance->GetPointer(0);
  auto* deviation = uncertainty ? uncertainty->GetPointer(0) : nullptr;
  // An estimator may prepare itself with its first call: once here, not in every thread.
  model.estimator->apply(in, out, nullptr, 0);
  msi::forBlocks(self, pixels,
    [&](vtkIdType begin, vtkIdType end)
    {
      using Value = std::decay_t<decltype(*out)>;
      std::vector<Value> buffer;
      Value* known = deviation ? deviation + begin * bands : nullptr;
      if (maps.uncertainty && !known)
      {
        buffer.resize(static_cast<std::size_t>((end - begin) * bands));
        known = buffer.data();
      }
      model.estimator->apply(in + begin * channels, out + begin * bands, known, end - begin);
      if (maps.outOfRange)
      {
        fillOutOfRange(maps, in, channels, begin, end);
      }
      if (maps.uncertainty)
      {
        fillUncertainty(maps, known, bands, begin, end);
      }
    });
  msi::setAxis(output, reflectance, model.bands);
  msi::replaceArray(output, responses, reflectance);
  if (uncertainty)
  {
    msi::setAxis(output, uncertainty, model.bands);
    output->GetPointData()->AddArray(uncertainty);
  }
  for (const auto& map : { maps.outOfRange, maps.uncertainty })
  {
    if (map)
    {
      output->GetPointData()->AddArray(map);
    }
  }
}
}

// The model of the last run. Where the tables are the same the next image, or the next piece of one, finds it as it is: the
// estimator may have prepared itself.
struct vtkReflectanceEstimation::KnownModel
{
  vtkTable* transform = nullptr; // to compare, not to use
  vtkTable* metamerism = nullptr;
  vtkMTimeType newest = 0; // of both and their columns
  msi::EstimationModel model;
};

vtkReflectanceEstimation::~vtkReflectanceEstimation() = default;

vtkReflectanceEstimation::vtkReflectanceEstimation()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(1);
}

void vtkReflectanceEstimation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
  os << indent << "ResponseArray: " << this->ResponseArray << "\n"
     << indent << "Uncertainty: " << this->Uncertainty << "\n"
     << indent << "QualityMaps: " << this->QualityMaps << "\n"
     << indent << "TrustResponses: " << this->TrustResponses << "\n"
     << indent << "OutOfRangeShare: " << this->OutOfRangeShare << "\n"
     << indent << "MissingShare: " << this->MissingShare << "\n";
}

int vtkReflectanceEstimation::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port == 0)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  }
  else if (port == 2)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkReflectanceEstimation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  msi::requestWhole(inputs, 1);
  msi::requestWhole(inputs, 2);
  return 1;
}

int vtkReflectanceEstimation::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->OutOfRangeShare = -1.0;
  this->MissingShare = -1.0;
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* transform = vtkTable::GetData(inputs[1]);
      auto* metamerism = vtkTable::GetData(inputs[2]);
      const vtkMTimeType newest = std::max(newestOf(transform), newestOf(metamerism));
      if (!this->Known || this->Known->transform != transform ||
        this->Known->metamerism != metamerism || this->Known->newest != newest)
      {
        this->Known = std::make_unique<KnownModel>(
          KnownModel{ transform, metamerism, newest, msi::readEstimator(transform, metamerism) });
      }
      const msi::EstimationModel& model = this->Known->model;
      const bool uncertainty = model.estimator->knowsUncertainty() && this->Uncertainty != 1;

      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        const auto responses =
          msi::requireSpectra(table, msi::SampleQuantity::Response, "the sample table");
        msi::requireSameChannels(
          responses.axis, "the sample table", model.channels, "the reflectance transform");
        msi::requirePossibleResponse(responses.values, "the sample table");
        Eigen::MatrixXd reflectance(model.bands.size(), responses.values.cols());
        Eigen::MatrixXd deviation(uncertainty ? reflectance.rows() : 0, reflectance.cols());
        model.estimator->apply(responses.values.data(), reflectance.data(),
          uncertainty ? deviation.data() : nullptr, responses.values.cols());
        auto* output = vtkTable::GetData(outputs, 0);
        output->ShallowCopy(table);
        msi::setSpectra(output, msi::SampleQuantity::Estimate, model.bands, reflectance);
        if (uncertainty)
        {
          msi::setSpectra(output, msi::SampleQuantity::Uncertainty, model.bands, deviation);
        }
        return;
      }
      auto* image = vtkImageData::GetData(inputs[0]);
      if (!image)
      {
        throw std::invalid_argument(
          "the first input is neither an image of camera responses nor a sample table");
      }
      auto* controller = msi::controllerOfPieces(inputs[0]);
      vtkDataArray* responses = nullptr;
      msi::beforeRanksMeet(controller,
        [&]
        {
          if (controller && image->GetNumberOfPoints() == 0)
          {
            return; // more ranks than rows
          }
          responses = msi::requireSpectralArray(image, "the image", this->ResponseArray.c_str());
          msi::requireSameChannels(msi::axisOf(image, responses), "the image", model.channels,
            "the reflectance transform");
        });
      const auto range = msi::readResponseRange(
        vtkTable::GetData(inputs[1]), static_cast<Eigen::Index>(model.channels.size()));
      // An image that is taken in blocks is judged by who takes it so.
      auto* information = inputs[0]->GetInformationObject(0);
      if (controller || msi::isWhole(information, image))
      {
        const auto judgement = msi::judgeResponses(
          information, image, responses, model.channels, range, this->TrustResponses, controller);
        this->OutOfRangeShare = judgement.outside;
        this->MissingShare = judgement.missing;
        if (!judgement.error.empty())
        {
          throw std::runtime_error(judgement.error);
        }
        if (!judgement.warning.empty() && (!controller || controller->GetLocalProcessId() == 0))
        {
          vtkWarningMacro(<< judgement.warning);
        }
      }
      auto* output = vtkImageData::GetData(outputs, 0);
      output->ShallowCopy(image);
      if (!responses)
      {
        return;
      }
      QualityMapsOf maps;
      if (this->QualityMaps)
      {
        const vtkIdType pixels = responses->GetNumberOfTuples();
        maps.range = range;
        maps.outOfRange = range ? newArray<vtkFloatArray>("OutOfRange", 1, pixels) : nullptr;
        maps.uncertainty =
          uncertainty ? newArray<vtkFloatArray>("UncertaintyRms", 1, pixels) : nullptr;
      }
      if (responses->GetDataType() == VTK_DOUBLE)
      {
        estimateImage<vtkDoubleArray>(
          this, model, responses, uncertainty && this->Uncertainty == 2, maps, output);
      }
      else
      {
        estimateImage<vtkFloatArray>(
          this, model, responses, uncertainty && this->Uncertainty == 2, maps, output);
      }
      // The picture of the responses is not one of the reflectance.
      msi::removePicture(output);
      if (this->Preview)
      {
        msi::setPicture(this, output, output->GetPointData()->GetScalars());
      }
    });
}
