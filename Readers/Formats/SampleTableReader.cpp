#include "Formats/SampleTable.h"

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Tables/ArraySamples.h"
#include "Formats/Tables/CgatsTable.h"
#include "Formats/Tables/CurveColumns.h"
#include "Formats/Tables/CxfTable.h"
#include "Formats/Tables/EnviLibrary.h"
#include "Formats/Tables/NumberMatrices.h"
#include "Formats/Tables/ReflectanceScale.h"
#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/DelimitedText.h"

#include <utility>

namespace msi
{

namespace
{
const char* const Expected = "a sample table (CSV, CGATS, CxF3 or MAT)";

SampleTable samplesFromCurves(Curves curves, ReflectanceUnit unit, const std::string& file)
{
  SampleTable table;
  table.metadata.push_back({ "sample", std::move(curves.names) });
  table.wavelengths = std::move(curves.wavelengths);
  table.reflectance = std::move(curves.values);
  table.notes = std::move(curves.notes);
  table.notes.emplace_back("the file has one row a wavelength: its columns were taken as samples");
  bringToFactor(table, unit, [&file](Eigen::Index) { return FilePlace{ file, 1, 0 }; });
  return table;
}

NumberMatrix readResponseMatrix(const std::string& path)
{
  if (path.empty())
  {
    return {};
  }
  const TextTable table = parseDelimitedText(path, readTextFile(path, "a matrix of responses"));
  if (!isHeaderless(table))
  {
    throw FormatError(table.place(table.rows[0][0]), "the response file has a header",
      "numbers only, beside a reflectance file of numbers only",
      "put reflectance and responses into one table with a header");
  }
  return numberMatrixFromText(table);
}
}

SampleTable readSampleTable(const std::string& path, const SampleTableOptions& options)
{
  if (const auto arrays = openArrayFile(path))
  {
    return samplesFromArrays(*arrays, options);
  }
  if (auto library = readEnviLibrary(path, options.unit))
  {
    return std::move(*library);
  }
  const std::string text = readTextFile(path, Expected);
  if (looksLikeCgats(text))
  {
    return samplesFromText(parseCgats(path, text), options.unit);
  }
  if (looksLikeXml(text))
  {
    return parseCxf(path, text, options.unit);
  }
  const TextTable table = parseDelimitedText(path, text);
  if (isHeaderless(table))
  {
    return samplesFromMatrices(
      numberMatrixFromText(table), readResponseMatrix(options.responseFile), options);
  }
  if (!options.responseFile.empty())
  {
    throw FormatError(table.place(table.rows[0][0]),
      "the table has a header, and a response file was given", "responses as columns C1, C2, ...",
      "leave the response file out, or give a reflectance matrix without a header");
  }
  if (isWavelengthHeader(table.rows[0][0].text) && !isTransform(table))
  {
    return samplesFromCurves(curvesFromText(table), options.unit, path);
  }
  return samplesFromText(table, options.unit);
}

} // namespace msi
