#include "vtkMethodComparison.h"

#include "AlgorithmSupport.h"
#include "HeldOutFigures.h"
#include "NameList.h"
#include "ResponseRange.h"
#include "SampleColumns.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Kernels/Estimation/MethodComparison.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkMethodComparison);

namespace
{
std::vector<Eigen::Index> countsOf(const std::string& text)
{
  std::vector<Eigen::Index> counts;
  for (const auto& word : msi::namesIn(text))
  {
    if (word.find_first_not_of("0123456789") != std::string::npos || word.size() > 6)
    {
      throw std::invalid_argument("TuningSamples holds '" + word +
        "'; expected whole numbers separated by commas, like 6, 16, 36");
    }
    counts.push_back(std::stol(word));
  }
  if (counts.empty())
  {
    throw std::invalid_argument("TuningSamples is empty; expected at least one number, like 16");
  }
  return counts;
}

// A table that is filled row by row, a column a name.
class RowTable
{
public:
  RowTable(vtkTable* table, bool withDraw)
  {
    for (auto* column : { Method.Get(), MetricName.Get(), Illuminant.Get() })
    {
      column->SetNumberOfComponents(1);
    }
    Method->SetName("method");
    MetricName->SetName("metric");
    Illuminant->SetName("illuminant");
    Channels->SetName("channels");
    Tuning->SetName("tuning");
    Draw->SetName("draw");
    table->AddColumn(Method);
    table->AddColumn(Channels);
    table->AddColumn(Tuning);
    if (withDraw)
    {
      table->AddColumn(Draw);
    }
    table->AddColumn(MetricName);
    table->AddColumn(Illuminant);
    const char* names[msi::FigureCount] = { "mean", "median", "p95", "max" };
    for (std::size_t i = 0; i < msi::FigureCount; ++i)
    {
      Values[i]->SetName(names[i]);
      table->AddColumn(Values[i]);
    }
  }

  void add(const std::string& method, Eigen::Index channels, Eigen::Index tuning, std::size_t draw,
    const msi::ErrorName& metric, const double* figures)
  {
    Method->InsertNextValue(method);
    Channels->InsertNextValue(static_cast<int>(channels));
    Tuning->InsertNextValue(static_cast<int>(tuning));
    Draw->InsertNextValue(static_cast<int>(draw));
    MetricName->InsertNextValue(metric.metric);
    Illuminant->InsertNextValue(metric.illuminant);
    for (std::size_t i = 0; i < msi::FigureCount; ++i)
    {
      Values[i]->InsertNextValue(figures[i]);
    }
  }

private:
  vtkNew<vtkStringArray> Method;
  vtkNew<vtkIntArray> Channels;
  vtkNew<vtkIntArray> Tuning;
  vtkNew<vtkIntArray> Draw;
  vtkNew<vtkStringArray> MetricName;
  vtkNew<vtkStringArray> Illuminant;
  vtkNew<vtkDoubleArray> Values[msi::FigureCount];
};

// The held-out sample whose rms is the (lower) median.
Eigen::Index typicalSample(const Eigen::VectorXd& rms)
{
  std::vector<Eigen::Index> order(static_cast<std::size_t>(rms.size()));
  std::iota(order.begin(), order.end(), 0);
  const auto middle = order.begin() + (rms.size() - 1) / 2;
  std::nth_element(order.begin(), middle, order.end(),
    [&rms](Eigen::Index a, Eigen::Index b) { return rms[a] != rms[b] ? rms[a] < rms[b] : a < b; });
  return *middle;
}

// A method without figures, with the numbers of tuning samples where that is so.
struct LeftOutMethod
{
  std::vector<std::size_t> counts; // places in the list of numbers
  std::string reason;
};

// Why the method has no estimate at the first such number and draw. All draws were judged before.
LeftOutMethod leftOut(const std::vector<msi::MethodComparison>& comparisons, std::size_t method,
  std::size_t draws, msi::FigureStore& store)
{
  LeftOutMethod result;
  for (std::size_t count = 0; count < comparisons.size(); ++count)
  {
    for (std::size_t draw = 0; draw < draws; ++draw)
    {
      if (!std::isnan(*store.at(count, draw, method, 0)))
      {
        continue;
      }
      if (result.counts.empty())
      {
        result.reason = comparisons[count].only(method).run(draw).estimates.front().failure;
      }
      result.counts.push_back(count);
      break;
    }
  }
  return result;
}

std::string textOf(
  const LeftOutMethod& method, const std::string& name, const std::vector<Eigen::Index>& counts)
{
  std::ostringstream text;
  text << "the method " << name << " is left out";
  if (method.counts.size() < counts.size())
  {
    const char* separator = " with ";
    for (const auto count : method.counts)
    {
      text << std::exchange(separator, ", ") << counts[count];
    }
    text << " tuning samples";
  }
  text << ": " << method.reason;
  return text.str();
}

void writeSpectra(const msi::WavelengthGrid& bands, msi::ComparisonDraw draw,
  const Eigen::MatrixXd& target, vtkTable* table)
{
  auto& estimates = draw.estimates;
  estimates.erase(std::remove_if(estimates.begin(), estimates.end(),
                    [](const msi::MethodEstimate& estimate) { return !estimate.failure.empty(); }),
    estimates.end());
  if (estimates.empty())
  {
    return;
  }
  const auto sample = typicalSample(estimates.front().rms);
  msi::setNumbers(table, "wavelength", bands.vector());
  msi::setNumbers(table, "measured", target.col(draw.heldOut[static_cast<std::size_t>(sample)]));
  for (const auto& estimate : estimates)
  {
    const std::string& name = estimate.method;
    const Eigen::VectorXd mean = estimate.reflectance.col(sample);
    msi::setNumbers(table, name, mean);
    if (estimate.standardDeviation.size() > 0)
    {
      const Eigen::VectorXd two = 2.0 * estimate.standardDeviation.col(sample);
      msi::setNumbers(table, name + " -2s", mean - two);
      msi::setNumbers(table, name + " +2s", mean + two);
    }
  }
}
}

vtkMethodComparison::vtkMethodComparison()
{
  this->SetNumberOfInputPorts(4);
  this->SetNumberOfOutputPorts(4);
}

void vtkMethodComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Methods: " << this->Methods << "\n"
     << indent << "TuningSamples: " << this->TuningSamples << "\n"
     << indent << "Draws: " << this->Draws << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "Difference: " << this->Difference << "\n"
     << indent << "Illuminants: " << this->Illuminants << "\n"
     << indent << "Observer: " << this->Observer << "\n";
}

int vtkMethodComparison::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port > 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkMethodComparison::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  msi::declareCollective(outputs);
  return 1;
}

int vtkMethodComparison::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 4; ++port)
  {
    msi::requestWhole(inputs, port);
  }
  return 1;
}

int vtkMethodComparison::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const auto chart =
        msi::requireMeasuredSamples(vtkTable::GetData(inputs[0]), "the calibration table");
      const auto medium =
        msi::requireMeasuredSamples(vtkTable::GetData(inputs[1]), "the target table");
      msi::requireSameChannels(
        chart.channels, "the calibration table", medium.channels, "the target table");
      msi::requireSameBands(chart.bands, "the calibration table", medium.bands, "the target table");
      msi::requireSameUnit(chart, "the calibration table", medium, "the target table");
      const auto dead =
        msi::deadChannels(chart.samples.response, chart.channels, "the calibration table");
      const auto deadOfTarget =
        msi::deadChannels(medium.samples.response, medium.channels, "the target table");
      msi::ComparisonOptions options;
      options.methods = msi::namesIn(this->Methods);
      if (options.methods == std::vector<std::string>{ "all" })
      {
        options.methods = msi::allMethodNames();
      }
      options.seed = static_cast<std::uint64_t>(this->Seed);
      options.channelWavelengths = chart.channels.wavelengths;

      const auto counts = countsOf(this->TuningSamples);
      std::vector<msi::MethodComparison> comparisons;
      for (const auto count : counts)
      {
        options.tuningSamples = count;
        comparisons.emplace_back(chart.samples, medium.samples, options);
      }
      const auto& target = medium.samples.reflectance;
      const msi::ViewingConditions conditions(
        vtkTable::GetData(inputs[2]), vtkTable::GetData(inputs[3]), this->Observer);
      const msi::HeldOutJudge judge(*chart.bands.wavelengths, msi::namesIn(this->Illuminants),
        conditions, this->Difference, target);
      const auto draws = static_cast<std::size_t>(this->Draws);
      msi::FigureStore store(counts.size(), draws, options.methods.size(), judge.metrics().size());

      // Exceptions must not leave a thread; the first one is kept for the caller.
      auto* controller = msi::controllerOfTables();
      const vtkIdType ranks = controller ? controller->GetNumberOfProcesses() : 1;
      const vtkIdType rank = controller ? controller->GetLocalProcessId() : 0;
      const auto tasks = static_cast<vtkIdType>(counts.size()) * static_cast<vtkIdType>(draws);
      std::mutex failureLock;
      std::string failure;
      const auto runTask = [&](vtkIdType task)
      {
        const auto count = static_cast<std::size_t>(task) / draws;
        const auto draw = static_cast<std::size_t>(task) % draws;
        const auto result = comparisons[count].run(draw);
        for (std::size_t method = 0; method < result.estimates.size(); ++method)
        {
          if (!result.estimates[method].failure.empty())
          {
            std::fill_n(store.at(count, draw, method, 0), judge.metrics().size() * msi::FigureCount,
              std::nan(""));
            continue;
          }
          const auto figures = judge(result.estimates[method], result.heldOut);
          for (std::size_t metric = 0; metric < figures.size(); ++metric)
          {
            std::copy(figures[metric].begin(), figures[metric].end(),
              store.at(count, draw, method, metric));
          }
        }
      };
      const vtkIdType round =
        std::max<vtkIdType>(2 * ranks * vtkSMPTools::GetEstimatedNumberOfThreads(), tasks / 50);
      for (vtkIdType first = 0; first < tasks && !this->GetAbortExecute(); first += round)
      {
        const auto last = std::min(first + round, tasks);
        vtkSMPTools::For(first, last, 1,
          [&](vtkIdType begin, vtkIdType end)
          {
            for (vtkIdType task = begin; task < end; ++task)
            {
              try
              {
                if (task % ranks == rank)
                {
                  runTask(task);
                }
              }
              catch (const std::exception& error)
              {
                const std::lock_guard<std::mutex> hold(failureLock);
                failure = error.what();
              }
            }
          });
        this->UpdateProgress(static_cast<double>(last) / static_cast<double>(tasks));
      }
      if (failure.empty() && this->GetAbortExecute())
      {
        failure = "stopped by the user";
      }
      msi::throwOnAnyRank(failure, controller);
      store.sumOverRanks(controller);
      std::vector<LeftOutMethod> without;
      std::size_t complete = 0;
      for (std::size_t method = 0; method < options.methods.size(); ++method)
      {
        without.push_back(leftOut(comparisons, method, draws, store));
        complete += without.back().counts.size() < counts.size() ? 1 : 0;
      }
      if (complete == 0)
      {
        throw std::invalid_argument(
          "method " + options.methods.front() + ": " + without.front().reason);
      }
      if (msi::isEmptyPiece(outputs))
      {
        return;
      }

      RowTable results(vtkTable::GetData(outputs, 0), false);
      RowTable perDraw(vtkTable::GetData(outputs, 1), true);
      auto* curves = vtkTable::GetData(outputs, 3);
      Eigen::VectorXd tuning(counts.size());
      Eigen::MatrixXd meanRms = Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(counts.size()),
        static_cast<Eigen::Index>(options.methods.size()), std::nan(""));
      const auto channels = chart.samples.channels();
      for (std::size_t count = 0; count < counts.size(); ++count)
      {
        tuning[static_cast<Eigen::Index>(count)] = static_cast<double>(counts[count]);
        for (std::size_t method = 0; method < options.methods.size(); ++method)
        {
          const std::string& name = options.methods[method];
          for (std::size_t metric = 0; metric < judge.metrics().size(); ++metric)
          {
            double mean[msi::FigureCount] = {};
            for (std::size_t draw = 0; draw < draws; ++draw)
            {
              const double* figures = store.at(count, draw, method, metric);
              for (std::size_t i = 0; i < msi::FigureCount; ++i)
              {
                mean[i] += figures[i] / static_cast<double>(draws);
              }
            }
            if (std::isnan(mean[0]))
            {
              continue; // a method that was left out, or coverage of one without uncertainty
            }
            for (std::size_t draw = 0; draw < draws; ++draw)
            {
              perDraw.add(name, channels, counts[count], draw + 1, judge.metrics()[metric],
                store.at(count, draw, method, metric));
            }
            results.add(name, channels, counts[count], 0, judge.metrics()[metric], mean);
            if (metric == 0)
            {
              meanRms(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(method)) =
                mean[0];
            }
          }
        }
      }
      msi::setNumbers(curves, "tuning", tuning);
      for (std::size_t method = 0; method < options.methods.size(); ++method)
      {
        if (without[method].counts.size() < counts.size())
        {
          msi::setNumbers(
            curves, options.methods[method], meanRms.col(static_cast<Eigen::Index>(method)));
        }
      }
      writeSpectra(*chart.bands.wavelengths, comparisons.front().run(0), target,
        vtkTable::GetData(outputs, 2));
      for (const auto& warning : { dead, deadOfTarget })
      {
        if (!warning.empty())
        {
          vtkWarningMacro(<< warning);
        }
      }
      for (std::size_t method = 0; method < options.methods.size(); ++method)
      {
        if (!without[method].counts.empty())
        {
          vtkWarningMacro(<< textOf(without[method], options.methods[method], counts));
        }
      }
    });
}
