// A diagnosis without samples or blocks of pixels that fit nothing.
#pragma once

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/GapReport.h"

#include <string>
#include <utility>
#include <vector>

namespace msi
{

// Where the gap is not explained, the diagnosis is done again without those that are odd, until none are; that counts where the odds
// of something unknown fall to less than half.
//   diagnose(odd, unlessOdd): without `odd`, too, which is then what is odd after it. With unlessOdd its result is empty where some
//   are. Where it was stopped both are empty.
//   reportOf(result): its report.
//   note(): what is said of all that are left out, where without them there is no gap.
template <typename Diagnose, typename ReportOf, typename Note>
auto diagnoseWithoutOdd(const Diagnose& diagnose, const ReportOf& reportOf, const Note& note)
  -> decltype(diagnose(std::declval<IndexList&>(), false))
{
  IndexList odd;
  auto all = diagnose(odd, false);
  const auto odds = [&](auto& result) // of something unknown
  {
    const double unknown = reportOf(*result).probabilityOf("unknown");
    return unknown / (1.0 - unknown);
  };
  if (!all || odd.empty() || reportOf(*all).verdict <= GapVerdict::Explained)
  {
    return all;
  }
  decltype(all) others;
  while (!odd.empty())
  {
    others = diagnose(odd, true);
  }
  if (!others)
  {
    return others;
  }
  if (reportOf(*others).verdict == GapVerdict::NoGap)
  {
    std::vector<std::string>& notes = reportOf(*all).notes;
    notes.insert(notes.begin(), note());
    return all;
  }
  return odds(others) < 0.5 * odds(all) ? std::move(others) : std::move(all);
}

} // namespace msi
