#include "FuzzTarget.h"

#include "Formats/Tables/CurveColumns.h"
#include "Formats/Text/DelimitedText.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse(
    [&]
    {
      const auto curves = msi::curvesFromText(msi::parseDelimitedText("f", textOf(data, size)));
      require(curves.values.rows() == curves.wavelengths.size());
      require(curves.values.cols() == static_cast<Eigen::Index>(curves.names.size()));
    });
  return 0;
}
