#include "DiagnosisRun.h"

#include "ThreadedParts.h"

#include "vtkAlgorithm.h"

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <stdexcept>
#include <string>

namespace msi
{

namespace
{
constexpr std::chrono::milliseconds ShownEvery{ 100 };

// What the working threads tell the pipeline's thread.
class Messages
{
public:
  bool tell(double fraction, const char* what)
  {
    const std::lock_guard<std::mutex> hold(Lock);
    Fraction = fraction;
    What = what;
    return !Stop;
  }
  void show(vtkAlgorithm* algorithm)
  {
    std::string what;
    double fraction = 0.0;
    {
      const std::lock_guard<std::mutex> hold(Lock);
      what = What;
      fraction = Fraction;
    }
    algorithm->SetProgressText(what.c_str());
    algorithm->UpdateProgress(fraction);
    Stop = Stop || algorithm->GetAbortExecute() != 0;
  }
  bool stopped() const { return Stop; }

private:
  std::mutex Lock;
  double Fraction = 0.0;
  std::string What;
  std::atomic<bool> Stop{ false };
};

// diagnose(options) beside the calling thread.
template <typename Diagnose>
auto runBeside(vtkAlgorithm* algorithm, GapOptions options, Diagnose diagnose)
{
  Messages messages;
  std::mutex exclusive;
  options.progress = [&messages](double fraction, const char* what)
  { return messages.tell(fraction, what); };
  options.parallelFor = [](int count, const std::function<void(int)>& body)
  { forParts(count, [&body](vtkIdType i) { body(static_cast<int>(i)); }); };
  options.exclusive = [&exclusive](const std::function<void()>& body)
  {
    const std::lock_guard<std::mutex> hold(exclusive);
    body();
  };
  auto work = std::async(std::launch::async, [&diagnose, &options] { return diagnose(options); });
  while (work.wait_for(ShownEvery) != std::future_status::ready)
  {
    messages.show(algorithm);
  }
  messages.show(algorithm);
  auto result = work.get();
  if (!result || messages.stopped())
  {
    throw std::runtime_error("stopped by the user");
  }
  return std::move(*result);
}
}

GapReport runDiagnosis(vtkAlgorithm* algorithm, const GapCapture& capture, GapOptions options)
{
  return runBeside(algorithm, std::move(options),
    [&capture](const GapOptions& given) { return diagnoseGap(capture, given); });
}

FieldGap runDiagnosis(vtkAlgorithm* algorithm, const FieldPair& pair, GapOptions options)
{
  return runBeside(algorithm, std::move(options),
    [&pair](const GapOptions& given) { return diagnoseField(pair, given); });
}

} // namespace msi
