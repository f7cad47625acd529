// One file of an image format that OpenImageIO reads.
#pragma once

#include "Formats/SampleType.h"
#include "Formats/Storage/FileStamp.h"

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

// The pages (TIFF) or parts (EXR) of a file, and their pixels as stored.
// Threads: read may be called from several threads.
class OpenedImage
{
public:
  // Errors: FormatError with OpenImageIO's reason, or for samples of no SampleType.
  explicit OpenedImage(std::string path);

  const std::string& path() const noexcept { return Path; }
  const std::vector<OIIO::ImageSpec>& pages() const noexcept { return Pages; }
  const char* formatName() const { return Input->format_name(); }

  // How the samples of a page come from read(): as stored, but float for half.
  SampleType sampleType(int page) const { return Types[static_cast<std::size_t>(page)]; }

  // Rows [y0, y1), all columns, channels [c0, c1): channels within pixels within rows.
  // 'bytes' is resized. Errors: FormatError, also where the file was written to since it was opened.
  void read(int page, int y0, int y1, int c0, int c1, std::vector<unsigned char>& bytes) const;

private:
  void addPage(OIIO::ImageSpec spec);
  void requirePossibleSize(const OIIO::ImageSpec& spec, const std::string& page) const;

  std::string Path;
  FileStamp Stamp; // taken before the library opens the file
  std::unique_ptr<OIIO::ImageInput> Input;
  std::vector<OIIO::ImageSpec> Pages;
  std::vector<SampleType> Types;
};

} // namespace msi
