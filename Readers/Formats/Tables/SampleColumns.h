// From a table of text with a header to samples.
#pragma once

#include "Formats/SampleTable.h"
#include "Formats/Text/TextTable.h"

namespace msi
{

// A table of something else than samples that is kept in a file as they are: "wavelength" (or "channel") and columns of
// camera channels, which is a transform or a camera, or "matrix", "row", "column", "value", which is a transfer model.
bool isTransform(const TextTable& table);

// table.rows[0] is the header. Of a transform all but the channels is metadata. Every reflectance and response cell must be a finite number.
// Errors: FormatError naming line, column and the column's name.
SampleTable samplesFromText(const TextTable& table, ReflectanceUnit unit);

// Throws FormatError naming the first row whose cells are not as many as the header's.
void requireRectangular(const TextTable& table);

// The finite number in a cell, or FormatError naming the cell's column.
double requireNumber(
  const TextTable& table, const TextCell& cell, std::string_view columnName, const char* kind);

// True when the first row holds numbers only, and they are not wavelengths of columns.
bool isHeaderless(const TextTable& table);

} // namespace msi
