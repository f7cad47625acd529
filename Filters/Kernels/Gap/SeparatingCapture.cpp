#include "Kernels/Gap/SeparatingCapture.h"

#include <utility>

namespace msi
{

std::string separatingCapture(std::string_view effect)
{
  static constexpr std::pair<std::string_view, const char*> captures[] = {
    { "dark_offset", "lens cap" },
    { "exposure_gain", "repeated white" },
    { "channel_gain", "grey ramp" },
    { "illuminant_drift", "lamp spectrum, white tile" },
    { "detector_nonlinearity", "exposure series of one patch" },
    { "saturation", "shorter exposure" },
    { "channel_crosstalk", "narrow-band source" },
    { "filter_shift", "chart at several field positions, lamp spectrum" },
    { "filter_bandwidth", "monochromator" },
    { "filter_leak", "long-pass tile" },
    { "veiling_glare", "black trap, second scene" },
    { "local_stray_light", "patch with black and with white surround" },
    { "vignetting", "chart rotated by 180 degrees" },
    { "illumination_gradient", "flat field" },
    { "medium_gain", "rotated sample" },
    { "specular_component", "specular included and excluded measurement, black glossy tile" },
    { "interreflection", "flat and folded sample" },
    { "translucency", "layers over black and white backing" },
    { "fluorescence", "UV-cut filter" },
    { "session_drift", "interleaved white" },
    { "excess_noise", "more repeats" },
    { "misregistration", "grid target for each filter" },
    { "defocus", "grid target for each filter" },
    { "banding", "flat field at two exposure times" },
  };
  for (const auto& [name, capture] : captures)
  {
    if (name == effect)
    {
      return capture;
    }
  }
  return {};
}

} // namespace msi
