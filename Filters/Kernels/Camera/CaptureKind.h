// Kinds of captures that tell effects from each other. The next capture is recommended by this name; Gap/Samples/NextCapture says
// what a table would show of it.
#pragma once

namespace msi
{

struct CaptureKind
{
  const char* name;
  double minutes = 10.0; // of work, getting ready for it left out: an estimate
};

namespace Captures
{
inline constexpr CaptureKind LensCap{ "lens cap", 1.0 };
inline constexpr CaptureKind RepeatedWhite{ "repeated white", 2.0 };
inline constexpr CaptureKind FlatField{ "flat field", 3.0 };
inline constexpr CaptureKind ExposureSeries{ "exposure series of one patch", 5.0 };
inline constexpr CaptureKind BlackTrap{ "black trap, second scene", 5.0 };
inline constexpr CaptureKind TurnedChart{ "chart rotated by 180 degrees", 5.0 };
inline constexpr CaptureKind BlackAndWhite{ "patch with black and with white surround", 5.0 };
inline constexpr CaptureKind InterleavedWhite{ "interleaved white", 5.0 };
inline constexpr CaptureKind LampSpectrum{ "lamp spectrum, white tile", 5.0 };
inline constexpr CaptureKind NarrowBands{ "narrow-band source", 30.0 };
inline constexpr CaptureKind Monochromator{ "monochromator", 60.0 };
}

} // namespace msi
