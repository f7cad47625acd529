// The files of an image that is stored as one file per channel.
#pragma once

#include <string>
#include <vector>

namespace msi
{

// The files of one folder whose names differ in their wavelength alone.
struct StackFiles
{
  std::string pattern;            // channel_*nm.tif
  std::vector<std::string> files; // by wavelength, the named one among them
};

// The stack that a file belongs to; no files where its name holds no wavelength in nm, or where it is the only one of its
// kind.
StackFiles stackOf(const std::string& file);

} // namespace msi
