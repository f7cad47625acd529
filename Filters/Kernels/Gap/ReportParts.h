// What the reports on tables and on images have in common: figures, shares, axes along which a gap lies, verdicts, causes.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace msi
{

// The parts in a row, numbers with so many digits.
template <typename... Parts>
std::string textOf(int digits, const Parts&... parts)
{
  std::ostringstream text;
  text.precision(digits);
  (text << ... << parts);
  return text.str();
}

// Energies of the gap before, after, and what noise allows of them, in plain response units: a row for each group of data that are held
// out together (a sample, neighbouring blocks of an image).
using GroupEnergies = Eigen::ArrayX3d;

// 1 - sqrt(excess energy left / excess energy before) of all groups together, within [-1, 1]; 0 where there was none.
double shrinkOf(const GroupEnergies& energies);
// Over so many elements. seed: of the interval, which contains the shrink itself.
GapFigures figuresOf(const GroupEnergies& energies, double elements, std::uint64_t seed);
// 95 % interval of shrinkOf over bootstrap draws of the groups; {0, 0} without groups.
std::array<double, 2> shrinkInterval(const GroupEnergies& energies, std::uint64_t seed);

// Shapley values: value[subset] is what the players in the bits of `subset` achieve; 2^players values, of which
// value[0] is what none achieves. The values of all players sum to value[all] - value[0].
// Source: L. S. Shapley, "A value for n-person games", 1953, doi:10.1515/9781400881970-018.
std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players);

// Energies sorted into named cells.
class GapCells
{
public:
  void add(const std::string& cell, double energy)
  {
    Energy[cell] += energy;
    Total += energy;
  }
  // The five largest, of the sum.
  std::vector<GapCell> worst() const;

private:
  std::map<std::string, double> Energy;
  double Total = 0.0;
};

// "level 0.1..0.25"
std::string rangeText(const std::string& what, double low, double high, int digits = 3);
// Of parts of equal width between two ends that in which a value lies.
struct GapPart
{
  GapPart(double value, double from, double to, int parts) noexcept;
  std::string text(const std::string& what, int digits = 3) const
  {
    return rangeText(what, low, high, digits);
  }

  double low, high;
};

// Energies in five parts of equal size, from small to large values. pairs: value and energy.
GapCells fifths(std::vector<std::pair<double, double>> pairs, const std::string& name);

// The axes with a share, the largest first; shares that sum to more than 1 are scaled to do so.
std::vector<GapAxis> worthNaming(std::vector<GapAxis> axes);

// What is left unexplained, by the axes along which it lies.
GapRemainder remainderOf(double share, const std::vector<GapAxis>& axes);

// Errors: std::invalid_argument for the name of an effect that may not be blamed and that the library does not have.
void requireKnown(const std::vector<std::string>& without);

// Of a gap of which its causes explain this part of the size.
GapVerdict verdictOf(double explained) noexcept;

// The largest share first; but last what a linear fit leaves of a curve: it says how the simulated camera was made, not what has changed.
void sortCauses(std::vector<GapCause>& causes);

// Takes the causes into the report, and what none of them explains. Those that get less than Decision::LeastPart of what all get beside
// large gains are no causes, nor are numbers of single channels with less than Decision::LeastPartPerChannel, but for effects that need an image: their effects go to GapReport::uncredited. What a
// linear fit leaves of a curve is one where it partly explains the gap (Decision::PartlyShrink); every camera fitted as linear has some.
// inexact: part of the gap's size that large gains do not take away (FoundSets::inexactEnergy).
void creditCauses(GapReport& report, std::vector<GapCause> causes, double inexact);

// Takes the probabilities into the report and to its causes. Nothing is explained by what is probably something else.
void believe(GapReport& report, std::vector<std::pair<std::string, double>> probabilities);

// What the causes found leave in doubt: parameters at the end of their range, causes that show in few samples, a camera that was
// fitted as linear, effects of the corrected simulator that are not believed to be causes.
void noteDoubts(std::vector<std::string>& notes, const GapReport& report);

// An effect in the place of another, and what that costs.
struct Rival
{
  std::string effect;
  double cost;
};
// The cheapest two, by name.
std::vector<std::string> cheapestOf(std::vector<Rival> rivals);

} // namespace msi
