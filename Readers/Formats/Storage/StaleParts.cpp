#include "Formats/Storage/StaleParts.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <vector>

#include <sys/types.h>
#include <unistd.h>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

constexpr std::string_view PartMark = ".part";
constexpr std::size_t LongestHost = 16; // names of files end at 255 bytes

// Without the characters that have a meaning in the name of a part.
std::string hostName()
{
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0)
  {
    return "host";
  }
  std::string host = std::string(name.data()).substr(0, LongestHost);
  for (char& c : host)
  {
    c = c == '/' || c == '-' || c == '.' ? '_' : c;
  }
  return host;
}

std::string beginningOf(const fs::path& target)
{
  return "." + target.stem().string() + "." + hostName() + "-";
}

// "123-0" of the parts of process 123; 0 where the text is no such thing.
pid_t processIn(std::string_view text)
{
  pid_t process = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), process);
  unsigned number = 0;
  const char* const last = text.data() + text.size();
  if (error != std::errc() || process <= 0 || end == last || *end != '-')
  {
    return 0;
  }
  const auto [stop, fault] = std::from_chars(end + 1, last, number);
  return fault == std::errc() && stop == last ? process : 0;
}

// Also where it ended and nobody asked for its status, as in containers whose first process asks for none.
bool isGone(pid_t process)
{
  if (::kill(process, 0) != 0)
  {
    return errno == ESRCH;
  }
  std::ifstream status("/proc/" + std::to_string(process) + "/stat");
  const std::string text{ std::istreambuf_iterator<char>(status), {} };
  const std::size_t name = text.rfind(") "); // of the program, which may itself hold brackets
  return name != std::string::npos && (text[name + 2] == 'Z' || text[name + 2] == 'X');
}

std::vector<fs::path> stalePartsOf(const fs::path& target)
{
  const std::string beginning = beginningOf(target);
  const std::string ending = std::string(PartMark) + target.extension().string();
  std::vector<fs::path> stale;
  std::error_code error;
  const fs::path folder = target.parent_path().empty() ? fs::path(".") : target.parent_path();
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    if (name.size() > beginning.size() + ending.size() &&
      name.compare(0, beginning.size(), beginning) == 0 &&
      name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
    {
      const pid_t process = processIn(std::string_view(name).substr(
        beginning.size(), name.size() - beginning.size() - ending.size()));
      if (process > 0 && isGone(process))
      {
        stale.push_back(entry->path());
      }
    }
  }
  return stale;
}
}

std::string partName(const std::string& path, unsigned number)
{
  const fs::path target(path);
  return (target.parent_path() /
    (beginningOf(target) + std::to_string(::getpid()) + "-" + std::to_string(number) +
      std::string(PartMark) + target.extension().string()))
    .string();
}

void removeStaleParts(const std::string& path) noexcept
{
  try
  {
    for (const fs::path& part : stalePartsOf(path))
    {
      std::error_code ignored;
      fs::remove(part, ignored);
    }
  }
  catch (const std::exception&)
  {
    return; // the folder cannot be listed: its parts stay
  }
}

} // namespace msi
