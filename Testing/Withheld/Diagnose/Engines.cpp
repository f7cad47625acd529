#include "Engines.h"

#include "Kernels/Gap/Field/FieldGap.h"

namespace withheld
{

const std::map<std::string, Engine>& engines()
{
  static const std::map<std::string, Engine> known = {
    { "present",
      [](const CaseInput& input, const std::vector<std::string>& without) -> msi::GapReport
      {
        msi::GapOptions options;
        options.without = without;
        return input.capture ? *msi::diagnoseGap(*input.capture, options)
                             : msi::diagnoseField(input.pair(), options)->report;
      } },
  };
  return known;
}

} // namespace withheld
