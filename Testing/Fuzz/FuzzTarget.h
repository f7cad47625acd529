// What every fuzz target shares.
#pragma once

#include "Formats/FormatError.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

// The only way out of a parser, beside a result, is FormatError with a text. Anything else that it
// throws ends the fuzzer, as a crash does.
template <typename Parse>
void parseOrRefuse(Parse parse)
{
  try
  {
    parse();
  }
  catch (const msi::FormatError& error)
  {
    if (std::string(error.what()).find(": ") == std::string::npos)
    {
      std::abort();
    }
  }
}

inline std::string textOf(const std::uint8_t* data, std::size_t size)
{
  return { reinterpret_cast<const char*>(data), size };
}

inline void require(bool holds)
{
  if (!holds)
  {
    std::abort();
  }
}
