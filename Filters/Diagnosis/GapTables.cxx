#include "GapTables.h"

#include "CameraTable.h"
#include "SampleColumns.h"
#include "UsefulData.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr const char* CameraName = "the camera table";
constexpr const char* SamplesName = "the samples table";
constexpr const char* ResponsesName = "the responses table";

// With fewer samples nothing can be held out that judges what the others taught.
constexpr std::size_t FewestSamples = 5;

// The column of that name, upper and lower case alike, or null.
vtkAbstractArray* findColumn(vtkTable* table, const std::string& name)
{
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    const char* other = table->GetColumnName(i);
    const std::string text = other ? other : "";
    if (std::equal(text.begin(), text.end(), name.begin(), name.end(),
          [](char a, char b)
          { return std::tolower(static_cast<unsigned char>(a)) == static_cast<unsigned char>(b); }))
    {
      return table->GetColumn(i);
    }
  }
  return nullptr;
}

std::vector<std::string> textColumn(vtkTable* table, const std::string& name)
{
  std::vector<std::string> texts;
  if (auto* column = findColumn(table, name))
  {
    for (vtkIdType row = 0; row < column->GetNumberOfTuples(); ++row)
    {
      texts.push_back(column->GetVariantValue(row).ToString());
    }
  }
  return texts;
}

Eigen::VectorXd numberColumn(vtkTable* table, const std::string& name)
{
  auto* column = findColumn(table, name);
  if (!column)
  {
    return {};
  }
  auto* numbers = vtkDataArray::SafeDownCast(column);
  if (!numbers || numbers->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(
      std::string(SamplesName) + ": column '" + name + "' is not a column of numbers");
  }
  Eigen::VectorXd values(numbers->GetNumberOfTuples());
  for (Eigen::Index i = 0; i < values.size(); ++i)
  {
    values[i] = numbers->GetComponent(i, 0);
  }
  return values;
}

std::vector<std::string> namesOf(vtkTable* samples)
{
  auto names = textColumn(samples, "sample");
  if (names.empty())
  {
    for (vtkIdType row = 0; row < samples->GetNumberOfRows(); ++row)
    {
      names.push_back(std::to_string(row + 1));
    }
  }
  return names;
}

std::map<std::string, int> placesOf(const std::vector<std::string>& names)
{
  std::map<std::string, int> places;
  for (const std::string& name : names)
  {
    if (!places.emplace(name, static_cast<int>(places.size())).second)
    {
      throw std::invalid_argument(
        std::string(SamplesName) + " has sample '" + name + "' twice; expected each sample once");
    }
  }
  return places;
}

std::vector<int> samplesOfReadings(vtkTable* responses, const std::vector<std::string>& names)
{
  const auto readings = textColumn(responses, "sample");
  if (readings.empty())
  {
    throw std::invalid_argument(std::string(ResponsesName) +
      " has no column 'sample'; expected the name of the sample of each reading");
  }
  const auto places = placesOf(names);
  std::vector<int> samples;
  for (const std::string& name : readings)
  {
    const auto place = places.find(name);
    if (place == places.end())
    {
      throw std::invalid_argument(std::string(ResponsesName) + " has sample '" + name + "', but " +
        SamplesName + " has not; expected a reflectance for every reading");
    }
    samples.push_back(place->second);
  }
  return samples;
}

void requireNoEffects(const CameraTable& camera)
{
  const auto text = camera.effects.find_first_not_of(" \t\n[]");
  if (text != std::string::npos)
  {
    throw std::invalid_argument(std::string(CameraName) +
      " has effects in its field data; the diagnosis looks for effects of a camera without any: "
      "give the camera as designed");
  }
}

void requireUsefulReadings(const Eigen::MatrixXd& readings, const std::vector<int>& sampleOf,
  const Eigen::MatrixXd& reflectance, const CameraModel& camera, const std::string& name)
{
  requirePossibleResponse(readings, name);
  for (Eigen::Index k = 0; k < readings.rows(); ++k)
  {
    if (readings.cols() > 0 && (readings.row(k).array() == 0.0).all())
    {
      throw std::invalid_argument(name + ": channel " +
        camera.channels()[static_cast<std::size_t>(k)] +
        " is 0 in every reading; expected the answers of a camera: leave a dead channel out of "
        "both cameras");
    }
  }
  std::set<int> usable;
  for (Eigen::Index j = 0; j < readings.cols(); ++j)
  {
    const int sample = sampleOf[static_cast<std::size_t>(j)];
    if (readings.col(j).array().isFinite().any() && reflectance.col(sample).allFinite())
    {
      usable.insert(sample);
    }
  }
  if (usable.size() < FewestSamples)
  {
    throw std::invalid_argument("a diagnosis needs " + std::to_string(FewestSamples) +
      " samples or more with reading and reflectance; " + std::to_string(usable.size()) + " of " +
      std::to_string(reflectance.cols()) + " have both");
  }
}
}

GapCapture gapCaptureOf(vtkTable* cameraTable, vtkTable* samples, vtkTable* responses)
{
  const CameraTable camera = readCamera(cameraTable, CameraName);
  requireNoEffects(camera);
  auto reflectance = requireSpectra(samples, SampleQuantity::Reflectance, SamplesName);
  const bool own = responses == nullptr;
  auto readings = requireSpectra(
    own ? samples : responses, SampleQuantity::Response, own ? SamplesName : ResponsesName);
  const auto channels = static_cast<Eigen::Index>(readings.axis.size());
  if (channels != camera.camera.channelCount())
  {
    throw std::invalid_argument(std::string(CameraName) + " has " +
      std::to_string(camera.camera.channelCount()) + " channels, but " +
      (own ? SamplesName : ResponsesName) + " has " + std::to_string(channels) +
      "; both must be of the same camera with the same channels");
  }
  // A camera that answers to nothing, or only where no sample was measured, explains everything and nothing.
  const std::string useless =
    uselessChannel(camera.camera, *reflectance.axis.wavelengths, CameraName);
  if (!useless.empty())
  {
    throw std::invalid_argument(useless);
  }
  requirePossibleReflectance(reflectance.values, SamplesName);
  auto names = namesOf(samples);
  std::vector<int> sampleOf(names.size());
  std::iota(sampleOf.begin(), sampleOf.end(), 0);
  if (!own)
  {
    sampleOf = samplesOfReadings(responses, names);
  }
  requireUsefulReadings(readings.values, sampleOf, reflectance.values, camera.camera,
    own ? SamplesName : ResponsesName);
  SceneSamples scene{ std::move(reflectance.values), textColumn(samples, "medium"),
    textColumn(samples, "scene"), numberColumn(samples, "x"), numberColumn(samples, "y"),
    numberColumn(samples, "order") };
  if (scene.x.size() != scene.y.size())
  {
    scene.x.resize(0);
    scene.y.resize(0);
  }
  return { camera.camera, *reflectance.axis.wavelengths, std::move(scene),
    std::move(readings.values), std::move(sampleOf), camera.noise, std::move(names) };
}

} // namespace msi
