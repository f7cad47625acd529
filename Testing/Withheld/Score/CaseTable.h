// What was planted and what the diagnosis said, case by case.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace withheld
{

struct NamedCause
{
  std::string effect;
  double share = 0.0;
  std::vector<std::string> equivalent;
  std::string form;
};

struct ScoredCase
{
  // From the key.
  std::string name;
  std::string set;                  // single, several, clean, stranger, removed, ...
  std::vector<std::string> planted; // "?" for an effect that the library does not have
  std::vector<std::string> kinds;
  std::vector<std::string> axes; // acceptable first axes
  double gapRms = 0.0;
  double bestShrink = 1.0;
  std::string without;
  std::string twin; // of a removed case: the same capture, diagnosed with the whole library
  // From the diagnosis.
  std::string verdict;
  std::string axis;
  std::vector<NamedCause> causes; // the largest share first
  double shrink = 0.0;
  double unexplained = 0.0;
  std::map<std::string, double> probabilities; // of effects, "nothing", "unknown"; empty: not told
  double seconds = 0.0;
};

// One row a case of the key, in its order.
// Errors: std::runtime_error naming the file and what is missing, also a case without a result.
std::vector<ScoredCase> readCases(const std::string& keyFile, const std::string& resultFile);

} // namespace withheld
