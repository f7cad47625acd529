#include "CaptureFolder.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace withheld
{

namespace
{
std::ofstream open(const std::filesystem::path& path)
{
  std::ofstream file(path);
  if (!file)
  {
    throw std::runtime_error("cannot write " + path.string());
  }
  file.precision(7);
  return file;
}
}

void writeCapture(const CaseCapture& capture, const std::string& name, const std::string& folder)
{
  const std::filesystem::path place(folder);
  std::filesystem::create_directories(place);
  std::ofstream json = open(place / "capture.json");
  json << "{\"name\": \"" << name << "\", \"white_level\": 65535, \"dark\": [";
  for (std::size_t k = 0; k < capture.dark.size(); ++k)
  {
    json << (k > 0 ? ", " : "") << capture.dark[k];
  }
  json << "], \"noise\": {\"read\": ";
  if (capture.noiseKnown)
  {
    json << capture.read << ", \"shot\": " << capture.shot;
  }
  else
  {
    json << "null, \"shot\": null";
  }
  json << "}}\n";

  std::ofstream camera = open(place / "camera.csv");
  camera << "wavelength";
  for (std::size_t k = 0; k < capture.dark.size(); ++k)
  {
    camera << ",C" << k + 1;
  }
  camera << '\n';
  for (std::size_t w = 0; w < capture.camera.size(); ++w)
  {
    camera << capture.cameraWavelengths[w];
    for (const double value : capture.camera[w])
    {
      camera << ',' << value;
    }
    camera << '\n';
  }

  std::ofstream samples = open(place / "samples.csv");
  samples << "sample,medium,scene,x,y,order";
  for (const double nm : capture.sampleWavelengths)
  {
    samples << ",R" << nm;
  }
  samples << '\n';
  for (std::size_t i = 0; i < capture.patches.size(); ++i)
  {
    const Patch& patch = capture.patches[i];
    samples << "s" << i + 1 << ',' << capture.media[static_cast<std::size_t>(patch.medium)]
            << ",scene" << patch.scene + 1 << ',' << 100.0 + 80.0 * patch.column << ','
            << 80.0 + 80.0 * patch.row << ',' << patch.order;
    for (const double r : capture.reflectance[i])
    {
      samples << ',' << r;
    }
    samples << '\n';
  }

  std::ofstream responses = open(place / "responses.csv");
  responses << "sample,repeat";
  for (std::size_t k = 0; k < capture.dark.size(); ++k)
  {
    responses << ",C" << k + 1;
  }
  responses << '\n';
  const auto repeats = static_cast<std::size_t>(capture.repeats);
  for (std::size_t j = 0; j < capture.readings.size(); ++j)
  {
    responses << 's' << j / repeats + 1 << ',' << j % repeats + 1;
    for (const double value : capture.readings[j])
    {
      responses << ',' << value;
    }
    responses << '\n';
  }
}

} // namespace withheld
