// Effects that only an image shows; ImageSimulator treats them.
#include "Kernels/Camera/Effects/EffectEntry.h"

#include <string>

namespace msi
{

namespace
{
// Three sines of a period, each with amplitude and phase of its own in every channel.
std::vector<EffectParameter> harmonics(const char* unit, const char* kind)
{
  std::vector<EffectParameter> parameters = { { "amplitude", unit, 0.0, 0.0, 0.45, 0.01, kind,
                                                true },
    { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "one cycle", false, true },
    { "start", "cycle", 0.0, 0.0, 1.0, 0.1, "phase at pixel 0", true, true } };
  for (const char* number : { "2", "3" })
  {
    const std::string index = number;
    parameters.push_back({ "amplitude_" + index, unit, 0.0, 0.0, 0.45, 0.01,
      std::string(kind) + ", " + index + " cycles a period", true });
    parameters.push_back({ "start_" + index, "cycle", 0.0, 0.0, 1.0, 0.1,
      "phase at pixel 0, " + index + " cycles a period", true, true });
  }
  return parameters;
}
}

std::vector<EffectEntry> imageEffects()
{
  const std::vector<EffectParameter> stripes = { { "amplitude", "1", 0.0, 0.0, 0.45, 0.01,
                                                   "relative", true },
    { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "one cycle", false, true },
    { "start", "cycle", 0.0, 0.0, 1.0, 0.1, "phase at pixel 0", true, true } };
  return {
    { { "misregistration", "Misregistration",
      "The channels' images do not lie on one another: filters of different thickness and wedge, "
      "chromatic "
      "difference of magnification.",
      EffectStage::Image, EffectNeed::Nothing,
      { { "per_channel",
        "every channel is turned and magnified about the middle of the field, then displaced",
        { { "right", "pixels", 0.0, -20.0, 20.0, 0.5, "displacement in x", true },
          { "down", "pixels", 0.0, -20.0, 20.0, 0.5, "displacement in y", true },
          { "magnification", "1", 0.0, -0.02, 0.02, 0.001, "relative growth of the image", true },
          { "rotation", "degrees", 0.0, -5.0, 5.0, 0.1,
            "turn from the axis x towards the axis y of the image", true } } } } } },
    { { "defocus", "Defocus",
      "Each filter moves the focus: the channel's image is convolved with a Gaussian.",
      EffectStage::Image, EffectNeed::Nothing,
      { { "common", "one blur for all channels",
          { { "blur", "pixels", 0.0, 0.0, 8.0, 0.5, "standard deviation" } } },
        { "per_channel", "a blur for each channel",
          { { "blur", "pixels", 0.0, 0.0, 8.0, 0.5, "standard deviation", true } } } } } },
    { { "lag", "Lag", "A detector keeps a part of the exposure before: that of the channel before.",
      EffectStage::Image, EffectNeed::Nothing,
      { { "common", "u_k + retained u_k-1",
        { { "retained", "1", 0.0, 0.0, 0.3, 0.01, "share of the exposure before" } } } } } },
    { { "banding", "Banding",
      "A gain or an offset that changes from row to row or column to column: flicker, readout.",
      EffectStage::Image, EffectNeed::Nothing,
      { { "sine", "u (1 + amplitude sin(2 pi (row / period + phase k)))",
          { { "amplitude", "1", 0.0, 0.0, 0.3, 0.01, "relative" },
            { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "rows of one cycle", false, true },
            { "phase", "cycle", 0.25, 0.0, 1.0, 0.1, "advance from channel to channel", false,
              true } } },
        { "rows", "u (1 + amplitude_k sin(2 pi (row / period + start_k)))", stripes },
        { "columns", "u (1 + amplitude_k sin(2 pi (column / period + start_k)))", stripes },
        { "row_harmonics",
          "u (1 + sum over n = 1..3 of amplitude_nk sin(2 pi (n row / period + start_nk)))",
          harmonics("1", "relative") },
        { "column_harmonics", "the same with the column", harmonics("1", "relative") },
        { "row_offsets",
          "u + sum over n = 1..3 of amplitude_nk sin(2 pi (n row / period + start_nk))",
          harmonics("white", "of white") },
        { "column_offsets", "the same with the column", harmonics("white", "of white") } } } },
  };
}

} // namespace msi
