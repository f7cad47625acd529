// Runs a fuzz target without libFuzzer: every seed, then changed copies of the seeds from a fixed
// pseudo-random sequence. Any compiler builds it, and every run does the same.
//
//   FuzzXxx CHANGED_COPIES_PER_SEED FILE_OR_FOLDER...
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
using Bytes = std::vector<std::uint8_t>;
namespace fs = std::filesystem;

std::vector<Bytes> readSeeds(const std::string& folder)
{
  std::vector<fs::path> files;
  std::copy(fs::directory_iterator(folder), {}, std::back_inserter(files));
  std::sort(files.begin(), files.end());
  std::vector<Bytes> seeds;
  for (const fs::path& file : files)
  {
    std::ifstream in(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Mutator
{
public:
  explicit Mutator(const std::vector<Bytes>& seeds)
    : Seeds(seeds)
  {
  }

  Bytes changed(Bytes bytes)
  {
    for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times)
    {
      const auto at = static_cast<std::ptrdiff_t>(below(bytes.size()));
      switch (below(6))
      {
        case 0: // one bit
          bytes[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1u << below(8));
          break;
        case 1: // any byte
          bytes[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(below(256));
          break;
        case 2: // a byte that means something somewhere
          bytes.insert(
            bytes.begin() + at, static_cast<std::uint8_t>("\",;{}=<>\n\t\0-9.\xFF#"[below(17)]));
          break;
        case 3: // cut off
          bytes.resize(static_cast<std::size_t>(at));
          break;
        case 4: // leave out
          bytes.erase(bytes.begin() + at,
            bytes.begin() + at +
              static_cast<std::ptrdiff_t>(
                below(std::min<std::size_t>(16, bytes.size() - static_cast<std::size_t>(at)) + 1)));
          break;
        default: // a piece of another seed
          insertPiece(bytes, at);
      }
    }
    return bytes;
  }

private:
  void insertPiece(Bytes& bytes, std::ptrdiff_t at)
  {
    const Bytes& other = Seeds[below(Seeds.size())];
    if (!other.empty())
    {
      const std::size_t from = below(other.size());
      const std::size_t length = below(std::min<std::size_t>(64, other.size() - from) + 1);
      const auto begin = other.begin() + static_cast<std::ptrdiff_t>(from);
      bytes.insert(bytes.begin() + at, begin, begin + static_cast<std::ptrdiff_t>(length));
    }
  }

  // Not std::uniform_int_distribution, whose sequence is the library's choice.
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(Random() % end); }

  const std::vector<Bytes>& Seeds;
  std::mt19937_64 Random{ 20230123 };
};
}

int main(int argc, char** argv)
{
  if (argc != 3)
  {
    std::cerr << "usage: " << argv[0] << " CHANGED_COPIES_PER_SEED FOLDER_OF_SEEDS\n";
    return 2;
  }
  const std::vector<Bytes> seeds = readSeeds(argv[2]);
  const long copies = std::strtol(argv[1], nullptr, 10);
  Mutator mutator(seeds);
  std::size_t runs = 0;
  for (const Bytes& seed : seeds)
  {
    LLVMFuzzerTestOneInput(seed.data(), seed.size());
    ++runs;
    for (long copy = 0; copy < copies; ++copy, ++runs)
    {
      const Bytes bytes = mutator.changed(seed);
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
  }
  std::cout << seeds.size() << " seeds, " << runs << " runs\n";
  return seeds.empty() ? 1 : 0;
}
