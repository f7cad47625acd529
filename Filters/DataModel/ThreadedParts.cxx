#include "ThreadedParts.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <mutex>
#include <stdexcept>

namespace msi
{

namespace
{
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds ShownEvery{ 100 };

class PartQueue
{
public:
  PartQueue(vtkIdType parts, const std::function<void(vtkIdType)>& work)
    : Parts(parts)
    , Work(work)
  {
  }

  // Does the next part; false where none is left. Parts start in order, so whatever was started before a part
  // that fails also ends, and the first failure is always the same.
  bool next() noexcept
  {
    const vtkIdType part = Stopped ? Parts : Next++;
    if (part >= Parts)
    {
      return false;
    }
    try
    {
      Work(part);
    }
    catch (...)
    {
      Stopped = true;
      const std::lock_guard<std::mutex> hold(Lock);
      if (!Failure || part < FailedPart)
      {
        Failure = std::current_exception();
        FailedPart = part;
      }
    }
    ++Done;
    return true;
  }

  void runInThreads()
  {
    vtkSMPTools::For(0, std::min<vtkIdType>(Parts, vtkSMPTools::GetEstimatedNumberOfThreads()), 1,
      [this](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType thread = begin; thread < end; ++thread)
        {
          while (next())
          {
          }
        }
      });
  }

  double done() const { return static_cast<double>(Done) / static_cast<double>(Parts); }
  void stop() { Stopped = true; }

  void rethrow() const
  {
    if (Failure)
    {
      std::rethrow_exception(Failure);
    }
  }

private:
  const vtkIdType Parts;
  const std::function<void(vtkIdType)>& Work;
  std::atomic<vtkIdType> Next{ 0 };
  std::atomic<vtkIdType> Done{ 0 };
  std::atomic<bool> Stopped{ false };
  std::mutex Lock;
  std::exception_ptr Failure;
  vtkIdType FailedPart = 0;
};
}

void forParts(vtkIdType parts, const std::function<void(vtkIdType)>& work)
{
  PartQueue queue(parts, work);
  queue.runInThreads();
  queue.rethrow();
}

void forParts(vtkAlgorithm* algorithm, vtkIdType parts, const std::function<void(vtkIdType)>& work,
  double progress)
{
  if (parts <= 0)
  {
    return;
  }
  PartQueue queue(parts, work);
  bool aborted = false;
  const auto show = [&]
  {
    algorithm->UpdateProgress(progress + (1.0 - progress) * queue.done());
    aborted = aborted || algorithm->GetAbortExecute() != 0;
    if (aborted)
    {
      queue.stop();
    }
  };
  if (parts == 1 || vtkSMPTools::GetEstimatedNumberOfThreads() == 1)
  {
    auto shown = Clock::now() - ShownEvery;
    do
    {
      if (Clock::now() - shown >= ShownEvery)
      {
        show();
        shown = Clock::now();
      }
    } while (queue.next());
  }
  else
  {
    show();
    // Observers of the progress belong to the calling thread, which so does no part itself.
    const auto running = std::async(std::launch::async, [&queue] { queue.runInThreads(); });
    while (running.wait_for(ShownEvery) != std::future_status::ready)
    {
      show();
    }
  }
  queue.rethrow();
  if (aborted)
  {
    throw std::runtime_error("stopped by the user");
  }
  show();
}

} // namespace msi
