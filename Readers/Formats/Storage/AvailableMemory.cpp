#include "Formats/Storage/AvailableMemory.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <sys/resource.h>
#include <unistd.h>

namespace msi
{

namespace
{
constexpr std::uint64_t Unknown = std::numeric_limits<std::uint64_t>::max();
constexpr double SmallSize = 256e6; // bytes
constexpr std::uint64_t BytesPerKilobyte = 1024;

// MemAvailable and SwapFree of Linux, in kB.
std::uint64_t freeOfMachine()
{
  std::ifstream file("/proc/meminfo");
  std::string key;
  std::uint64_t value = 0;
  std::string unit;
  std::uint64_t sum = 0;
  bool known = false;
  while (file >> key >> value)
  {
    std::getline(file, unit);
    if (key == "MemAvailable:" || key == "SwapFree:")
    {
      sum += value * BytesPerKilobyte;
      known = known || key == "MemAvailable:";
    }
  }
  return known ? sum : Unknown;
}

// What is left where two files tell a limit and what is used of it; "max" is no number.
std::uint64_t leftOf(const char* limitFile, const char* usedFile)
{
  std::uint64_t limit = 0;
  std::uint64_t used = 0;
  if (std::ifstream(limitFile) >> limit && std::ifstream(usedFile) >> used)
  {
    return limit > used ? limit - used : 0;
  }
  return Unknown;
}

std::uint64_t freeOfGroup()
{
  return std::min(leftOf("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
    leftOf("/sys/fs/cgroup/memory/memory.limit_in_bytes",
      "/sys/fs/cgroup/memory/memory.usage_in_bytes"));
}

std::uint64_t freeOfAddressSpace()
{
  rlimit limit = {};
  std::uint64_t pages = 0;
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ||
    !(std::ifstream("/proc/self/statm") >> pages))
  {
    return Unknown;
  }
  const std::uint64_t used = pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return limit.rlim_cur > used ? limit.rlim_cur - used : 0;
}
}

std::uint64_t availableMemory()
{
  return std::min({ freeOfMachine(), freeOfGroup(), freeOfAddressSpace() });
}

std::string memoryText(double bytes)
{
  static constexpr std::array<std::pair<double, const char*>, 4> Units = { { { 1e12, " TB" },
    { 1e9, " GB" }, { 1e6, " MB" }, { 1e3, " kB" } } };
  std::ostringstream text;
  text.precision(3);
  for (const auto& [size, unit] : Units)
  {
    if (bytes >= size)
    {
      text << bytes / size << unit;
      return text.str();
    }
  }
  text << bytes << " bytes";
  return text.str();
}

void requireMemory(double bytes, const std::string& what, const std::string& remedy)
{
  if (bytes < SmallSize)
  {
    return;
  }
  const std::uint64_t available = availableMemory();
  if (bytes > static_cast<double>(available))
  {
    throw std::runtime_error(what + " needs " + memoryText(bytes) + " of memory and " +
      memoryText(static_cast<double>(available)) + " are free; " + remedy);
  }
}

} // namespace msi
