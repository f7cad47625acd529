// The color maps with which ParaView first shows the arrays of this plugin.
#ifndef SpectralColorMaps_h
#define SpectralColorMaps_h

namespace msi
{

// Registers them as settings by array name, below those of the user:
// color differences: perceptually uniform (viridis), fixed from 0 to 5 with equal steps of color at 0, 1, 2, 3 and 5;
// spectral rms and uncertainty: viridis; signed differences: diverging;
// spectra: one band, not the magnitude over all bands, which is no physical quantity. NaN is gray everywhere.
void registerColorMaps();

} // namespace msi

#endif
