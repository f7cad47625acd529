// The text of the error that a call ends with.
#pragma once

#include <stdexcept>
#include <string>

namespace msi::testing
{

// Of std::invalid_argument; empty where there was none.
template <typename Call>
std::string argumentError(Call&& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

} // namespace msi::testing
