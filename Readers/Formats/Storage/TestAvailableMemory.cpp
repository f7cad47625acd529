#include "Formats/Storage/AvailableMemory.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

TEST(AvailableMemory, IsWhatAMachineMayHave)
{
  EXPECT_GT(msi::availableMemory(), 1u << 20);
}

TEST(AvailableMemory, IsNamedInUnits)
{
  EXPECT_EQ(msi::memoryText(138), "138 bytes");
  EXPECT_EQ(msi::memoryText(57.6e9), "57.6 GB");
  EXPECT_EQ(msi::memoryText(1.5e12), "1.5 TB");
}

TEST(AvailableMemory, SmallSizesAreNotLookedAt)
{
  EXPECT_NO_THROW(msi::requireMemory(1e6, "a table", ""));
}

TEST(AvailableMemory, MoreThanThereIsIsRefused)
{
  try
  {
    msi::requireMemory(1e18, "the image", "read less of it");
    FAIL() << "nothing was thrown";
  }
  catch (const std::runtime_error& error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.rfind("the image needs 1e+06 TB of memory and ", 0), 0u) << text;
    EXPECT_NE(text.find(" are free; read less of it"), std::string::npos) << text;
  }
}

#ifndef __SANITIZE_ADDRESS__ // which takes terabytes of addresses
TEST(AvailableMemory, HeedsTheLimitOfTheProcess)
{
  const pid_t child = ::fork();
  if (child == 0)
  {
    const rlimit limit = { rlim_t{ 1 } << 30, rlim_t{ 1 } << 30 };
    const bool set = ::setrlimit(RLIMIT_AS, &limit) == 0;
    ::_exit(set && msi::availableMemory() <= std::uint64_t{ 1 } << 30 ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}
#endif

}
