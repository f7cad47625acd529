#include "ThreadedParts.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
// Runs the test with one thread on the caller's, and with four beside it.
void forBackends(const std::function<void()>& test)
{
  const std::string before = vtkSMPTools::GetBackend();
  for (const char* backend : { "Sequential", "STDThread" })
  {
    SCOPED_TRACE(backend);
    ASSERT_TRUE(vtkSMPTools::SetBackend(backend));
    vtkSMPTools::Initialize(4);
    test();
  }
  vtkSMPTools::SetBackend(before.c_str());
  vtkSMPTools::Initialize(0);
}

struct Progress
{
  std::vector<double> told;
  std::vector<std::thread::id> threads;

  void tell(vtkObject*, unsigned long, void* value)
  {
    told.push_back(*static_cast<double*>(value));
    threads.push_back(std::this_thread::get_id());
  }
};

TEST(ThreadedParts, EveryPartOnce)
{
  forBackends(
    []
    {
      for (const vtkIdType parts : { 0, 1, 3, 1000 })
      {
        std::vector<std::atomic<int>> times(static_cast<std::size_t>(parts));
        vtkNew<vtkAlgorithm> algorithm;
        msi::forParts(
          algorithm, parts, [&](vtkIdType part) { ++times[static_cast<std::size_t>(part)]; });
        msi::forParts(parts, [&](vtkIdType part) { ++times[static_cast<std::size_t>(part)]; });
        for (const auto& count : times)
        {
          EXPECT_EQ(count, 2);
        }
      }
    });
}

// The first part ends when all others are done: one thread alone has to do them.
TEST(ThreadedParts, NoThreadWaitsForALongPart)
{
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  vtkSMPTools::Initialize(2);
  std::atomic<int> done{ 0 };
  const auto start = std::chrono::steady_clock::now();
  msi::forParts(20,
    [&](vtkIdType part)
    {
      while (part == 0 && done < 19 &&
        std::chrono::steady_clock::now() - start < std::chrono::seconds(10))
      {
        std::this_thread::yield();
      }
      ++done;
    });
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  vtkSMPTools::Initialize(0);
}

TEST(ThreadedParts, FirstFailureForAnyNumberOfThreads)
{
  forBackends(
    []
    {
      vtkNew<vtkAlgorithm> algorithm;
      std::atomic<int> started{ 0 };
      const auto work = [&](vtkIdType part)
      {
        ++started;
        if (part >= 5)
        {
          // The later ones fail sooner.
          std::this_thread::sleep_for(std::chrono::milliseconds(part == 5 ? 20 : 1));
          throw std::invalid_argument("part " + std::to_string(part));
        }
      };
      for (const bool withAlgorithm : { false, true })
      {
        try
        {
          withAlgorithm ? msi::forParts(algorithm, 1000, work) : msi::forParts(1000, work);
          FAIL() << "nothing was thrown";
        }
        catch (const std::invalid_argument& error)
        {
          EXPECT_STREQ(error.what(), "part 5");
        }
      }
      EXPECT_LT(started, 40);
    });
}

TEST(ThreadedParts, ProgressAndAbortOnTheCallingThread)
{
  forBackends(
    []
    {
      vtkNew<vtkAlgorithm> algorithm;
      Progress progress;
      algorithm->AddObserver(vtkCommand::ProgressEvent, &progress, &Progress::tell);
      const auto work = [](vtkIdType)
      { std::this_thread::sleep_for(std::chrono::milliseconds(15)); };
      msi::forParts(algorithm, 20, work, 0.5);
      ASSERT_GE(progress.told.size(), 3U);
      EXPECT_EQ(progress.told.front(), 0.5);
      EXPECT_EQ(progress.told.back(), 1.0);
      EXPECT_TRUE(std::is_sorted(progress.told.begin(), progress.told.end()));
      for (const auto& thread : progress.threads)
      {
        EXPECT_EQ(thread, std::this_thread::get_id());
      }
      std::atomic<int> started{ 0 };
      algorithm->SetAbortExecute(1);
      EXPECT_THROW(
        msi::forParts(algorithm, 1000, [&](vtkIdType) { ++started; }), std::runtime_error);
      EXPECT_EQ(started, 0);
    });
}
}
