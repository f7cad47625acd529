// A diagnosis with one criterion, to be judged beside the project's: sets of effects by their marginal likelihood.
#pragma once

#include "Diagnose/Engines.h"

namespace withheld
{

// Tables of samples only; pairs of images go to the project's diagnosis.
Answer diagnoseByEvidence(const CaseInput& input, const std::vector<std::string>& without);

} // namespace withheld
