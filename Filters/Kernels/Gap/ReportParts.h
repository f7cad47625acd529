// What the reports on tables and on images have in common.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <string>
#include <vector>

namespace msi
{

// Takes the causes into the report, and what none of them explains; the sum of their shares. Those that get less than 3 %
// of what all get are no causes: their effects go to GapReport::uncredited.
double creditCauses(GapReport& report, std::vector<GapCause> causes);

// Says which effects the corrected simulator has although they are not believed to be causes.
void noteUncredited(std::vector<std::string>& notes, const std::vector<std::string>& effects);

// An effect in the place of another, and what that costs.
struct Rival
{
  std::string effect;
  double cost;
};
// The cheapest two, by name.
std::vector<std::string> cheapestOf(std::vector<Rival> rivals);

// The capture that separates the first cause with equivalents from those.
void recommendCapture(GapReport& report);

// The first axis and its worst cell.
std::string whereIs(const std::vector<GapAxis>& axes);

} // namespace msi
