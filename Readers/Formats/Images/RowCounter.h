// Checks that a writer receives every row of its image once.
#pragma once

#include <stdexcept>
#include <string>

namespace msi
{

class RowCounter
{
public:
  explicit RowCounter(int height)
    : Height(height)
  {
  }

  int next() const noexcept { return Next; }

  // Before rows are written. Errors: std::invalid_argument.
  void expect(int rows) const
  {
    if (rows < 0 || rows > Height - Next)
    {
      throw std::invalid_argument(std::to_string(Next) + " + " + std::to_string(rows) +
        " rows were given; expected " + std::to_string(Height) + " in all");
    }
  }
  void add(int rows) noexcept { Next += rows; }

  void requireComplete() const
  {
    if (Next != Height)
    {
      throw std::invalid_argument(std::to_string(Next) + " rows were given; expected " +
        std::to_string(Height) + " before the image is finished");
    }
  }

private:
  int Height;
  int Next = 0;
};

} // namespace msi
