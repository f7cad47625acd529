#include "CaseInput.h"

#include "Formats/Capture.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace withheld
{

namespace
{
std::vector<std::string> words(const msi::SampleTable& table, const char* name)
{
  const msi::MetadataColumn* column = table.findMetadata(name);
  return column == nullptr ? std::vector<std::string>{} : column->text;
}

Eigen::VectorXd numbers(const msi::SampleTable& table, const char* name)
{
  const msi::MetadataColumn* column = table.findMetadata(name);
  if (column == nullptr)
  {
    return {};
  }
  const std::vector<double> values = column->numbers();
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

msi::GapCapture readTable(const std::string& folder)
{
  std::vector<std::string> captures{ folder };
  if (std::filesystem::exists(folder + "/next"))
  {
    captures.push_back(folder + "/next");
  }
  const msi::Capture capture = msi::readCaptures(captures);
  const auto& darkList = capture.description.dark;
  Eigen::VectorXd dark = Eigen::VectorXd::Zero(capture.camera.values.cols());
  for (std::size_t k = 0; k < darkList.size(); ++k)
  {
    dark[static_cast<Eigen::Index>(k)] = darkList[k];
  }
  msi::SceneSamples samples;
  samples.reflectance = capture.samples.reflectance;
  samples.medium = words(capture.samples, "medium");
  samples.scene = words(capture.samples, "scene");
  samples.x = numbers(capture.samples, "x");
  samples.y = numbers(capture.samples, "y");
  samples.order = numbers(capture.samples, "order");
  std::map<std::string, int> place;
  for (const std::string& name : capture.samples.sampleNames())
  {
    place.emplace(name, static_cast<int>(place.size()));
  }
  std::vector<int> sampleOf;
  for (const std::string& name : capture.readings.sample)
  {
    sampleOf.push_back(place.at(name));
  }
  std::optional<msi::CameraNoise> noise;
  if (capture.description.noise.read && capture.description.noise.shot)
  {
    noise = msi::CameraNoise{ *capture.description.noise.read, *capture.description.noise.shot };
  }
  return { msi::CameraModel(capture.camera.wavelengths, capture.camera.values.transpose(), dark,
             capture.camera.names),
    *capture.samples.wavelengths, std::move(samples), capture.readings.responses,
    std::move(sampleOf), noise };
}

CaseInput readPair(std::ifstream& file, const std::string& path)
{
  const auto get = [&file](void* data, std::size_t bytes)
  { file.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes)); };
  int header[4];
  get(header, sizeof(header));
  CaseInput input;
  input.extent = { header[0], header[1] };
  for (int k = 0; k < header[2]; ++k)
  {
    input.channels.push_back("C" + std::to_string(k + 1));
  }
  const std::size_t pixels = msi::wholeImage(input.extent).pixels();
  input.real.resize(pixels * input.channels.size());
  input.simulated.resize(input.real.size());
  input.labels.resize(header[3] != 0 ? pixels : 0);
  get(input.real.data(), input.real.size() * sizeof(float));
  get(input.simulated.data(), input.simulated.size() * sizeof(float));
  get(input.labels.data(), input.labels.size() * sizeof(int));
  if (!file)
  {
    throw std::runtime_error(path + ": ends before its pixels do");
  }
  return input;
}
}

CaseInput readCase(const std::string& folder)
{
  const std::string path = folder + "/pair.bin";
  std::ifstream file(path, std::ios::binary);
  if (file)
  {
    return readPair(file, path);
  }
  CaseInput input;
  input.capture = readTable(folder);
  return input;
}

} // namespace withheld
