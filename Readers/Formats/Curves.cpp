#include "Formats/Curves.h"

#include "Formats/Storage/AtomicFile.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Tables/CurveColumns.h"
#include "Formats/Text/CsvText.h"
#include "Formats/Text/DelimitedText.h"
#include "Formats/Text/NumberText.h"

#include <cstddef>
#include <stdexcept>

namespace msi
{

Curves readCurves(const std::string& path)
{
  return curvesFromText(parseDelimitedText(path, readTextFile(path, "a table of curves")));
}

void writeCurves(const std::string& path, const Curves& curves)
{
  if (curves.values.rows() != curves.wavelengths.size() ||
    curves.values.cols() != static_cast<Eigen::Index>(curves.names.size()))
  {
    throw std::invalid_argument("curve values are " + std::to_string(curves.values.rows()) + " x " +
      std::to_string(curves.values.cols()) + "; expected " +
      std::to_string(curves.wavelengths.size()) + " wavelengths x " +
      std::to_string(curves.names.size()) + " names");
  }
  std::string text = "wavelength";
  for (const std::string& name : curves.names)
  {
    text += ',' + csvField(name);
  }
  text += '\n';
  for (Eigen::Index row = 0; row < curves.values.rows(); ++row)
  {
    text += numberText(curves.wavelengths[row]);
    for (Eigen::Index column = 0; column < curves.values.cols(); ++column)
    {
      text += ',' + numberText(curves.values(row, column));
    }
    text += '\n';
  }
  AtomicFile file(path);
  file.append(text);
  file.commit();
}

} // namespace msi
