// What the metadata of one page of an image say about its bands.
#pragma once

#include <OpenImageIO/imageio.h>

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// nm of a page with one band: "wavelength" in any case, a number or a text such as "450 nm"; else "450
// nm" in a description or page name.
std::optional<double> metadataWavelength(const OIIO::ImageSpec& spec);

// "wavelengths" = "400, 410, ..." in any case; else such a list in the description, as {"wavelengths": [400, 410]}. Empty
// where there is none.
std::vector<double> metadataWavelengths(const OIIO::ImageSpec& spec);

// The name of the channel, or "channel3"; "Band 4" of a gray TIFF with several channels.
std::string channelName(const OIIO::ImageSpec& spec, int channel);

} // namespace msi
