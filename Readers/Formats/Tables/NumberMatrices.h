// Reflectance and responses as bare matrices, as many public data sets are stored.
#pragma once

#include "Formats/SampleTable.h"
#include "Formats/Text/TextTable.h"

#include <string>

namespace msi
{

// A matrix as it lies in its file, and what to call it in messages.
struct NumberMatrix
{
  std::string file;
  std::string name; // of the variable; empty for a text file
  Eigen::MatrixXd values;
};

NumberMatrix numberMatrixFromText(const TextTable& table);

// Turns both matrices so that samples are columns. The side of the reflectance that is as long as the
// wavelengths is the spectral one; of the responses, the side as long as the samples is theirs. Which
// way they lay, and which wavelengths were assumed, is noted.
// Errors: FormatError naming both numbers where no side fits. 'responses' may have no values.
SampleTable samplesFromMatrices(const NumberMatrix& reflectance, const NumberMatrix& responses,
  const SampleTableOptions& options);

} // namespace msi
