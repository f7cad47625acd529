#include "vtkFlatFieldCorrection.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "ImagePieces.h"
#include "ResponseRange.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkFlatFieldCorrection);

namespace
{
constexpr const char* MaskArray = "Mask";
constexpr const char* NameOfRaw = "the raw image";
constexpr const char* NameOfFrame[] = { NameOfRaw, "the white image", "the dark image" };

using SDDP = vtkStreamingDemandDrivenPipeline;

// A reference of the same channels as the raw image: its size, or one row or one column for all.
struct Frame
{
  vtkSmartPointer<vtkFloatArray> values; // null where none is connected
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  bool oneColumn = false;
  bool oneRow = false;

  // The channels of the pixel at (x, y), or null.
  const float* at(vtkIdType x, vtkIdType y) const
  {
    if (!values)
    {
      return nullptr;
    }
    const vtkIdType column = oneColumn ? 0 : x - extent[0];
    const vtkIdType row = oneRow ? 0 : y - extent[2];
    return values->GetPointer(
      (row * (extent[1] - extent[0] + 1) + column) * values->GetNumberOfComponents());
  }
};

bool isOne(vtkInformation* info, std::ptrdiff_t axis)
{
  int whole[6];
  info->Get(SDDP::WHOLE_EXTENT(), whole);
  return whole[2 * axis] == whole[2 * axis + 1];
}

Frame frame(
  vtkInformationVector* input, const char* name, vtkImageData* raw, vtkFloatArray* rawValues)
{
  Frame result;
  auto* image = vtkImageData::GetData(input);
  if (!image)
  {
    return result;
  }
  result.values = msi::asFloats(msi::requireSpectralArray(image, name));
  msi::requireSameChannels(
    msi::axisOf(image, result.values), name, msi::axisOf(raw, rawValues), NameOfRaw);
  image->GetExtent(result.extent);
  auto* info = input->GetInformationObject(0);
  result.oneColumn = isOne(info, 0);
  result.oneRow = isOne(info, 1);
  const int* held = raw->GetExtent();
  const int* mine = result.extent;
  const bool covers = (result.oneColumn || (mine[0] <= held[0] && mine[1] >= held[1])) &&
    (result.oneRow || (mine[2] <= held[2] && mine[3] >= held[3]));
  if (!covers)
  {
    throw std::invalid_argument(std::string(name) + " shows another region than the raw image");
  }
  return result;
}

// One factor a channel: signals are compared per exposure time.
std::vector<float> exposureFactors(
  const std::vector<double>& raw, const std::vector<double>& white, int channels)
{
  const auto timeOf = [channels](const std::vector<double>& times, int k, const char* name)
  {
    const bool fits = times.size() <= 1 || static_cast<int>(times.size()) == channels;
    const double time =
      times.empty() ? 1.0 : times[times.size() == 1 || !fits ? 0 : static_cast<std::size_t>(k)];
    if (!fits || !(time > 0.0))
    {
      throw std::invalid_argument(std::string(name) + " holds " + std::to_string(times.size()) +
        " times; expected one for all channels or " + std::to_string(channels) +
        ", one for each, all above 0");
    }
    return time;
  };
  if (raw.empty() != white.empty())
  {
    throw std::invalid_argument(
      std::string(raw.empty() ? "ExposureTimes are" : "WhiteExposureTimes are") +
      " missing; give the times of both, or of none where they are equal");
  }
  std::vector<float> factors;
  factors.reserve(static_cast<std::size_t>(channels));
  for (int k = 0; k < channels; ++k)
  {
    factors.push_back(
      static_cast<float>(timeOf(white, k, "WhiteExposureTimes") / timeOf(raw, k, "ExposureTimes")));
  }
  return factors;
}
}

void vtkFlatFieldCorrection::AddExposureTime(double time)
{
  this->ExposureTimes.push_back(time);
  this->Modified();
}

void vtkFlatFieldCorrection::ClearExposureTimes()
{
  this->ExposureTimes.clear();
  this->Modified();
}

void vtkFlatFieldCorrection::AddWhiteExposureTime(double time)
{
  this->WhiteExposureTimes.push_back(time);
  this->Modified();
}

void vtkFlatFieldCorrection::ClearWhiteExposureTimes()
{
  this->WhiteExposureTimes.clear();
  this->Modified();
}

vtkFlatFieldCorrection::vtkFlatFieldCorrection()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(1);
}

void vtkFlatFieldCorrection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
  os << indent << "WhiteReflectance: " << this->WhiteReflectance << "\n"
     << indent << "WhiteLevel: " << this->WhiteLevel << "\n"
     << indent << "ExposureTimes:";
  for (const double time : this->ExposureTimes)
  {
    os << " " << time;
  }
  os << "\n" << indent << "WhiteExposureTimes:";
  for (const double time : this->WhiteExposureTimes)
  {
    os << " " << time;
  }
  os << "\n"
     << indent << "SaturationLevel: " << this->SaturationLevel << "\n"
     << indent << "ComputeMask: " << this->ComputeMask << "\n"
     << indent << "DeadCount: " << this->DeadCount << "\n"
     << indent << "SaturatedCount: " << this->SaturatedCount << "\n";
}

int vtkFlatFieldCorrection::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkFlatFieldCorrection::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* raw = inputs[0]->GetInformationObject(0);
      for (int port = 1; port < 3; ++port)
      {
        auto* reference = inputs[port]->GetInformationObject(0);
        // One row or one column counts for all; along the other side the sizes have to agree.
        if (reference && (isOne(reference, 0) || isOne(reference, 1)))
        {
          int sizes[2][6];
          raw->Get(SDDP::WHOLE_EXTENT(), sizes[0]);
          reference->Get(SDDP::WHOLE_EXTENT(), sizes[1]);
          const auto length = [&](std::ptrdiff_t image, std::ptrdiff_t axis)
          { return sizes[image][2 * axis + 1] - sizes[image][2 * axis] + 1; };
          if ((length(1, 0) == 1 || length(1, 0) == length(0, 0)) &&
            (length(1, 1) == 1 || length(1, 1) == length(0, 1)))
          {
            continue;
          }
        }
        msi::requireSameSize(
          reference, NameOfFrame[port], raw, NameOfRaw, "take both with the same camera settings");
      }
    });
}

int vtkFlatFieldCorrection::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  for (int port = 1; port < 3; ++port)
  {
    auto* info = inputs[port]->GetInformationObject(0);
    if (info && (isOne(info, 0) || isOne(info, 1)))
    {
      // One row or one column is needed whole by every piece.
      int whole[6];
      info->Get(SDDP::WHOLE_EXTENT(), whole);
      info->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
      info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(SDDP::UPDATE_EXTENT(), whole, 6);
    }
  }
  return 1;
}

// What the values are like, in all pieces of the image.
struct vtkFlatFieldCorrection::Judgement
{
  static constexpr double Unlikely = 1.5;  // times the white
  static constexpr vtkIdType OneIn = 1000; // values are at the end of their range
  enum
  {
    VALUES,
    DEAD_VALUES,
    FINITE,
    BELOW_DARK,
    FAR_ABOVE_WHITE,
    AT_LARGEST,
    WHITE_VALUES,
    WHITE_AT_LARGEST,
    SIZE
  };
  std::array<vtkIdType, SIZE> counts{};
  std::array<float, 2> largest{}; // of raw and white
  bool hasWhite = false;
  bool hasDark = false;

  void count(vtkFloatArray* responses, double white)
  {
    const float* values = responses->GetPointer(0);
    for (vtkIdType i = 0; i < responses->GetNumberOfValues(); ++i)
    {
      counts[FINITE] += std::isfinite(values[i]) ? 1 : 0;
      counts[BELOW_DARK] += values[i] < 0.0F ? 1 : 0;
      counts[FAR_ABOVE_WHITE] += values[i] > static_cast<float>(Unlikely * white) ? 1 : 0;
    }
  }
  // How many of these values are the largest one.
  static vtkIdType countLargest(vtkFloatArray* array, float& largest)
  {
    const float* values = array->GetPointer(0);
    const float* end = values + array->GetNumberOfValues();
    for (const float* value = values; value != end; ++value)
    {
      largest = *value > largest ? *value : largest;
    }
    return std::count(values, end, largest);
  }
  vtkIdType percent(int part, int of) const
  {
    return (200 * counts[static_cast<std::size_t>(part)] + counts[static_cast<std::size_t>(of)]) /
      (2 * counts[static_cast<std::size_t>(of)]);
  }
};

namespace
{
// Of 8 to 16 bits, as counts or relative to those of the file.
bool isFullScale(float value)
{
  constexpr double Rounding = 1e-6;
  const auto is = [value](double end)
  { return std::fabs(static_cast<double>(value) / end - 1.0) < Rounding; };
  for (const double end : { 1023.0, 4095.0, 16383.0, 65535.0 })
  {
    if (is(end) || is(end / 65535.0))
    {
      return true;
    }
  }
  return is(255.0);
}
}

// Frames in each other's place give numbers all the same.
void vtkFlatFieldCorrection::Judge(
  const Judgement& judgement, vtkMultiProcessController* controller)
{
  std::array<vtkIdType, Judgement::SIZE> counts = judgement.counts;
  std::array<float, 2> largest = judgement.largest;
  if (controller)
  {
    controller->AllReduce(judgement.largest.data(), largest.data(), 2, vtkCommunicator::MAX_OP);
    counts[Judgement::AT_LARGEST] *= judgement.largest[0] == largest[0] ? 1 : 0;
    counts[Judgement::WHITE_AT_LARGEST] *= judgement.largest[1] == largest[1] ? 1 : 0;
    const std::array<vtkIdType, Judgement::SIZE> mine = counts;
    controller->AllReduce(mine.data(), counts.data(), Judgement::SIZE, vtkCommunicator::SUM_OP);
  }
  Judgement all = judgement;
  all.counts = counts;
  if (counts[Judgement::VALUES] > 0 && counts[Judgement::DEAD_VALUES] == counts[Judgement::VALUES])
  {
    throw std::runtime_error(std::string(all.hasWhite ? "the white image" : "the White Level") +
      " is above the " + (all.hasDark ? "dark image" : "dark level 0") +
      " in no pixel and no channel; expected the white to be brighter; " +
      (all.hasWhite ? "are white and dark swapped?" : "set White Level, or connect a white image"));
  }
  if (controller && controller->GetLocalProcessId() > 0)
  {
    return; // one rank speaks
  }
  if (2 * counts[Judgement::DEAD_VALUES] > counts[Judgement::VALUES])
  {
    vtkWarningMacro(<< all.percent(Judgement::DEAD_VALUES, Judgement::VALUES)
                    << " % of the values have no result: the white is not above the dark there; "
                       "are white and dark swapped?");
  }
  if (2 * counts[Judgement::BELOW_DARK] > counts[Judgement::FINITE])
  {
    vtkWarningMacro(<< all.percent(Judgement::BELOW_DARK, Judgement::FINITE)
                    << " % of the raw values are below the dark image; are the images swapped?");
  }
  else if (2 * counts[Judgement::FAR_ABOVE_WHITE] > counts[Judgement::FINITE])
  {
    vtkWarningMacro(<< all.percent(Judgement::FAR_ABOVE_WHITE, Judgement::FINITE)
                    << " % of the raw values exceed the white " << Judgement::Unlikely
                    << " times; are the images swapped, or exposed differently (Exposure Times)?");
  }
  const auto warnOfSaturated = [&](float end, int part, int of, const char* name)
  {
    const vtkIdType count = counts[static_cast<std::size_t>(part)];
    const vtkIdType values = counts[static_cast<std::size_t>(of)];
    // All of them: a drawn image.
    if (this->SaturationLevel <= 0.0 && isFullScale(end) && count < values &&
      Judgement::OneIn * count > values)
    {
      vtkWarningMacro(<< "Saturated? " << (100 * count + values - 1) / values
                      << " % of the values of " << name << " are at the end of their range (" << end
                      << "): a shorter exposure keeps what differs; Saturation Level (estimate: "
                         "--saturation) takes them out");
    }
  };
  warnOfSaturated(largest[0], Judgement::AT_LARGEST, Judgement::VALUES, NameOfRaw);
  warnOfSaturated(largest[1], Judgement::WHITE_AT_LARGEST, Judgement::WHITE_VALUES, NameOfFrame[1]);
  if (all.hasDark && !all.hasWhite && this->WhiteLevel == 1.0)
  {
    vtkWarningMacro(<< "no white image is connected and White Level is 1: the responses are not "
                       "relative to white; connect a white image, or set White Level");
  }
}

int vtkFlatFieldCorrection::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->DeadCount = 0;
  this->SaturatedCount = 0;
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* controller = msi::controllerOfPieces(inputs[0]);
      const bool judged = controller ||
        msi::isWhole(inputs[0]->GetInformationObject(0), vtkImageData::GetData(inputs[0]));
      Judgement judgement;
      msi::beforeRanksMeet(controller,
        [&]
        {
          auto* raw = vtkImageData::GetData(inputs[0]);
          if (controller && raw->GetNumberOfPoints() == 0)
          {
            vtkImageData::GetData(outputs, 0)->ShallowCopy(raw); // more ranks than rows
            return;
          }
          judgement = this->Correct(inputs, outputs, judged);
        });
      if (judged)
      {
        this->Judge(judgement, controller);
      }
    });
}

vtkFlatFieldCorrection::Judgement vtkFlatFieldCorrection::Correct(
  vtkInformationVector** inputs, vtkInformationVector* outputs, bool judged)
{
  Judgement judgement;
  if (!(this->WhiteLevel > 0.0))
  {
    throw std::invalid_argument(
      "WhiteLevel is " + std::to_string(this->WhiteLevel) + "; expected more than 0");
  }
  auto* rawImage = vtkImageData::GetData(inputs[0]);
  auto* rawArray = msi::requireSpectralArray(rawImage, NameOfRaw);
  const auto raw = msi::asFloats(rawArray);
  const auto white = frame(inputs[1], NameOfFrame[1], rawImage, raw);
  const auto dark = frame(inputs[2], NameOfFrame[2], rawImage, raw);
  if (!white.values && !dark.values && this->WhiteLevel == 1.0 && this->WhiteReflectance == 1.0 &&
    this->ExposureTimes.empty() && this->SaturationLevel <= 0.0)
  {
    throw std::invalid_argument("neither a white nor a dark image is connected, so the raw values "
                                "would pass unchanged; connect a white image, or set White Level");
  }
  const int channels = raw->GetNumberOfComponents();
  const auto factors = exposureFactors(this->ExposureTimes, this->WhiteExposureTimes, channels);

  auto* output = vtkImageData::GetData(outputs, 0);
  output->ShallowCopy(rawImage);
  vtkNew<vtkFloatArray> responses;
  responses->SetName(msi::ResponsesArray);
  responses->SetNumberOfComponents(channels);
  responses->SetNumberOfTuples(raw->GetNumberOfTuples());
  vtkNew<vtkUnsignedCharArray> mask;
  mask->SetName(MaskArray);
  mask->SetNumberOfComponents(channels);
  mask->SetNumberOfTuples(this->ComputeMask ? raw->GetNumberOfTuples() : 0);
  const float* rawValues = raw->GetPointer(0);
  float* out = responses->GetPointer(0);
  unsigned char* flags = this->ComputeMask ? mask->GetPointer(0) : nullptr;
  const auto level = static_cast<float>(this->WhiteLevel);
  const auto scale = static_cast<float>(this->WhiteReflectance);
  const float saturation = this->SaturationLevel > 0.0 ? static_cast<float>(this->SaturationLevel)
                                                       : std::numeric_limits<float>::infinity();
  const int* extent = rawImage->GetExtent();
  const vtkIdType width = extent[1] - extent[0] + 1;
  std::atomic<vtkIdType> dead{ 0 };
  std::atomic<vtkIdType> saturated{ 0 };
  msi::forBlocks(this, raw->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdType deadHere = 0;
      vtkIdType saturatedHere = 0;
      for (vtkIdType pixel = begin; pixel < end; ++pixel)
      {
        const vtkIdType x = extent[0] + pixel % width;
        const vtkIdType y = extent[2] + pixel / width;
        const float* whites = white.at(x, y);
        const float* darks = dark.at(x, y);
        for (int k = 0; k < channels; ++k)
        {
          const vtkIdType i = pixel * channels + k;
          const float black = darks ? darks[k] : 0.0f;
          const float full = whites ? whites[k] : level;
          const float span = full - black;
          unsigned char flag = span > 0.0f ? 0 : DEAD;
          flag |= rawValues[i] >= saturation ? RAW_SATURATED : 0;
          flag |= whites && full >= saturation ? WHITE_SATURATED : 0;
          deadHere += (flag & DEAD) != 0 ? 1 : 0;
          saturatedHere += (flag & (RAW_SATURATED | WHITE_SATURATED)) != 0 ? 1 : 0;
          out[i] = flag == 0
            ? scale * factors[static_cast<std::size_t>(k)] * (rawValues[i] - black) / span
            : std::numeric_limits<float>::quiet_NaN();
          if (flags)
          {
            flags[i] = flag;
          }
        }
      }
      dead += deadHere;
      saturated += saturatedHere;
    });
  if (judged)
  {
    judgement.hasWhite = white.values != nullptr;
    judgement.hasDark = dark.values != nullptr;
    judgement.counts[Judgement::VALUES] = raw->GetNumberOfTuples() * channels;
    judgement.counts[Judgement::DEAD_VALUES] = dead;
    judgement.count(responses, this->WhiteReflectance);
    judgement.counts[Judgement::AT_LARGEST] = Judgement::countLargest(raw, judgement.largest[0]);
    if (white.values)
    {
      judgement.counts[Judgement::WHITE_VALUES] = white.values->GetNumberOfValues();
      judgement.counts[Judgement::WHITE_AT_LARGEST] =
        Judgement::countLargest(white.values, judgement.largest[1]);
    }
  }
  this->DeadCount = dead;
  this->SaturatedCount = saturated;
  const auto axis = msi::axisOf(rawImage, rawArray);
  msi::nameComponents(responses, axis);
  msi::replaceArray(output, rawArray, responses);
  msi::removePicture(output);
  if (this->Preview)
  {
    msi::setPicture(this, output, responses);
  }
  if (flags)
  {
    msi::nameComponents(mask, axis);
    output->GetPointData()->AddArray(mask);
  }
  return judgement;
}
