// Writes withheld cases: GenerateWithheld GENERATOR FOLDER KEYFILE [small|full] [SEED]
#include "Bench/BenchCase.h"
#include "Cases/CaseWriter.h"
#include "Images/ImageCase.h"
#include "Second/SecondCase.h"

#ifdef MULTISPECTRAL_HAS_FORMATS
#include "Real/RealCase.h"
#endif

#include <exception>
#include <iostream>
#include <map>

int main(int argc, char** argv)
{
  using namespace withheld;
  const std::map<std::string, void (*)(CaseWriter&, bool, std::uint64_t)> generators = {
    { "bench", writeBenchCases },
    { "second", writeSecondCases },
    { "images", writeImageCases },
    { "developed", writeDevelopedImageCases },
    { "spotted", writeSpottedImageCases },
#ifdef MULTISPECTRAL_HAS_FORMATS
    { "raw", writeRawCases },
    { "linearised", writeLinearisedCases },
    { "careless", writeCarelessCases },
    { "ridge", writeRidgeCases },
    { "chart", writeChartCases },
#endif
  };
  const auto generator = generators.find(argc > 1 ? argv[1] : "");
  if (argc < 4 || generator == generators.end())
  {
    std::cerr << "usage: GenerateWithheld GENERATOR FOLDER KEYFILE [small|full] [SEED]\nGENERATOR:";
    for (const auto& one : generators)
    {
      std::cerr << ' ' << one.first;
    }
    std::cerr << '\n';
    return 2;
  }
  try
  {
    CaseWriter writer(argv[2], argv[3]);
    generator->second(
      writer, argc > 4 && std::string(argv[4]) == "full", argc > 5 ? std::stoull(argv[5]) : 2024);
    std::cout << writer.count() << " cases in " << argv[2] << '\n';
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
