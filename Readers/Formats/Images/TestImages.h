// Small images for the tests, written by OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace msi::testing
{

// Pixels channel by channel within pixel, row by row. 'pages' after the first are appended.
template <typename T>
void writeImage(const std::string& path, const std::vector<OIIO::ImageSpec>& specs,
  const std::vector<std::vector<T>>& pages)
{
  const auto out = OIIO::ImageOutput::create(path);
  if (!out || !out->open(path, static_cast<int>(specs.size()), specs.data()))
  {
    throw std::runtime_error("cannot write " + path);
  }
  for (std::size_t page = 0; page < pages.size(); ++page)
  {
    if (page > 0 && !out->open(path, specs[page], OIIO::ImageOutput::AppendSubimage))
    {
      throw std::runtime_error("cannot append to " + path + ": " + out->geterror());
    }
    if (!out->write_image(OIIO::BaseTypeFromC<T>::value, pages[page].data()))
    {
      throw std::runtime_error("cannot write pixels of " + path + ": " + out->geterror());
    }
  }
  out->close();
}

template <typename T>
void writeImage(
  const std::string& path, int width, int height, int channels, const std::vector<T>& pixels)
{
  const OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<T>::value);
  writeImage<T>(path, std::vector<OIIO::ImageSpec>{ spec }, { pixels });
}

} // namespace msi::testing
