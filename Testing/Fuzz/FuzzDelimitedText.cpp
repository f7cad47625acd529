#include "FuzzTarget.h"

#include "Formats/Tables/NumberMatrices.h"
#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/DelimitedText.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  parseOrRefuse(
    [&]
    {
      const msi::TextTable table = msi::parseDelimitedText("f", textOf(data, size));
      require(!table.rows.empty());
      if (msi::isHeaderless(table))
      {
        msi::samplesFromMatrices(msi::numberMatrixFromText(table), {}, {});
      }
      else
      {
        const msi::SampleTable samples =
          msi::samplesFromText(table, msi::ReflectanceUnit::Recognize);
        require(samples.sampleCount() == static_cast<Eigen::Index>(table.rows.size()) - 1);
        require(samples.reflectance.array().isFinite().all());
      }
    });
  return 0;
}
