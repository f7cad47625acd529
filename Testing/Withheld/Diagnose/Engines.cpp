#include "Engines.h"

#include "Kernels/Gap/Field/FieldGap.h"
#include "Kernels/Gap/Samples/SampleDiagnosis.h"

#include <stdexcept>

namespace withheld
{

const std::map<std::string, Engine>& engines()
{
  static const std::map<std::string, Engine> known = {
    { "present",
      [](const CaseInput& input, const std::vector<std::string>& without) -> Answer
      {
        msi::GapOptions options;
        options.without = without;
        return { input.capture ? *msi::diagnoseGap(*input.capture, options)
                               : msi::diagnoseField(input.pair(), options)->report,
          {} };
      } },
    // By sets of effects and one criterion; tables only.
    { "one",
      [](const CaseInput& input, const std::vector<std::string>& without) -> Answer
      {
        if (!input.capture)
        {
          throw std::invalid_argument("the engine 'one' reads no image pairs; take 'present'");
        }
        msi::GapOptions options;
        options.without = without;
        const msi::GapReport report = *msi::diagnoseSamples(*input.capture, options);
        return { report, report.probabilities };
      } },
  };
  return known;
}

} // namespace withheld
