// Reading 2048 x 2048 x 16 uint16 from the page cache into the pipeline's layout (float, pixel after pixel) on one core,
// beside a plain copy of the same number of bytes in memory.
#include "Formats/SpectralImageFile.h"
#include "Formats/SpectralImageWriter.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace
{
namespace fs = std::filesystem;

constexpr int Side = 2048;
constexpr int Bands = 16;
constexpr std::size_t Values = std::size_t{ Side } * Side * Bands;

// Files of one image in all layouts and byte orders, in a folder that is gone with the program.
class Files
{
public:
  Files()
    : Folder(fs::temp_directory_path() / ("multispectral-bench-" + std::to_string(::getpid())))
  {
    fs::create_directories(Folder);
    msi::SpectralImageInfo info;
    info.width = info.height = Side;
    info.bandNames.resize(Bands, "band");
    std::vector<float> rows(Values / Side);
    const std::pair<msi::Interleave, const char*> layouts[] = { { msi::Interleave::BSQ, "bsq" },
      { msi::Interleave::BIL, "bil" }, { msi::Interleave::BIP, "bip" } };
    for (const auto& [interleave, name] : layouts)
    {
      for (const auto order : { msi::ByteOrder::Little, msi::ByteOrder::Big })
      {
        msi::EnviWriteOptions options{ interleave, msi::SampleType::UInt16, order };
        const auto writer = msi::createEnviImage(path(name, order), info, options);
        for (int y = 0; y < Side; ++y)
        {
          for (std::size_t i = 0; i < rows.size(); ++i)
          {
            rows[i] = static_cast<float>((i * 31 + static_cast<std::size_t>(y) * 17) % 4096);
          }
          writer->writeRows(1, rows.data());
        }
        writer->finish();
      }
    }
  }
  ~Files() { fs::remove_all(Folder); }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  std::string path(const std::string& layout, msi::ByteOrder order) const
  {
    return (Folder / (layout + (order == msi::ByteOrder::Little ? "-native" : "-swapped") + ".img"))
      .string();
  }

private:
  fs::path Folder;
};

const Files& files()
{
  static const Files all;
  return all;
}

void readImage(benchmark::State& state, const char* layout, msi::ByteOrder order)
{
  const auto path = files().path(layout, order);
  std::vector<float> pixels(Values, 1.0F);
  for (auto _ : state)
  {
    const auto image = msi::openSpectralImage(path);
    image->readBlock({ 0, Side, 0, Side }, {}, pixels.data());
    benchmark::DoNotOptimize(pixels.data());
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(Values * sizeof(float)));
}

void copyMemory(benchmark::State& state)
{
  const std::vector<float> from(Values, 2.0F);
  std::vector<float> to(Values, 1.0F);
  for (auto _ : state)
  {
    std::memcpy(to.data(), from.data(), Values * sizeof(float));
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(Values * sizeof(float)));
}

BENCHMARK(copyMemory)->Name("image/memcpy")->Unit(benchmark::kMillisecond);
#define READ_IMAGE(layout, order, name)                                                            \
  BENCHMARK_CAPTURE(readImage, name, layout, msi::ByteOrder::order)                                \
    ->Name("image/" #name)                                                                         \
    ->Unit(benchmark::kMillisecond)
READ_IMAGE("bsq", Little, BSQ);
READ_IMAGE("bil", Little, BIL);
READ_IMAGE("bip", Little, BIP);
READ_IMAGE("bsq", Big, BSQ_swapped);
READ_IMAGE("bil", Big, BIL_swapped);
READ_IMAGE("bip", Big, BIP_swapped);
}
