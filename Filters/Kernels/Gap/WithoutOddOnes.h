// A diagnosis without samples or blocks of pixels that fit nothing.
#pragma once

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/GapReport.h"

#include <string>
#include <utility>
#include <vector>

namespace msi
{

// Where something unknown is more likely than not, the diagnosis is done again without those that are odd, until none are; that
// counts where it makes something unknown half as likely.
//   diagnose(odd, unlessOdd): without `odd`, too, which is then what is odd after it. With unlessOdd its result is empty where some
//   are. Where it was stopped both are empty.
//   reportOf(result): its report. mixedUp(): whether all is in disorder.
//   note(): what is said of all that are left out, where without them there is no gap.
template <typename Diagnose, typename ReportOf, typename MixedUp, typename Note>
auto diagnoseWithoutOdd(const Diagnose& diagnose, const ReportOf& reportOf, const MixedUp& mixedUp,
  const Note& note) -> decltype(diagnose(std::declval<IndexList&>(), false))
{
  IndexList odd;
  auto all = diagnose(odd, false);
  const auto unknown = [&](auto& result) { return reportOf(*result).probabilityOf("unknown"); };
  if (!all || odd.empty() || unknown(all) <= 0.5 || mixedUp())
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
  return unknown(others) < 0.5 * unknown(all) ? std::move(others) : std::move(all);
}

} // namespace msi
