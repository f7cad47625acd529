// How ParaView first shows the arrays of this plugin, and which files it opens without a question.
#ifndef SpectralSettings_h
#define SpectralSettings_h

namespace msi
{

// Registers settings below those of the user. Color maps by the names of arrays:
// color differences: perceptually uniform (viridis), fixed from 0 to 5 with equal steps of color at 0, 1, 2, 3 and 5;
// spectral rms and uncertainty: viridis; signed differences: diverging;
// spectra: one band, not the magnitude over all bands, which is no physical quantity. NaN is gray everywhere.
// Readers by the names of files, such as channel_450nm.tif.
void registerSettings();

} // namespace msi

#endif
