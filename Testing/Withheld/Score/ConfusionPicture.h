// Planted against named, as a picture.
#pragma once

#include "CaseTable.h"

#include <string>
#include <vector>

namespace withheld
{

// SVG of the cases with one planted effect of the sets named, and of the clean and unknown ones: a row for what was
// planted, a column for the first cause; "nothing" where there is none, "unknown" where less than half of the gap has
// a cause. Errors: std::runtime_error where the file cannot be written.
void writeConfusionPicture(
  const std::vector<ScoredCase>& cases, const std::string& title, const std::string& path);

} // namespace withheld
