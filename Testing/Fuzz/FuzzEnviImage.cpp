#include "FuzzTarget.h"

#include "Formats/SampleTable.h"
#include "Formats/SpectralImageFile.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include <unistd.h>

namespace
{
class PairOfFiles
{
public:
  PairOfFiles()
    : Folder(std::filesystem::temp_directory_path() / ("fuzz-envi-" + std::to_string(::getpid())))
  {
    std::filesystem::create_directories(Folder);
  }
  ~PairOfFiles()
  {
    std::error_code ignored;
    std::filesystem::remove_all(Folder, ignored);
  }
  PairOfFiles(const PairOfFiles&) = delete;
  PairOfFiles& operator=(const PairOfFiles&) = delete;

  std::string write(const char* name, const std::string& bytes) const
  {
    const std::filesystem::path path = Folder / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }

private:
  std::filesystem::path Folder;
};

void readEverything(const msi::SpectralImageFile& file)
{
  const msi::SpectralImageInfo& info = file.info();
  require(info.wavelengths.empty() || info.wavelengths.size() == info.bandNames.size());
  constexpr std::size_t MostValues = 1 << 20;
  const std::size_t perRow =
    static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.bands());
  if (perRow <= MostValues)
  {
    std::vector<float> row(perRow);
    for (int y = 0; y < std::min(info.height, 4); ++y)
    {
      file.readBlock({ 0, info.width, y, y + 1 }, {}, row.data());
    }
  }
}
}

// Header and samples with a zero byte between them, as an image and as a spectral library.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const PairOfFiles files;
  const std::string text = textOf(data, size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string header = files.write("a.hdr", text.substr(0, end));
  files.write("a.img", text.substr(std::min(end + 1, text.size())));
  parseOrRefuse([&] { readEverything(*msi::openSpectralImage(header)); });
  parseOrRefuse([&] { msi::readSampleTable(header); });
  return 0;
}
