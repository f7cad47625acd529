// Which files ParaView opens without a question.
#ifndef SpectralSettings_h
#define SpectralSettings_h

namespace msi
{

// Registers settings below those of the user: readers by the names of files, such as channel_450nm.tif.
void registerSettings();

} // namespace msi

#endif
