// Reads and writes images for EnviRoundTrip.py and ArrayFiles.py, which compare them with other programs.
//
//   FormatJobs JOBS   where each line of the file JOBS is one of
//   read IMAGE RAW                                      doubles, band interleaved by pixel
//   write RAW IMAGE SAMPLES LINES BANDS INTERLEAVE TYPE ORDER
//   describe IMAGE TEXT                                 the wavelengths, or the error
#include "Formats/SpectralImageFile.h"
#include "Formats/SpectralImageWriter.h"

#include <exception>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace
{

const std::map<std::string, msi::SampleType> Types = { { "uint8", msi::SampleType::UInt8 },
  { "int16", msi::SampleType::Int16 }, { "int32", msi::SampleType::Int32 },
  { "float32", msi::SampleType::Float32 }, { "float64", msi::SampleType::Float64 },
  { "uint16", msi::SampleType::UInt16 }, { "uint32", msi::SampleType::UInt32 },
  { "int64", msi::SampleType::Int64 }, { "uint64", msi::SampleType::UInt64 } };
const std::map<std::string, msi::Interleave> Interleaves = { { "bsq", msi::Interleave::BSQ },
  { "bil", msi::Interleave::BIL }, { "bip", msi::Interleave::BIP } };

void readImage(std::istringstream& job)
{
  std::string image;
  std::string raw;
  job >> image >> raw;
  const auto file = msi::openSpectralImage(image);
  const auto& info = file->info();
  std::ofstream out(raw, std::ios::binary);
  std::vector<double> row(
    static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.bands()));
  for (int y = 0; y < info.height; ++y)
  {
    file->readBlock({ 0, info.width, y, y + 1 }, {}, row.data());
    out.write(reinterpret_cast<const char*>(row.data()),
      static_cast<std::streamsize>(row.size() * sizeof(double)));
  }
}

void describeImage(std::istringstream& job)
{
  std::string image;
  std::string text;
  job >> image >> text;
  std::ofstream out(text);
  try
  {
    const auto file = msi::openSpectralImage(image);
    std::vector<double> pixel(static_cast<std::size_t>(file->info().bands()));
    file->readBlock({ 0, 1, 0, 1 }, {}, pixel.data());
    for (const double nm : file->info().wavelengths)
    {
      out << nm << ' ';
    }
  }
  catch (const std::exception& error)
  {
    out << error.what();
  }
}

void writeImage(std::istringstream& job)
{
  std::string raw;
  std::string image;
  std::string interleave;
  std::string type;
  int order = 0;
  int bands = 0;
  msi::SpectralImageInfo info;
  job >> raw >> image >> info.width >> info.height >> bands >> interleave >> type >> order;
  for (int b = 1; b <= bands; ++b)
  {
    info.bandNames.push_back("b" + std::to_string(b));
    info.wavelengths.push_back(400.0 + 12.5 * b);
  }
  std::ifstream in(raw, std::ios::binary);
  std::vector<double> row(static_cast<std::size_t>(info.width) * static_cast<std::size_t>(bands));
  const auto writer = msi::createEnviImage(image, info,
    { Interleaves.at(interleave), Types.at(type),
      order == 1 ? msi::ByteOrder::Big : msi::ByteOrder::Little });
  for (int y = 0; y < info.height; ++y)
  {
    in.read(reinterpret_cast<char*>(row.data()),
      static_cast<std::streamsize>(row.size() * sizeof(double)));
    writer->writeRows(1, row.data());
  }
  writer->finish();
}

}

int main(int argc, char** argv)
{
  try
  {
    std::ifstream jobs(argc == 2 ? argv[1] : "");
    for (std::string line; std::getline(jobs, line);)
    {
      std::istringstream job(line);
      std::string what;
      job >> what;
      what == "read" ? readImage(job) : what == "write" ? writeImage(job) : describeImage(job);
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
