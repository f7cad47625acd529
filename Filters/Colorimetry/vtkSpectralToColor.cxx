#include "vtkSpectralToColor.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "NameList.h"
#include "SampleColumns.h"
#include "SpectralImage.h"
#include "ViewingConditions.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/ColorQuantity.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSpectralToColor);

namespace
{
// What an image's arrays of quantities are made of.
constexpr int QuantityComponents = 2;

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

vtkSmartPointer<vtkFloatArray> addVectors(
  vtkImageData* image, const char* name, vtkIdType tuples, int components = 3)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
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

// All that a color is computed with.
struct vtkSpectralToColor::Colorimetry
{
  msi::TristimulusTransform tristimulus;
  msi::CIELAB lab;
  msi::SRGB srgb;
  msi::ColorConditions white;
  std::vector<const msi::ColorQuantity*> quantities;

  Colorimetry(const vtkSpectralToColor& self, const msi::WavelengthGrid& bands,
    const msi::ViewingConditions& conditions)
    : tristimulus(bands, illuminantOf(self, conditions), conditions.observer())
    , lab(tristimulus.whitePoint())
    , srgb(tristimulus.whitePoint(), msi::displaySpaceNamed(self.Display),
        msi::chromaticAdaptationNamed(self.Adaptation))
    , white{ tristimulus.whitePoint(),
      conditions.observer().name() == msi::StandardObserver::cie1964TenDegree().name() }
  {
    for (const auto& name : msi::namesIn(self.Quantities))
    {
      quantities.push_back(&msi::colorQuantityNamed(name));
      requireDefined(*quantities.back(), illuminantOf(self, conditions), conditions.observer());
    }
  }

  static msi::Illuminant illuminantOf(
    const vtkSpectralToColor& self, const msi::ViewingConditions& conditions)
  {
    if (self.Illuminant != "other")
    {
      return conditions.illuminant(self.Illuminant);
    }
    const auto& file = conditions.namesOfFile();
    const auto& name = self.OtherIlluminant;
    if (name.empty() && file.size() == 1)
    {
      return conditions.illuminant(file.front());
    }
    if (name.empty())
    {
      throw std::invalid_argument(file.empty()
          ? "Other Illuminant is empty; type an illuminant, such as D5300K for daylight of 5300 K "
            "or BB3200K for a blackbody of 3200 K, choose the file of a lamp as Illuminant File, "
            "or choose one from the list Illuminant"
          : self.IlluminantFile + ": the file holds " + std::to_string(file.size()) +
            " illuminants, " + msi::quotedNames(file) +
            "; expected the name of one; type it as Other Illuminant");
    }
    if (!file.empty() && std::find(file.begin(), file.end(), name) == file.end())
    {
      throw std::invalid_argument("Other Illuminant is '" + name + "', but Illuminant File is " +
        self.IlluminantFile + " with " + msi::quotedNames(file) +
        "; expected one of these names, or one of the two fields empty");
    }
    return conditions.illuminant(name);
  }

  static void requireDefined(const msi::ColorQuantity& quantity, const msi::Illuminant& illuminant,
    const msi::StandardObserver& observer)
  {
    const auto illuminants = { "C", "D50", "D65" };
    const auto observers = msi::StandardObserver::names();
    if (quantity.daylightOnly &&
      (std::find(illuminants.begin(), illuminants.end(), illuminant.name()) == illuminants.end() ||
        std::find(observers.begin(), observers.end(), observer.name()) == observers.end()))
    {
      throw std::invalid_argument("the quantity " + std::string(quantity.name) +
        " is not defined under '" + illuminant.name() + "' for the observer '" + observer.name() +
        "'; expected the illuminant D65, D50 or C and an observer of the CIE");
    }
  }
};

vtkSpectralToColor::vtkSpectralToColor()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(1);
}

void vtkSpectralToColor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Illuminant: " << this->Illuminant << "\n"
     << indent << "OtherIlluminant: " << this->OtherIlluminant << "\n"
     << indent << "IlluminantFile: " << this->IlluminantFile << "\n"
     << indent << "ObserverFile: " << this->ObserverFile << "\n"
     << indent << "Observer: " << this->Observer << "\n"
     << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "ComputeXYZ: " << this->ComputeXYZ << "\n"
     << indent << "ComputeLab: " << this->ComputeLab << "\n"
     << indent << "Quantities: " << this->Quantities << "\n"
     << indent << "Display: " << this->Display << "\n"
     << indent << "Adaptation: " << this->Adaptation << "\n"
     << indent << "GamutMask: " << this->GamutMask << "\n"
     << indent << "ClippedCount: " << this->ClippedCount << "\n";
}

void vtkSpectralToColor::AddQuantity(const char* name)
{
  this->SetQuantities(msi::withNames(this->Quantities, name).c_str());
}

void vtkSpectralToColor::ClearQuantities()
{
  this->SetQuantities("");
}

int vtkSpectralToColor::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  if (port == 0)
  {
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  }
  else
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkSpectralToColor::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  msi::requestWhole(inputs, 1);
  msi::requestWhole(inputs, 2);
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkSpectralToColor::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->ClippedCount = 0;
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const msi::ViewingConditions conditions(vtkTable::GetData(inputs[1]),
        vtkTable::GetData(inputs[2]), this->Observer, { this->IlluminantFile, this->ObserverFile });
      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        this->ClippedCount = this->ColorTable(table, conditions, vtkTable::GetData(outputs, 0));
        return;
      }
      auto* image = vtkImageData::GetData(inputs[0]);
      if (!image)
      {
        throw std::invalid_argument("the input is neither a spectral image nor a sample table");
      }
      this->ClippedCount = this->ColorImage(image, conditions, vtkImageData::GetData(outputs, 0));
    });
}

vtkIdType vtkSpectralToColor::ColorTable(
  vtkTable* table, const msi::ViewingConditions& conditions, vtkTable* output)
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
    const Colorimetry color(*this, *spectra->axis.wavelengths, conditions);
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
    for (const auto* coordinates : color.quantities)
    {
      Eigen::Matrix2Xd values(2, xyz.cols());
      for (Eigen::Index i = 0; i < xyz.cols(); ++i)
      {
        values.col(i) = coordinates->of(color.white, xyz.col(i));
      }
      for (Eigen::Index i = 0; i < QuantityComponents; ++i)
      {
        msi::setNumbers(output, prefix + coordinates->components[static_cast<std::size_t>(i)],
          values.row(i).transpose());
      }
    }
    if (this->GamutMask)
    {
      Eigen::VectorXd outside(xyz.cols());
      for (Eigen::Index i = 0; i < xyz.cols(); ++i)
      {
        outside(i) = color.srgb.isOutOfGamut(xyz.col(i)) ? 1.0 : 0.0;
      }
      msi::setNumbers(output, prefix + "out_of_gamut", outside);
    }
  }
  if (!any)
  {
    throw std::invalid_argument("the table has no reflectance; expected columns R400, R410, .. "
                                "(measured) or E400, E410, .. (estimated)");
  }
  return clipped;
}

vtkIdType vtkSpectralToColor::ColorImage(
  vtkImageData* image, const msi::ViewingConditions& conditions, vtkImageData* output)
{
  auto* array = msi::requireReflectanceArray(image, "the image", this->SpectralArray.c_str());
  const auto axis = msi::axisOf(image, array);
  const Colorimetry color(*this, requireWavelengths(axis), conditions);
  const auto spectra = msi::asFloats(array);
  const auto bands = static_cast<Eigen::Index>(axis.size());
  const vtkIdType pixels = spectra->GetNumberOfTuples();
  output->ShallowCopy(image);
  const auto xyzArray = this->ComputeXYZ ? addVectors(output, "XYZ", pixels) : nullptr;
  const auto labArray = this->ComputeLab ? addVectors(output, "Lab", pixels) : nullptr;
  std::vector<float*> quantitiesOut;
  for (const auto* quantity : color.quantities)
  {
    const auto values =
      addVectors(output, std::string(quantity->name).c_str(), pixels, QuantityComponents);
    for (int i = 0; i < QuantityComponents; ++i)
    {
      values->SetComponentName(i, quantity->components[static_cast<std::size_t>(i)].c_str());
    }
    quantitiesOut.push_back(values->GetPointer(0));
  }
  unsigned char* maskOut = nullptr;
  if (this->GamutMask)
  {
    vtkNew<vtkUnsignedCharArray> mask;
    mask->SetName("OutOfGamut");
    mask->SetNumberOfTuples(pixels);
    output->GetPointData()->AddArray(mask);
    maskOut = mask->GetPointer(0);
  }
  vtkNew<vtkUnsignedCharArray> srgb;
  srgb->SetName(this->Display == "sRGB" ? msi::PictureArray : this->Display.c_str());
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
        for (vtkIdType i = 0; (maskOut || !quantitiesOut.empty()) && i < count; ++i)
        {
          const Eigen::Vector3d one = xyz.col(i).cast<double>();
          for (std::size_t q = 0; q < quantitiesOut.size(); ++q)
          {
            Eigen::Map<Eigen::Vector2f>(quantitiesOut[q] + QuantityComponents * (at + i)) =
              color.quantities[q]->of(color.white, one).cast<float>();
          }
          if (maskOut)
          {
            maskOut[at + i] = color.srgb.isOutOfGamut(one) ? 1 : 0;
          }
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
