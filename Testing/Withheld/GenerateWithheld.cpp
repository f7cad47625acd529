// Writes withheld cases: GenerateWithheld FOLDER KEYFILE [fast|full] [seed]
// FOLDER/cases.csv lists the cases and the effects that may not be blamed; what was planted stands in KEYFILE alone.
#include "CaptureFolder.h"
#include "PlantedEffects.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

namespace
{
using namespace withheld;

struct Plan
{
  std::string set; // single, several, clean, stranger, removed, ...
  CaseRequest request;
  std::string without;
  int twin = -1; // the plan with the same capture and the whole library
};

std::string joined(const std::vector<std::string>& words, const char* separator)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : separator) + word;
  }
  return text;
}

std::string caseName(int number)
{
  return "case-" + std::to_string(1001 + number);
}

std::vector<std::string> someEffects(Random& random, int count)
{
  std::set<std::string> chosen;
  while (static_cast<int>(chosen.size()) < count)
  {
    const auto& names = plantableNames();
    chosen.insert(
      names[static_cast<std::size_t>(integer(random, 0, static_cast<int>(names.size()) - 1))]);
  }
  return { chosen.begin(), chosen.end() };
}

std::vector<Plan> plans(bool full, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Plan> list;
  const auto add = [&](const std::string& set, CaseRequest request, const std::string& without = {})
  {
    request.seed = random();
    list.push_back({ set, std::move(request), without });
  };
  const auto singles =
    [&](const std::string& set, int each, double strength, int samples, bool errors)
  {
    for (const std::string& name : plantableNames())
    {
      for (int n = 0; n < each && (!errors || name != "excess_noise"); ++n)
      {
        CaseRequest request;
        request.effects = { name };
        request.strength = strength;
        request.samples = samples;
        request.nominalErrors = errors;
        add(set, request);
      }
    }
  };
  singles("single", full ? 4 : 1, 1.0, 200, false);
  for (int n = 0; n < (full ? 40 : 4); ++n)
  {
    CaseRequest request;
    request.effects = someEffects(random, n % 3 == 2 ? 3 : 2);
    add("several", request);
  }
  for (int n = 0; n < (full ? 40 : 6); ++n)
  {
    add("clean", CaseRequest{});
  }
  for (int n = 0; n < (full ? 21 : 3); ++n)
  {
    CaseRequest request;
    request.stranger = strangerNames()[static_cast<std::size_t>(n) % strangerNames().size()];
    add("stranger", request);
  }
  // The first single cases again, without what was planted.
  const int each = full ? 4 : 1;
  for (std::size_t e = 0; e < plantableNames().size(); ++e)
  {
    for (int n = 0; n < (full ? 2 : (e % 4 == 1 ? 1 : 0)); ++n)
    {
      const int twin = static_cast<int>(e) * each + n;
      list.push_back(
        { "removed", list[static_cast<std::size_t>(twin)].request, plantableNames()[e], twin });
    }
  }
  singles("nominal", full ? 2 : 0, 1.0, 200, true);
  for (int n = 0; n < (full ? 20 : 0); ++n)
  {
    CaseRequest request;
    request.effects = someEffects(random, 2);
    request.nominalErrors = true;
    add("nominal several", request);
  }
  singles("third", full ? 2 : 0, 1.0 / 3.0, 200, false);
  singles("few", full ? 2 : 0, 1.0, 44, false);
  return list;
}
}

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: GenerateWithheld FOLDER KEYFILE [fast|full] [seed]\n";
    return 2;
  }
  const bool full = argc > 3 && std::string(argv[3]) == "full";
  const std::uint64_t seed = argc > 4 ? std::stoull(argv[4]) : 2024;
  const std::filesystem::path folder(argv[1]);
  std::filesystem::create_directories(folder);
  std::ofstream cases(folder / "cases.csv");
  std::ofstream key(argv[2]);
  if (!cases || !key)
  {
    std::cerr << "cannot write " << (cases ? argv[2] : argv[1]) << '\n';
    return 1;
  }
  cases << "case,without\n";
  key << "case,set,effects,kinds,axes,gap_rms,best_shrink,without,twin\n";
  int number = 0;
  for (const Plan& plan : plans(full, seed))
  {
    const std::string name = caseName(number++);
    const WithheldCase made = makeCase(plan.request);
    writeCapture(made.capture, name, (folder / name).string());
    cases << name << ',' << plan.without << '\n';
    std::vector<std::string> axes;
    for (const auto& list : made.key.axes)
    {
      axes.insert(axes.end(), list.begin(), list.end());
    }
    key << name << ',' << plan.set << ',' << joined(made.key.effects, ";") << ','
        << joined(made.key.kinds, ";") << ',' << joined(axes, ";") << ',' << made.key.gapRms << ','
        << made.key.bestShrink << ',' << plan.without << ','
        << (plan.twin < 0 ? "" : caseName(plan.twin)) << '\n';
  }
  std::cout << number << " cases in " << argv[1] << '\n';
  return 0;
}
