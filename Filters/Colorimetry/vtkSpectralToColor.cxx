#include "vtkSpectralToColor.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <atomic>
#include <cmath>
#include <stdexcept>

vtkStandardNewMacro(vtkSpectralToColor);

namespace
{
struct Colorimetry
{
  msi::TristimulusTransform tristimulus;
  msi::CIELAB lab;
  msi::SRGB srgb;

  Colorimetry(
    const msi::WavelengthGrid& bands, const std::string& illuminant, const std::string& observer)
    : tristimulus(bands, msi::Illuminant::named(illuminant), msi::StandardObserver::named(observer))
    , lab(tristimulus.whitePoint())
    , srgb(tristimulus.whitePoint())
  {
  }
};

const msi::WavelengthGrid& requireWavelengths(const msi::SpectralAxis& axis)
{
  if (!axis.wavelengths)
  {
    throw std::invalid_argument(
      "the image has no wavelengths (field data 'Wavelength'); color needs "
      "reflectance whose wavelengths are known");
  }
  return *axis.wavelengths;
}

vtkSmartPointer<vtkFloatArray> addVectors(vtkImageData* image, const char* name, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(tuples);
  image->GetPointData()->AddArray(array);
  return array;
}

unsigned char byteOf(float value) noexcept
{
  constexpr float Largest = 255.0f;
  return std::isnan(value) ? 0 : static_cast<unsigned char>(std::lround(value * Largest));
}

void addColumns(vtkTable* table, const std::string& prefix, const char* const (&names)[3],
  const Eigen::Matrix3Xd& values)
{
  for (int i = 0; i < 3; ++i)
  {
    msi::setNumbers(table, prefix + names[i], values.row(i).transpose());
  }
}
}

vtkSpectralToColor::vtkSpectralToColor()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

void vtkSpectralToColor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Illuminant: " << this->Illuminant << "\n"
     << indent << "Observer: " << this->Observer << "\n"
     << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "ComputeXYZ: " << this->ComputeXYZ << "\n"
     << indent << "ComputeLab: " << this->ComputeLab << "\n"
     << indent << "ClippedCount: " << this->ClippedCount << "\n";
}

int vtkSpectralToColor::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkSpectralToColor::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->ClippedCount = 0;
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        this->ClippedCount = this->ColorTable(table, vtkTable::GetData(outputs, 0));
        return;
      }
      auto* image = vtkImageData::GetData(inputs[0]);
      if (!image)
      {
        throw std::invalid_argument("the input is neither a spectral image nor a sample table");
      }
      this->ClippedCount = this->ColorImage(image, vtkImageData::GetData(outputs, 0));
    });
}

vtkIdType vtkSpectralToColor::ColorTable(vtkTable* table, vtkTable* output)
{
  vtkIdType clipped = 0;
  output->ShallowCopy(table);
  bool any = false;
  for (const auto quantity : { msi::SampleQuantity::Reflectance, msi::SampleQuantity::Estimate })
  {
    const auto spectra = msi::findSpectra(table, quantity);
    if (!spectra)
    {
      continue;
    }
    any = true;
    const Colorimetry color(*spectra->axis.wavelengths, this->Illuminant, this->Observer);
    const auto xyz = color.tristimulus(spectra->values);
    Eigen::Matrix3Xd lab(3, xyz.cols());
    color.lab.fromXYZ(xyz, lab);
    Eigen::Matrix3Xd rgb(3, xyz.cols());
    clipped += color.srgb.apply(xyz, rgb).outOfGamut;
    rgb *= 255.0;
    const std::string prefix = std::string(1, static_cast<char>(quantity)) + "_";
    addColumns(output, prefix, { "X", "Y", "Z" }, xyz);
    addColumns(output, prefix, { "L", "a", "b" }, lab);
    addColumns(output, prefix, { "red", "green", "blue" }, rgb);
  }
  if (!any)
  {
    throw std::invalid_argument("the table has no reflectance; expected columns R400, R410, .. "
                                "(measured) or E400, E410, .. (estimated)");
  }
  return clipped;
}

vtkIdType vtkSpectralToColor::ColorImage(vtkImageData* image, vtkImageData* output)
{
  auto* array = msi::requireSpectralArray(image, "the image", this->SpectralArray.c_str());
  const auto axis = msi::axisOf(image, array);
  const Colorimetry color(requireWavelengths(axis), this->Illuminant, this->Observer);
  const auto spectra = msi::asFloats(array);
  const auto bands = static_cast<Eigen::Index>(axis.size());
  const vtkIdType pixels = spectra->GetNumberOfTuples();
  output->ShallowCopy(image);
  const auto xyzArray = this->ComputeXYZ ? addVectors(output, "XYZ", pixels) : nullptr;
  const auto labArray = this->ComputeLab ? addVectors(output, "Lab", pixels) : nullptr;
  vtkNew<vtkUnsignedCharArray> srgb;
  srgb->SetName(msi::PictureArray);
  srgb->SetNumberOfComponents(3);
  srgb->SetNumberOfTuples(pixels);

  std::atomic<vtkIdType> clipped{ 0 };
  const float* in = spectra->GetPointer(0);
  float* xyzOut = xyzArray ? xyzArray->GetPointer(0) : nullptr;
  float* labOut = labArray ? labArray->GetPointer(0) : nullptr;
  unsigned char* srgbOut = srgb->GetPointer(0);
  msi::forBlocks(this, pixels,
    [&](vtkIdType begin, vtkIdType end)
    {
      constexpr vtkIdType Block = 256;
      Eigen::Matrix<float, 3, Block> xyzBlock;
      Eigen::Matrix<float, 3, Block> block;
      vtkIdType clippedHere = 0;
      for (vtkIdType at = begin; at < end; at += Block)
      {
        const auto count = std::min(Block, end - at);
        auto xyz = xyzBlock.leftCols(count);
        color.tristimulus.apply(
          Eigen::Map<const Eigen::MatrixXf>(in + at * bands, bands, count), xyz);
        if (xyzOut)
        {
          Eigen::Map<Eigen::Matrix3Xf>(xyzOut + 3 * at, 3, count) = xyz;
        }
        if (labOut)
        {
          color.lab.fromXYZ(xyz, Eigen::Map<Eigen::Matrix3Xf>(labOut + 3 * at, 3, count));
        }
        auto rgb = block.leftCols(count);
        clippedHere += color.srgb.apply(xyz, rgb).outOfGamut;
        std::transform(rgb.data(), rgb.data() + 3 * count, srgbOut + 3 * at, byteOf);
      }
      clipped += clippedHere;
    });
  msi::removePicture(output);
  msi::replaceArray(output, nullptr, srgb);
  return clipped;
}
