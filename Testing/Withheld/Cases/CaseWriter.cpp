#include "CaseWriter.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace withheld
{

double uniform(Random& random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}
double normal(Random& random, double deviation)
{
  return std::normal_distribution<double>(0.0, deviation)(random);
}
int integer(Random& random, int low, int high)
{
  return std::uniform_int_distribution<int>(low, high)(random);
}
bool chance(Random& random, double probability)
{
  return uniform(random, 0.0, 1.0) < probability;
}
double around(Random& random, double middle, double factor)
{
  return middle * std::pow(factor, uniform(random, -1.0, 1.0));
}

std::vector<std::string> someOf(Random& random, const std::vector<std::string>& names, int count)
{
  std::vector<std::string> chosen = names;
  std::shuffle(chosen.begin(), chosen.end(), random);
  chosen.resize(static_cast<std::size_t>(count));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<std::string> axesOf(const std::string& effect, bool severalMedia)
{
  static const std::map<std::string, std::vector<std::string>> known = { { "dark_offset",
                                                                           { "channel", "level" } },
    { "exposure_gain", { "level" } }, { "channel_gain", { "channel" } },
    { "illuminant_drift", { "channel" } }, { "detector_nonlinearity", { "level" } },
    { "saturation", { "level" } }, { "channel_crosstalk", { "spectral_shape" } },
    { "filter_shift", { "spectral_shape", "channel" } },
    { "filter_bandwidth", { "spectral_shape" } },
    { "filter_leak", { "spectral_shape", "level", "channel" } },
    { "veiling_glare", { "channel", "scene", "level" } }, { "local_stray_light", { "position" } },
    { "vignetting", { "position" } }, { "illumination_gradient", { "position" } },
    { "session_drift", { "order" } } };
  const auto found = known.find(effect);
  if (found != known.end())
  {
    return found->second;
  }
  return severalMedia ? std::vector<std::string>{ "medium" }
                      : std::vector<std::string>{ "level", "channel", "spectral_shape" };
}

double rmsDifference(
  const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b)
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t k = 0; k < a[i].size(); ++k)
    {
      sum += std::pow(a[i][k] - b[i][k], 2);
      count += 1.0;
    }
  }
  return std::sqrt(sum / count);
}

namespace
{
std::ofstream open(const std::filesystem::path& path)
{
  std::ofstream file(path, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("cannot write " + path.string());
  }
  file.precision(7);
  return file;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ";") + word;
  }
  return text;
}

void writeRow(std::ofstream& file, const std::vector<double>& values)
{
  for (const double value : values)
  {
    file << ',' << value;
  }
  file << '\n';
}

void writeChannels(std::ofstream& file, const char* first, std::size_t channels)
{
  file << first;
  for (std::size_t k = 0; k < channels; ++k)
  {
    file << ",C" << k + 1;
  }
  file << '\n';
}
}

CaseWriter::CaseWriter(std::string folder, const std::string& keyFile)
  : Folder(std::move(folder))
{
  std::filesystem::create_directories(Folder);
  Cases = open(std::filesystem::path(Folder) / "cases.csv");
  Keys = open(keyFile);
  Cases << "case,without\n";
  Keys << "case,set,effects,kinds,axes,gap_rms,best_shrink,without,twin\n";
}

std::string CaseWriter::enter(const Key& key)
{
  const std::string name = "case-" + std::to_string(1001 + Count++);
  Cases << name << ',' << key.without << std::endl;
  Keys << name << ',' << key.set << ',' << joined(key.effects) << ',' << joined(key.kinds) << ','
       << joined(key.axes) << ',' << key.gapRms << ',' << key.bestShrink << ',' << key.without
       << ',' << key.twin << std::endl;
  std::filesystem::create_directories(std::filesystem::path(Folder) / name);
  return name;
}

std::string CaseWriter::add(const Capture& capture, const Key& key)
{
  const std::string name = enter(key);
  const std::filesystem::path place = std::filesystem::path(Folder) / name;
  const std::size_t channels = capture.dark.size();
  std::ofstream json = open(place / "capture.json");
  json << R"({"name": ")" << name << R"(", "white_level": 65535, "dark": [)";
  for (std::size_t k = 0; k < channels; ++k)
  {
    json << (k > 0 ? ", " : "") << capture.dark[k];
  }
  json << R"(], "noise": {"read": )";
  if (capture.noiseKnown)
  {
    json << capture.read << R"(, "shot": )" << capture.shot;
  }
  else
  {
    json << R"(null, "shot": null)";
  }
  json << "}}\n";

  std::ofstream camera = open(place / "camera.csv");
  writeChannels(camera, "wavelength", channels);
  for (std::size_t w = 0; w < capture.camera.size(); ++w)
  {
    camera << capture.cameraWavelengths[w];
    writeRow(camera, capture.camera[w]);
  }

  std::ofstream samples = open(place / "samples.csv");
  samples << "sample,medium,scene,x,y,order";
  for (const double nm : capture.sampleWavelengths)
  {
    samples << ",R" << nm;
  }
  samples << '\n';
  for (std::size_t i = 0; i < capture.samples.size(); ++i)
  {
    const Sample& sample = capture.samples[i];
    samples << "s" << i + 1 << ',' << sample.medium << ',' << sample.scene << ',' << sample.x << ','
            << sample.y << ',' << sample.order;
    writeRow(samples, sample.reflectance);
  }

  std::ofstream responses = open(place / "responses.csv");
  writeChannels(responses, "sample,repeat", channels);
  const auto repeats = static_cast<std::size_t>(capture.repeats);
  for (std::size_t j = 0; j < capture.readings.size(); ++j)
  {
    responses << 's' << j / repeats + 1 << ',' << j % repeats + 1;
    writeRow(responses, capture.readings[j]);
  }
  return name;
}

std::string CaseWriter::add(const ImagePair& pair, const Key& key)
{
  const std::string name = enter(key);
  std::ofstream file = open(std::filesystem::path(Folder) / name / "pair.bin");
  const auto put = [&file](const void* data, std::size_t bytes)
  { file.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes)); };
  const int header[4] = { pair.width, pair.height, pair.channels, pair.labels.empty() ? 0 : 1 };
  put(header, sizeof(header));
  put(pair.real.data(), pair.real.size() * sizeof(float));
  put(pair.simulated.data(), pair.simulated.size() * sizeof(float));
  put(pair.labels.data(), pair.labels.size() * sizeof(int));
  return name;
}

} // namespace withheld
