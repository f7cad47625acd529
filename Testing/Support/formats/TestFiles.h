// A folder of its own for each test, and the text of the error that a call ends with.
#pragma once

#include "Formats/FormatError.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace msi::testing
{

class TemporaryFolder : public ::testing::Test
{
protected:
  TemporaryFolder()
  {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name =
      std::string(info->test_suite_name()) + "." + info->name() + "." + std::to_string(::getpid());
    for (char& c : name)
    {
      c = c == '/' ? '_' : c;
    }
    Folder = std::filesystem::temp_directory_path() / name;
    std::filesystem::create_directories(Folder);
  }

  ~TemporaryFolder() override
  {
    std::error_code error;
    std::filesystem::remove_all(Folder, error);
  }

  std::string path(const std::string& name) const { return (Folder / name).string(); }

  std::string write(const std::string& name, const std::string& content) const
  {
    std::filesystem::create_directories((Folder / name).parent_path());
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  // A change in the same tick of the file system's clock would not be seen: set the time by hand.
  void setTime(const std::string& name, std::time_t seconds) const
  {
    const std::array<timespec, 2> times = { { { seconds, 0 }, { seconds, 0 } } };
    ASSERT_EQ(::utimensat(AT_FDCWD, path(name).c_str(), times.data(), 0), 0);
  }

  std::string read(const std::string& name) const
  {
    std::ostringstream content;
    content << std::ifstream(path(name), std::ios::binary).rdbuf();
    return content.str();
  }

  // The text of the FormatError, with the folder left out; empty when there was none.
  std::string errorOf(const std::function<void()>& call) const
  {
    try
    {
      call();
    }
    catch (const FormatError& error)
    {
      std::string text = error.what();
      const std::string folder = Folder.string() + "/";
      for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder))
      {
        text.erase(at, folder.size());
      }
      return text;
    }
    return {};
  }

  std::filesystem::path Folder;
};

// A file of the measured data, where the environment variable MULTISPECTRAL_DATA names their folder.
inline std::optional<std::string> measuredData(const std::string& name)
{
  const char* folder = std::getenv("MULTISPECTRAL_DATA");
  return folder == nullptr ? std::nullopt : std::optional(std::string(folder) + "/" + name);
}

} // namespace msi::testing

// Inside a test: the path of a measured file, or the test is skipped.
#define MSI_MEASURED_DATA(variable, name)                                                          \
  const auto variable##OrNone = msi::testing::measuredData(name);                                  \
  if (!variable##OrNone)                                                                           \
  {                                                                                                \
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";                                               \
  }                                                                                                \
  const std::string& variable = *variable##OrNone
