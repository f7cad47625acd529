// The wavelengths that a file of arrays holds beside its data.
#pragma once

#include "Formats/Arrays/ArrayFile.h"

#include <string>
#include <vector>

namespace msi
{

// nm, from a vector named like wavelengths, lambda, wl or nm whose values are wavelengths (um become
// nm); empty where there is none, or more than one of different values. 'name' receives its name.
std::vector<double> findWavelengths(const ArrayFile& file, std::string& name);

} // namespace msi
