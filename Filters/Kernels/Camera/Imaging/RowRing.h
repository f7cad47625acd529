// Rows of an image that comes row by row.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace msi
{

// The last rows. Row y lies at y modulo the number of rows kept. Rows do not lie a power of two apart: the caches of most machines
// would hold but a few values of a column.
class RowRing
{
public:
  // Forgets the rows, keeps their memory.
  void begin(int rows, std::size_t count)
  {
    Rows = rows;
    Step = (count / Line + 1) * Line + (count / Line % 2 == 0 ? 0 : Line);
    Values.resize(static_cast<std::size_t>(rows) * Step);
  }
  float* row(int y) noexcept { return Values.data() + static_cast<std::size_t>(y % Rows) * Step; }

private:
  static constexpr std::size_t Line = 16; // floats of a cache line

  int Rows = 1;
  std::size_t Step = 0;
  std::vector<float> Values;
};

// padded = the row with its first and last pixel repeated `margin` times.
inline void padRow(const float* row, std::size_t pixels, std::size_t channels, std::size_t margin,
  std::vector<float>& padded)
{
  padded.resize((pixels + 2 * margin) * channels);
  float* out = padded.data();
  for (std::size_t i = 0; i < margin; ++i, out += channels)
  {
    std::copy_n(row, channels, out);
  }
  out = std::copy_n(row, pixels * channels, out);
  for (std::size_t i = 0; i < margin; ++i, out += channels)
  {
    std::copy_n(row + (pixels - 1) * channels, channels, out);
  }
}

// Gives the rows of a buffer to a filter of rows (RowConvolution, ..); what comes out goes into `out`, which may be the buffer.
template <typename Filter>
void filterRows(Filter& filter, const PixelBuffer& buffer, PixelBuffer& out)
{
  const ImageWindow& window = buffer.window;
  const auto count =
    static_cast<std::size_t>(window.width) * static_cast<std::size_t>(buffer.channels);
  int y = window.y;
  for (int row = window.y; row < window.y + window.height; ++row)
  {
    filter.push(buffer.pixel(window.x, row),
      [&](const float* done) { std::copy_n(done, count, out.pixel(window.x, y++)); });
  }
}

} // namespace msi
