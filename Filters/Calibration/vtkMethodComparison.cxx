#include "vtkMethodComparison.h"

#include "AlgorithmSupport.h"
#include "HeldOutFigures.h"
#include "NameList.h"
#include "SampleColumns.h"
#include "ThreadedParts.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Kernels/Estimation/CrossedErrors.h"
#include "Kernels/Estimation/MethodComparison.h"
#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

vtkStandardNewMacro(vtkMethodComparison);

namespace
{
// Numbers of tuning samples in a property's text.
std::vector<Eigen::Index> countsOf(const std::string& text, const std::string& property)
{
  std::vector<Eigen::Index> counts;
  for (const auto& word : msi::namesIn(text))
  {
    if (word.find_first_not_of("0123456789") != std::string::npos || word.size() > 6)
    {
      std::ostringstream message;
      message << property << " holds '" << word
              << "'; expected whole numbers separated by commas, like 6, 16, 36";
      throw std::invalid_argument(message.str());
    }
    counts.push_back(std::stol(word));
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

std::string titleOf(const msi::ErrorName& name)
{
  return name.illuminant.empty() ? name.metric : name.metric + " " + name.illuminant;
}

// A number of tuning samples, how often it is drawn, and the metrics of which every sample's error is kept.
struct TuningCount
{
  Eigen::Index samples = 0;
  std::size_t draws = 0;
  std::size_t metrics = 0;
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
LeftOutMethod leftOut(const std::vector<msi::MethodComparison>& comparisons,
  const std::vector<TuningCount>& counts, std::size_t method, msi::FigureStore& store)
{
  LeftOutMethod result;
  for (std::size_t count = 0; count < comparisons.size(); ++count)
  {
    for (std::size_t draw = 0; draw < counts[count].draws; ++draw)
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
  const LeftOutMethod& method, const std::string& name, const std::vector<TuningCount>& counts)
{
  std::ostringstream text;
  text << "the method " << name << " is left out";
  if (method.counts.size() < counts.size())
  {
    const char* separator = " with ";
    for (const auto count : method.counts)
    {
      text << std::exchange(separator, ", ");
      text << (count == method.counts.back() ? msi::counted(counts[count].samples, "tuning sample")
                                             : std::to_string(counts[count].samples));
    }
  }
  text << ": " << method.reason;
  return text.str();
}

// The rms of every method against the number of tuning samples.
template <typename TakesPart>
void writeCurves(const std::vector<std::size_t>& order, const std::vector<TuningCount>& counts,
  const std::vector<std::string>& methods, const TakesPart& takesPart,
  msi::SampleErrorStore& errors, const msi::HeldOutErrors& ofOwnMedium, vtkTable* table)
{
  const auto rows = static_cast<Eigen::Index>(order.size());
  Eigen::VectorXd tuning(rows);
  Eigen::VectorXd draws(rows);
  const auto size = static_cast<Eigen::Index>(methods.size());
  Eigen::MatrixXd means = Eigen::MatrixXd::Constant(rows, size, std::nan(""));
  Eigen::MatrixXd lows = means;
  Eigen::MatrixXd highs = means;
  std::vector<bool> shown(methods.size(), false);
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const auto count = order[static_cast<std::size_t>(row)];
    tuning[row] = static_cast<double>(counts[count].samples);
    draws[row] = static_cast<double>(counts[count].draws);
    for (std::size_t method = 0; method < methods.size(); ++method)
    {
      if (takesPart(count, method))
      {
        const auto column = static_cast<Eigen::Index>(method);
        const auto interval = msi::meanError(errors.at(count, method, 0));
        means(row, column) = interval.value;
        lows(row, column) = interval.low;
        highs(row, column) = interval.high;
        shown[method] = true;
      }
    }
  }
  msi::setNumbers(table, "tuning", tuning);
  for (const auto& [values, suffix] :
    { std::pair(&means, ""), std::pair(&lows, " low"), std::pair(&highs, " high") })
  {
    for (std::size_t method = 0; method < methods.size(); ++method)
    {
      if (shown[method])
      {
        msi::setNumbers(
          table, methods[method] + suffix, values->col(static_cast<Eigen::Index>(method)));
      }
    }
  }
  if (!ofOwnMedium.figures.empty())
  {
    msi::setNumbers(
      table, "own-medium", Eigen::VectorXd::Constant(rows, ofOwnMedium.figures[0][0]));
  }
  msi::setNumbers(table, "draws", draws);
}

// The errors of every sample, at the first number of tuning samples.
template <typename TakesPart>
void writeSamples(vtkTable* target, const std::vector<msi::ErrorName>& metrics,
  const std::vector<std::string>& methods, const TakesPart& takesPart,
  msi::SampleErrorStore& errors, const msi::HeldOutErrors& ofOwnMedium, vtkTable* table)
{
  vtkNew<vtkStringArray> names;
  names->SetName("sample");
  for (const auto& name : msi::sampleNames(target))
  {
    names->InsertNextValue(name);
  }
  table->AddColumn(names);
  bool counted = false;
  for (std::size_t metric = 0; metric < errors.metrics(0); ++metric)
  {
    for (std::size_t method = 0; method < methods.size(); ++method)
    {
      if (!takesPart(0, method))
      {
        continue;
      }
      const auto known = errors.at(0, method, metric).array();
      const Eigen::ArrayXd heldOut =
        (!known.isNaN()).template cast<double>().colwise().sum().transpose();
      if (!std::exchange(counted, true))
      {
        msi::setNumbers(table, "held out", heldOut.matrix());
      }
      const Eigen::ArrayXd sums = known.isNaN().select(0.0, known).colwise().sum().transpose();
      msi::setNumbers(
        table, methods[method] + " " + titleOf(metrics[metric]), (sums / heldOut).matrix());
    }
    if (!ofOwnMedium.samples.empty())
    {
      msi::setNumbers(table, "own-medium " + titleOf(metrics[metric]), ofOwnMedium.samples[metric]);
    }
  }
}

// Which of two methods is better, a row a pair and metric.
class PairTable
{
public:
  explicit PairTable(vtkTable* table)
  {
    const auto name = [table](vtkAbstractArray* column, const char* text)
    {
      column->SetName(text);
      table->AddColumn(column);
    };
    name(Method, "method");
    name(Against, "against");
    name(Tuning, "tuning");
    name(MetricName, "metric");
    name(Illuminant, "illuminant");
    name(Ratio, "ratio");
    name(Low, "low");
    name(High, "high");
    name(Wins, "wins");
    name(Better, "better");
  }

  void add(const std::string& method, const std::string& against, Eigen::Index tuning,
    const msi::ErrorName& metric, const msi::PairedErrors& pair)
  {
    Method->InsertNextValue(method);
    Against->InsertNextValue(against);
    Tuning->InsertNextValue(static_cast<int>(tuning));
    MetricName->InsertNextValue(metric.metric);
    Illuminant->InsertNextValue(metric.illuminant);
    Ratio->InsertNextValue(pair.ratio.value);
    Low->InsertNextValue(pair.ratio.low);
    High->InsertNextValue(pair.ratio.high);
    Wins->InsertNextValue(pair.wins);
    Better->InsertNextValue(pair.sign() < 0 ? method : pair.sign() > 0 ? against : "");
  }

private:
  vtkNew<vtkStringArray> Method;
  vtkNew<vtkStringArray> Against;
  vtkNew<vtkIntArray> Tuning;
  vtkNew<vtkStringArray> MetricName;
  vtkNew<vtkStringArray> Illuminant;
  vtkNew<vtkDoubleArray> Ratio;
  vtkNew<vtkDoubleArray> Low;
  vtkNew<vtkDoubleArray> High;
  vtkNew<vtkDoubleArray> Wins;
  vtkNew<vtkStringArray> Better;
};

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
  this->SetNumberOfOutputPorts(6);
}

void vtkMethodComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Methods: " << this->Methods << "\n"
     << indent << "TuningSamples: " << this->TuningSamples << "\n"
     << indent << "CurveSamples: " << this->CurveSamples << "\n"
     << indent << "CurveDraws: " << this->CurveDraws << "\n"
     << indent << "Draws: " << this->Draws << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "Difference: " << this->Difference << "\n"
     << indent << "Illuminants: " << this->Illuminants << "\n"
     << indent << "OtherIlluminants: " << this->OtherIlluminants << "\n"
     << indent << "IlluminantFile: " << this->IlluminantFile << "\n"
     << indent << "ObserverFile: " << this->ObserverFile << "\n"
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

void vtkMethodComparison::AddMethod(const char* name)
{
  this->SetMethods(msi::withNames(this->Methods, name).c_str());
}

void vtkMethodComparison::ClearMethods()
{
  this->SetMethods("");
}

void vtkMethodComparison::AddIlluminant(const char* name)
{
  this->SetIlluminants(msi::withNames(this->Illuminants, name).c_str());
}

void vtkMethodComparison::ClearIlluminants()
{
  this->SetIlluminants("");
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
      msi::requireAlike(chart, medium);
      msi::ComparisonOptions options;
      options.methods = msi::namesIn(this->Methods);
      if (options.methods == std::vector<std::string>{ "all" })
      {
        options.methods = msi::allMethodNames();
      }
      options.seed = static_cast<std::uint64_t>(this->Seed);
      options.channelWavelengths = chart.channels.wavelengths;

      const auto& target = medium.samples.reflectance;
      const msi::ViewingConditions conditions(vtkTable::GetData(inputs[2]),
        vtkTable::GetData(inputs[3]), this->Observer, { this->IlluminantFile, this->ObserverFile });
      const auto illuminants = conditions.withFile(
        msi::namesIn(msi::withNames(this->Illuminants, this->OtherIlluminants)));
      const msi::HeldOutJudge judge(
        *chart.bands.wavelengths, illuminants, conditions, this->Difference, target);
      const std::size_t judged = judge.metrics().size() - msi::IntervalCount;
      const auto draws = static_cast<std::size_t>(this->Draws);

      std::vector<TuningCount> counts;
      for (const auto samples : countsOf(this->TuningSamples, "TuningSamples"))
      {
        counts.push_back({ samples, draws, judged });
      }
      if (counts.empty())
      {
        throw std::invalid_argument(
          "TuningSamples is empty; expected at least one number, like 16");
      }
      const std::size_t whole = counts.size(); // what follows is for the curves alone
      for (const auto samples : countsOf(this->CurveSamples, "CurveSamples"))
      {
        if (std::none_of(counts.begin(), counts.end(),
              [samples](const TuningCount& known) { return known.samples == samples; }))
        {
          counts.push_back(
            { samples, std::min(draws, static_cast<std::size_t>(this->CurveDraws)), 1 });
        }
      }
      std::vector<msi::MethodComparison> comparisons;
      std::vector<msi::SampleErrorStore::Count> kept;
      std::vector<std::pair<std::size_t, std::size_t>> tasks; // number of tuning samples, draw
      for (std::size_t count = 0; count < counts.size(); ++count)
      {
        options.tuningSamples = counts[count].samples;
        options.uncertainty = count < whole;
        comparisons.emplace_back(chart.samples, medium.samples, options);
        kept.push_back({ counts[count].draws, counts[count].metrics });
        for (std::size_t draw = 0; draw < counts[count].draws; ++draw)
        {
          tasks.emplace_back(count, draw);
        }
      }
      msi::FigureStore store(counts.size(), draws, options.methods.size(), judge.metrics().size());
      msi::SampleErrorStore errors(
        kept, options.methods.size(), static_cast<std::size_t>(target.cols()));
      msi::ComparisonDraw firstDraw; // on the rank that runs it

      auto* controller = msi::controllerOfTables();
      const vtkIdType ranks = controller ? controller->GetNumberOfProcesses() : 1;
      const vtkIdType rank = controller ? controller->GetLocalProcessId() : 0;
      const auto taskCount = static_cast<vtkIdType>(tasks.size());
      const auto runTask = [&](vtkIdType task)
      {
        const auto [count, draw] = tasks[static_cast<std::size_t>(task)];
        auto result = comparisons[count].run(draw);
        for (std::size_t method = 0; method < result.estimates.size(); ++method)
        {
          if (!result.estimates[method].failure.empty())
          {
            std::fill_n(store.at(count, draw, method, 0), judge.metrics().size() * msi::FigureCount,
              std::nan(""));
            continue;
          }
          const auto found = judge(result.estimates[method], result.heldOut);
          for (std::size_t metric = 0; metric < found.figures.size(); ++metric)
          {
            std::copy(found.figures[metric].begin(), found.figures[metric].end(),
              store.at(count, draw, method, metric));
          }
          for (std::size_t metric = 0; metric < counts[count].metrics; ++metric)
          {
            auto row = errors.at(count, method, metric).row(static_cast<Eigen::Index>(draw));
            row.setConstant(std::nan(""));
            row(result.heldOut) = found.samples[metric].transpose();
          }
        }
        if (task == 0)
        {
          firstDraw = std::move(result);
        }
      };
      const vtkIdType mine = (taskCount - rank + ranks - 1) / ranks;
      msi::beforeRanksMeet(controller,
        [&] { msi::forParts(this, mine, [&](vtkIdType part) { runTask(rank + part * ranks); }); });
      store.sumOverRanks(controller);
      errors.sumOverRanks(controller);
      std::vector<LeftOutMethod> without;
      std::size_t complete = 0;
      for (std::size_t method = 0; method < options.methods.size(); ++method)
      {
        without.push_back(leftOut(comparisons, counts, method, store));
        // Numbers beyond those asked for are of the curves alone.
        const std::vector<std::size_t>& missing = without.back().counts;
        complete += std::lower_bound(missing.begin(), missing.end(), whole) - missing.begin() <
            static_cast<std::ptrdiff_t>(whole)
          ? 1
          : 0;
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
      const auto channels = chart.samples.channels();
      for (std::size_t count = 0; count < whole; ++count)
      {
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
              perDraw.add(name, channels, counts[count].samples, draw + 1, judge.metrics()[metric],
                store.at(count, draw, method, metric));
            }
            results.add(name, channels, counts[count].samples, 0, judge.metrics()[metric], mean);
          }
        }
      }

      const auto takesPart = [&](std::size_t count, std::size_t method)
      {
        const auto& out = without[method].counts;
        return std::find(out.begin(), out.end(), count) == out.end();
      };
      msi::HeldOutErrors ofOwnMedium;
      const auto own = comparisons.front().ownMedium();
      if (own.failure.empty())
      {
        std::vector<Eigen::Index> all(static_cast<std::size_t>(target.cols()));
        std::iota(all.begin(), all.end(), 0);
        ofOwnMedium = judge(own, all);
      }
      std::vector<std::size_t> order(counts.size());
      std::iota(order.begin(), order.end(), std::size_t{ 0 });
      std::sort(order.begin(), order.end(),
        [&](std::size_t a, std::size_t b) { return counts[a].samples < counts[b].samples; });
      writeCurves(order, counts, options.methods, takesPart, errors, ofOwnMedium,
        vtkTable::GetData(outputs, 3));
      writeSamples(vtkTable::GetData(inputs[1]), judge.metrics(), options.methods, takesPart,
        errors, ofOwnMedium, vtkTable::GetData(outputs, 4));
      PairTable pairs(vtkTable::GetData(outputs, 5));
      for (std::size_t count = 0; count < whole; ++count)
      {
        for (std::size_t first = 0; first < options.methods.size(); ++first)
        {
          for (std::size_t second = 0; second < options.methods.size(); ++second)
          {
            const bool both =
              first != second && takesPart(count, first) && takesPart(count, second);
            for (std::size_t metric = 0; both && metric < judged; ++metric)
            {
              pairs.add(options.methods[first], options.methods[second], counts[count].samples,
                judge.metrics()[metric],
                msi::compareErrors(
                  errors.at(count, first, metric), errors.at(count, second, metric)));
            }
          }
        }
      }
      if (firstDraw.estimates.empty()) // another rank ran it
      {
        firstDraw = comparisons.front().run(0);
      }
      writeSpectra(
        *chart.bands.wavelengths, std::move(firstDraw), target, vtkTable::GetData(outputs, 2));
      for (const auto& doubt : msi::doubtsOf(chart, &medium))
      {
        vtkWarningMacro(<< doubt);
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
