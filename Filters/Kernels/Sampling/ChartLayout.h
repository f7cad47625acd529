// Which place on a chart a row of its reference file belongs to.
#pragma once

#include <string>
#include <vector>

namespace msi
{

// The number of each sample's patch, from 1 along the first row.
//
// Names of a letter (or two) and a number, such as A1 .. F4 or A01 .. N10, say column and row where there are as many
// letters as columns and as many numbers as rows; they say row and column where it is the other way round. For a square
// chart letters are columns. All other names: samples follow one another along the rows.
// Errors: std::invalid_argument unless there are columns x rows names.
std::vector<int> patchNumbers(const std::vector<std::string>& names, int columns, int rows);

} // namespace msi
