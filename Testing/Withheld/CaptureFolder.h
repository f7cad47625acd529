// Withheld cases as files: captures in folders, the key apart from them.
#pragma once

#include "WithheldCase.h"

#include <string>

namespace withheld
{

// capture.json, camera.csv, samples.csv and responses.csv. Throws std::runtime_error naming the file.
void writeCapture(const CaseCapture& capture, const std::string& name, const std::string& folder);

} // namespace withheld
