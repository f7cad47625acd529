// The figures of a set of withheld cases.
#pragma once

#include "CaseTable.h"

#include <string>
#include <vector>

namespace withheld
{

// A cause counts from this share of the gap on.
constexpr double NamedShare = 0.05;
// A wrong cause with this share or more, and this probability where one is told, is a false accusation.
constexpr double AccusedShare = 0.5;
constexpr double AccusedProbability = 0.5;

struct Figure
{
  std::string name;
  double value = 0.0;
  int cases = 0;
};

// Whether the first cause is the planted effect; with `withClass` also whether it is named equivalent to it.
bool firstIs(const ScoredCase& one, const std::string& effect, bool withClass);

// Whether a case of an effect that is not in the library, or was taken out of it, is called unknown and no wrong
// cause is given half of the gap. With `withClass` an effect is not wrong that the same capture's diagnosis with
// the whole library declares equivalent to the planted one.
bool unknownSaid(const ScoredCase& one, const std::vector<ScoredCase>& all, bool withClass);

// Figures of the sets that are there, in an order that is the same for all.
std::vector<Figure> figuresOf(const std::vector<ScoredCase>& cases);

// What went wrong, one line a case.
std::vector<std::string> failuresOf(const std::vector<ScoredCase>& cases);

} // namespace withheld
