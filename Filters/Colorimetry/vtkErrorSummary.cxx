#include "vtkErrorSummary.h"

#include "AlgorithmSupport.h"
#include "ErrorStatisticsReduction.h"
#include "ErrorSummaryTable.h"
#include "ImageBlocks.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkTable.h"

#include "Kernels/Difference/ErrorOrderStatistics.h"

#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkErrorSummary);

namespace
{
constexpr int NumberOfPasses = 2;

// One component of one array.
struct ErrorMap
{
  msi::ErrorName name;
  vtkDataArray* array;
  int component;
};

std::vector<ErrorMap> errorMapsOf(vtkImageData* image)
{
  std::vector<ErrorMap> maps;
  auto* points = image->GetPointData();
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    auto* array = points->GetArray(i);
    for (int c = 0; array && c < array->GetNumberOfComponents(); ++c)
    {
      const char* text = array->GetNumberOfComponents() == 1 && !array->HasAComponentName()
        ? array->GetName()
        : array->GetComponentName(c);
      if (const auto name = msi::errorNameIn(text ? text : ""))
      {
        maps.push_back({ *name, array, c });
      }
    }
  }
  if (maps.empty())
  {
    throw std::invalid_argument(
      "the image has no error map; expected arrays or components named 'rms' or "
      "'dE00 D65', as CIEDE2000 Evaluator makes them");
  }
  return maps;
}

std::vector<float> valuesOf(const ErrorMap& map)
{
  const auto count = map.array->GetNumberOfTuples();
  std::vector<float> values(static_cast<std::size_t>(count));
  auto* floats = vtkFloatArray::FastDownCast(map.array);
  const int stride = map.array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < count; ++i)
  {
    values[static_cast<std::size_t>(i)] = floats
      ? floats->GetValue(i * stride + map.component)
      : static_cast<float>(map.array->GetComponent(i, map.component));
  }
  return values;
}
}

// What the passes have found so far.
struct vtkErrorSummary::Passes
{
  msi::ImageBlocks blocks;
  std::vector<msi::ErrorName> names;
  std::vector<msi::ErrorStatistics> first;
  std::vector<msi::ErrorOrderStatistics> second;

  void reset()
  {
    names.clear();
    first.clear();
    second.clear();
  }

  void add(vtkImageData* image)
  {
    const auto maps = errorMapsOf(image);
    if (first.empty())
    {
      for (const auto& map : maps)
      {
        names.push_back(map.name);
      }
      first.resize(maps.size());
    }
    if (maps.size() != first.size())
    {
      throw std::runtime_error("the pipeline gave " + std::to_string(maps.size()) +
        " error maps where it gave " + std::to_string(first.size()) + " before");
    }
    for (std::size_t i = 0; i < maps.size(); ++i)
    {
      const auto values = valuesOf(maps[i]);
      if (blocks.pass() == 0)
      {
        first[i].add(values.data(), values.size());
      }
      else
      {
        second[i].add(values.data(), values.size());
      }
    }
  }

  // Between the passes: the first one of all ranks, which the second needs. Collective.
  void meet(vtkMultiProcessController* controller)
  {
    const int mine = static_cast<int>(first.size());
    int all = mine;
    if (controller)
    {
      controller->AllReduce(&mine, &all, 1, vtkCommunicator::MAX_OP);
    }
    first.resize(static_cast<std::size_t>(all)); // on a rank without rows
    for (auto& statistics : first)
    {
      statistics =
        msi::ErrorStatistics::fromArray(msi::sumOverRanks(statistics.toArray(), controller));
      second.emplace_back(statistics);
    }
  }

  // Collective.
  void write(vtkMultiProcessController* controller, vtkTable* table)
  {
    for (auto& statistics : second)
    {
      statistics.setArray(msi::sumOverRanks(statistics.toArray(), controller));
    }
    if (!table)
    {
      return;
    }
    msi::ErrorSummaryTable summary(table);
    for (std::size_t i = 0; i < second.size(); ++i)
    {
      summary.add(names[i], second[i].summary());
    }
  }
};

vtkErrorSummary::vtkErrorSummary()
  : Current(std::make_unique<Passes>())
{
}

vtkErrorSummary::~vtkErrorSummary() = default;

void vtkErrorSummary::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "BlockSize: " << this->BlockSize << "\n";
}

int vtkErrorSummary::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkErrorSummary::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  msi::declareCollective(outputs);
  return 1;
}

int vtkErrorSummary::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  auto& blocks = this->Current->blocks;
  blocks.setBlockBytes(static_cast<long long>(this->BlockSize) << 20);
  if (blocks.request(inputs, { 0 }))
  {
    this->Current->reset();
  }
  return 1;
}

int vtkErrorSummary::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto& passes = *this->Current;
  auto* controller = msi::controllerOfTables();
  std::string failure;
  try
  {
    if (this->GetAbortExecute())
    {
      throw std::runtime_error("stopped by the user");
    }
    if (!passes.blocks.isEmpty())
    {
      passes.add(msi::partOf(vtkImageData::GetData(inputs[0]), passes.blocks.block()));
    }
    this->UpdateProgress((passes.blocks.pass() + passes.blocks.progress()) / NumberOfPasses);
  }
  catch (const std::exception& error)
  {
    failure = error.what();
  }
  const int pass = passes.blocks.pass();
  const bool goesOn = failure.empty() && passes.blocks.next(request, NumberOfPasses);
  if (goesOn && passes.blocks.pass() == pass)
  {
    return 1;
  }
  // The ranks meet at the end of each pass, and where one failed before.
  const int result = msi::runAlgorithm(this, outputs,
    [&]
    {
      msi::throwOnAnyRank(failure, controller);
      if (goesOn)
      {
        passes.meet(controller);
        return;
      }
      const bool mine = outputs->GetInformationObject(0)->Get(
                          vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) == 0;
      passes.write(controller, mine ? vtkTable::GetData(outputs, 0) : nullptr);
      passes.reset();
    });
  if (result == 0)
  {
    passes.blocks.stop(request);
  }
  return result;
}
