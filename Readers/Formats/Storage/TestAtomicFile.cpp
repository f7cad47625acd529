#include "Formats/Storage/AtomicFile.h"
#include "Formats/Storage/StaleParts.h"

#include "Support/formats/TestFiles.h"

#include <algorithm>
#include <set>

#include <sys/wait.h>
#include <unistd.h>

namespace
{

class AtomicFiles : public msi::testing::TemporaryFolder
{
protected:
  std::set<std::string> names() const
  {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(Folder))
    {
      found.insert(entry.path().filename().string());
    }
    return found;
  }

  // Runs work in a process of its own that is killed before it can clean up.
  template <typename Work>
  void runKilled(const Work& work) const
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      work();
      ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
  }
};

TEST_F(AtomicFiles, AreCompleteOrAbsent)
{
  {
    msi::AtomicFile file(path("a.csv"));
    file.append("half");
    EXPECT_EQ(names().count("a.csv"), 0u);
  }
  EXPECT_TRUE(names().empty());
  {
    msi::AtomicFile file(path("a.csv"));
    file.append("whole");
    file.commit();
  }
  EXPECT_EQ(names(), std::set<std::string>{ "a.csv" });
  EXPECT_EQ(read("a.csv"), "whole");
}

TEST_F(AtomicFiles, AKilledProcessLeavesNoFileUnderTheName)
{
  runKilled(
    [this]
    {
      msi::AtomicFile file(path("a.csv"));
      file.append("half");
      ::kill(::getpid(), SIGKILL);
    });
  ASSERT_EQ(names().size(), 1u);
  EXPECT_EQ(names().begin()->substr(0, 3), ".a.");
}

TEST_F(AtomicFiles, TheNextOneRemovesWhatAKilledProcessLeft)
{
  for (int i = 0; i < 3; ++i)
  {
    runKilled(
      [this]
      {
        msi::AtomicFile file(path("a.csv"));
        file.append("half");
        ::kill(::getpid(), SIGKILL);
      });
    ASSERT_EQ(names().size(), 1u) << "round " << i;
  }
  msi::AtomicFile file(path("a.csv"));
  file.append("whole");
  file.commit();
  EXPECT_EQ(names(), std::set<std::string>{ "a.csv" });
}

TEST_F(AtomicFiles, AProcessThatNobodyWaitedForIsGone)
{
  const pid_t child = ::fork();
  if (child == 0)
  {
    msi::AtomicFile file(path("a.csv"));
    file.append("half");
    ::kill(::getpid(), SIGKILL);
  }
  siginfo_t state{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &state, WEXITED | WNOWAIT), 0);
  EXPECT_EQ(names().size(), 1u);
  msi::removeStaleParts(path("a.csv"));
  EXPECT_TRUE(names().empty());
  ::waitpid(child, nullptr, 0);
}

TEST_F(AtomicFiles, PartsOfOthersStay)
{
  const std::string mine =
    std::filesystem::path(msi::partName(path("a.csv"), 7)).filename().string();
  const std::string gone = std::to_string(4194304 + 5); // above the kernel's largest process number
  const auto ofProcess = [&mine](const std::string& process)
  {
    std::string name = mine;
    return name.replace(
      name.find(std::to_string(::getpid())), std::to_string(::getpid()).size(), process);
  };
  const std::set<std::string> kept = { mine, ".a.elsewhere-" + gone + "-0.part.csv", ".a.part.csv",
    "a.csv.part", ofProcess(gone + "x"), ".ab" + ofProcess(gone).substr(2) };
  for (const std::string& name : kept)
  {
    write(name, "x");
  }
  write(ofProcess(gone), "x");
  msi::removeStaleParts(path("a.csv"));
  EXPECT_EQ(names(), kept);
}

TEST_F(AtomicFiles, AFolderThatIsNotThereIsNamed)
{
  EXPECT_EQ(errorOf([&] { msi::AtomicFile file(path("nowhere/a.csv")); }),
    "nowhere/a.csv: cannot be written (No such file or directory); expected a writable folder with "
    "room in it; check "
    "the folder, its access rights and the free space");
}

}
