// The one place where the judges meet a diagnosis: what it is given and what it says. Another diagnosis is judged by a line in
// engines().
#pragma once

#include "CaseInput.h"

#include "Kernels/Gap/GapReport.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace withheld
{

// without: effects that may not be blamed.
using Engine =
  std::function<msi::GapReport(const CaseInput& input, const std::vector<std::string>& without)>;

// By name; "present" is the project's.
const std::map<std::string, Engine>& engines();

} // namespace withheld
