#pragma once

#include <sstream>
#include <stdexcept>

namespace msi
{

// Throws std::invalid_argument, whose message is the parts in a row.
template <typename... Parts>
[[noreturn]] void reject(const Parts&... parts)
{
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

} // namespace msi
