#include "ResponseRange.h"

#include "ImagePieces.h"
#include "Kernels/Spectra/Counted.h"
#include "ThreadedParts.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <sstream>

namespace msi
{

namespace
{
constexpr const char* RangeArray = "ResponseRange";
constexpr vtkIdType MostPixels = 65536;
// Times the calibration's largest responses.
constexpr double DimImage = 0.1;    // its brightest hundredth stays below that
constexpr double BrightImage = 2.0; // half of it lies above that
constexpr double Margin = 0.1; // of a channel's range, beyond which a response is outside of it
constexpr double MostOutside = 0.5; // of the pixels
const char* const Remedy =
  "are they raw counts? Divide the image by a white image first (Flat Field Correction)";
const char* const Permission =
  "; where they are right, set Trust Responses (estimate: --trust-responses)";

std::string rounded(double value)
{
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

std::string percent(double share)
{
  std::ostringstream text;
  text.precision(share < 0.1 ? 2 : 3);
  text << 100.0 * share << " %";
  return text.str();
}

std::string zeroChannels(
  const Eigen::Array<bool, Eigen::Dynamic, 1>& isZero, const SpectralAxis& channels)
{
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < isZero.size(); ++k)
  {
    if (isZero[k])
    {
      names.push_back(nameOf(channels, static_cast<std::size_t>(k)));
    }
  }
  return names.empty() ? std::string()
                       : (names.size() == 1 ? "channel " : "channels ") + listed(names) +
      (names.size() == 1 ? " is" : " are") + " 0 in every pixel of the image";
}

double quantile(std::vector<double>& values, double share)
{
  const auto at =
    values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

// Each pixel's responses as multiples of the calibration's largest ones, mean over the channels; and how many pixels lie
// outside of its range in some channel.
ResponseJudgement besideRange(
  const Eigen::ArrayXXd& pixels, const ResponseRange& range, bool trusted)
{
  const Eigen::ArrayXd most = range.col(1).max(1e-300);
  const Eigen::ArrayXd margin = Margin * (range.col(1) - range.col(0));
  std::vector<double> brightness;
  Eigen::Index outside = 0;
  for (const auto& pixel : pixels.colwise())
  {
    brightness.push_back((pixel / most).mean());
    outside += (pixel < range.col(0) - margin || pixel > range.col(1) + margin).any() ? 1 : 0;
  }
  const double middle = quantile(brightness, 0.5);
  const double brightest = quantile(brightness, 0.99);
  const double share = static_cast<double>(outside) / static_cast<double>(pixels.cols());
  ResponseJudgement judgement;
  judgement.outside = share;
  std::string& unlike = trusted ? judgement.warning : judgement.error;
  const std::string permission = trusted ? "" : Permission;
  if (middle > BrightImage)
  {
    unlike = "half of the image's responses exceed the largest ones of the calibration samples " +
      rounded(middle) + " times; expected responses in the unit of the calibration; " + Remedy +
      permission;
  }
  else if (brightest < DimImage)
  {
    unlike = "the image's responses reach " + percent(brightest) +
      " of the largest ones of the calibration samples (99th percentile of the pixels); " + Remedy +
      permission;
  }
  else if (share > MostOutside)
  {
    judgement.warning = percent(share) +
      " of the pixels have responses outside of the range of the calibration samples: their "
      "reflectance is extrapolated";
  }
  return judgement;
}

// The responses of the pixels that this rank looks at, one after another.
std::vector<double> everyNth(
  vtkInformation* input, vtkImageData* image, vtkDataArray* responses, std::size_t channels)
{
  if (!responses)
  {
    return {};
  }
  std::vector<vtkIdType> looked;
  Extent whole{};
  input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
  const Extent owned = ownedExtent(input, image);
  const vtkIdType width = whole[1] - whole[0] + 1;
  const vtkIdType height = whole[3] - whole[2] + 1;
  const vtkIdType step =
    std::max<vtkIdType>(1, width * height * (whole[5] - whole[4] + 1) / MostPixels);
  for (int z = owned[4]; z <= owned[5]; ++z)
  {
    for (int y = owned[2]; y <= owned[3]; ++y)
    {
      const vtkIdType row = ((z - whole[4]) * height + y - whole[2]) * width;
      const vtkIdType begin = row + owned[0] - whole[0];
      const vtkIdType end = row + owned[1] - whole[0];
      for (vtkIdType pixel = (begin + step - 1) / step * step; pixel <= end; pixel += step)
      {
        int place[] = { static_cast<int>(pixel - row) + whole[0], y, z };
        looked.push_back(image->ComputePointId(place));
      }
    }
  }
  constexpr std::size_t Block = 1024;
  std::vector<double> values(looked.size() * channels);
  forParts(static_cast<vtkIdType>((looked.size() + Block - 1) / Block),
    [&](vtkIdType block)
    {
      const auto begin = static_cast<std::size_t>(block) * Block;
      for (std::size_t i = begin; i < std::min(begin + Block, looked.size()); ++i)
      {
        responses->GetTuple(looked[i], values.data() + i * channels);
      }
    });
  return values;
}

std::vector<double> onAllRanks(
  const std::vector<double>& mine, vtkMultiProcessController* controller)
{
  if (!controller)
  {
    return mine;
  }
  const auto ranks = static_cast<std::size_t>(controller->GetNumberOfProcesses());
  const auto count = static_cast<vtkIdType>(mine.size());
  std::vector<vtkIdType> counts(ranks);
  controller->AllGather(&count, counts.data(), 1);
  std::vector<vtkIdType> offsets(ranks, 0);
  std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
  std::vector<double> all(static_cast<std::size_t>(offsets.back() + counts.back()));
  controller->AllGatherV(mine.data(), all.data(), count, counts.data(), offsets.data());
  return all;
}
}

void writeResponseRange(vtkTable* transform, const std::vector<Eigen::MatrixXd>& responses)
{
  const Eigen::Index channels = responses.front().rows();
  vtkNew<vtkDoubleArray> array;
  array->SetName(RangeArray);
  array->SetNumberOfComponents(2);
  array->SetNumberOfTuples(channels);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    double least = responses.front().row(k).minCoeff();
    double most = responses.front().row(k).maxCoeff();
    for (const Eigen::MatrixXd& set : responses)
    {
      least = std::min(least, set.row(k).minCoeff());
      most = std::max(most, set.row(k).maxCoeff());
    }
    array->SetTuple2(k, least, most);
  }
  transform->GetFieldData()->AddArray(array);
}

std::optional<ResponseRange> readResponseRange(vtkTable* transform, Eigen::Index channels)
{
  auto* array = transform ? transform->GetFieldData()->GetArray(RangeArray) : nullptr;
  if (!array || array->GetNumberOfComponents() != 2 || array->GetNumberOfTuples() != channels)
  {
    return std::nullopt;
  }
  ResponseRange range(channels, 2);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    range(k, 0) = array->GetComponent(k, 0);
    range(k, 1) = array->GetComponent(k, 1);
  }
  return range;
}

ResponseJudgement judgeResponses(vtkInformation* input, vtkImageData* image,
  vtkDataArray* responses, const SpectralAxis& channels, const std::optional<ResponseRange>& range,
  bool trusted, vtkMultiProcessController* controller)
{
  const auto size = static_cast<Eigen::Index>(channels.size());
  const std::vector<double> values =
    onAllRanks(everyNth(input, image, responses, channels.size()), controller);
  const Eigen::Index looked = static_cast<Eigen::Index>(values.size()) / size;
  if (looked == 0)
  {
    return {};
  }
  Eigen::ArrayXXd pixels = Eigen::Map<const Eigen::ArrayXXd>(values.data(), size, looked);
  Eigen::Index kept = 0;
  for (Eigen::Index pixel = 0; pixel < looked; ++pixel)
  {
    if (pixels.col(pixel).isFinite().all())
    {
      pixels.col(kept++) = pixels.col(pixel);
    }
  }
  if (kept == 0)
  {
    return { "no pixel of the image has finite responses in all channels; expected the responses "
             "of a camera; where they were divided by a white image: is it brighter than the dark "
             "image, and of the same camera?",
      {} };
  }
  const double missing = 1.0 - static_cast<double>(kept) / static_cast<double>(looked);
  pixels.conservativeResize(Eigen::NoChange, kept);
  const Eigen::Array<bool, Eigen::Dynamic, 1> zero = (pixels == 0.0).rowwise().all();
  if (zero.all())
  {
    return { "the image is 0 in every pixel; expected the responses of a camera; check the file "
             "and the channels that "
             "were read",
      {} };
  }
  ResponseJudgement judgement = range ? besideRange(pixels, *range, trusted) : ResponseJudgement{};
  judgement.missing = missing;
  const std::string dead = zeroChannels(zero, channels);
  if (!dead.empty())
  {
    judgement.warning = dead + (judgement.warning.empty() ? "" : "; " + judgement.warning);
  }
  return judgement;
}

double excessOverRange(
  const Eigen::Ref<const Eigen::ArrayXd>& responses, const ResponseRange& range) noexcept
{
  double excess = 0.0;
  for (Eigen::Index k = 0; k < responses.size(); ++k)
  {
    const double least = range(k, 0);
    const double most = range(k, 1);
    const double over = std::max(least - responses[k], responses[k] - most);
    if (!(over <= 0.0))
    {
      const double units = over / std::max(most - least, 1e-12);
      excess = std::isnan(units) ? units : std::max(excess, units);
    }
    if (std::isnan(excess))
    {
      return excess;
    }
  }
  return excess;
}

bool isWhole(vtkInformation* information, vtkImageData* image)
{
  std::array<int, 6> whole{};
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole.data());
  return std::equal(whole.begin(), whole.end(), image->GetExtent());
}

} // namespace msi
