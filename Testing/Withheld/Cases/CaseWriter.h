// Writes cases for the diagnosis and, apart, their key for the scorer.
#pragma once

#include "Case.h"

#include <fstream>
#include <random>
#include <string>

namespace withheld
{

using Random = std::mt19937_64;
double uniform(Random& random, double low, double high);
double normal(Random& random, double deviation);
int integer(Random& random, int low, int high); // both included
bool chance(Random& random, double probability);

// From 1/factor to factor times `middle`, evenly in the logarithm.
double around(Random& random, double middle, double factor);

// `count` different ones.
std::vector<std::string> someOf(Random& random, const std::vector<std::string>& names, int count);

// The axes along which the gap of an effect may lie first, alone.
std::vector<std::string> axesOf(const std::string& effect, bool severalMedia);

double rmsDifference(
  const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b);

// FOLDER/cases.csv lists the cases and the effects that may not be blamed; what was planted stands in the key alone.
// Errors: std::runtime_error where a file cannot be written.
class CaseWriter
{
public:
  CaseWriter(std::string folder, const std::string& keyFile);

  // The case's name.
  std::string add(const Capture& capture, const Key& key);
  std::string add(const ImagePair& pair, const Key& key);
  int count() const noexcept { return Count; }

private:
  std::string enter(const Key& key); // makes the case's folder

  std::string Folder;
  std::ofstream Cases, Keys;
  int Count = 0;
};

} // namespace withheld
