// A withheld case as the diagnosis wants it.
#pragma once

#include "Kernels/Gap/Field/FieldPair.h"
#include "Kernels/Gap/SimToRealGap.h"

#include <optional>
#include <string>
#include <vector>

namespace withheld
{

// A table of samples, or a pair of images.
struct CaseInput
{
  std::optional<msi::GapCapture> capture;
  msi::ImageExtent extent;
  std::vector<std::string> channels;
  std::vector<float> real, simulated;
  std::vector<int> labels;

  msi::FieldPair pair() const
  {
    return { extent, channels, real.data(), simulated.data(),
      labels.empty() ? nullptr : labels.data() };
  }
};

// Throws msi::FormatError, std::invalid_argument or std::runtime_error.
CaseInput readCase(const std::string& folder);

} // namespace withheld
