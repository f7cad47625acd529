#include "vtkSampleSplit.h"

#include "AlgorithmSupport.h"
#include "SampleColumns.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Estimation/MethodComparison.h"
#include "Kernels/Spectra/Counted.h"

#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkSampleSplit);

vtkSampleSplit::vtkSampleSplit()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

void vtkSampleSplit::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << this->Mode << "\n"
     << indent << "Count: " << this->Count << "\n"
     << indent << "Seed: " << this->Seed << "\n"
     << indent << "Draw: " << this->Draw << "\n";
}

int vtkSampleSplit::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkSampleSplit::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  return 1;
}

int vtkSampleSplit::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* input = vtkTable::GetData(inputs[0]);
      const Eigen::Index samples = input ? input->GetNumberOfRows() : 0;
      const Eigen::Index count = this->Mode == RANDOM ? this->Count : (samples + 1) / 2;
      if (samples < 2 || count >= samples)
      {
        throw std::invalid_argument("the table has " + msi::counted(samples, "sample") + " and " +
          std::to_string(count) + (count == 1 ? " is" : " are") +
          " to be chosen; expected at least one sample on each side");
      }
      std::vector<Eigen::Index> chosen;
      if (this->Mode == RANDOM)
      {
        chosen = msi::drawSamples(samples, count, static_cast<std::uint64_t>(this->Seed),
          static_cast<std::uint64_t>(this->Draw));
      }
      else
      {
        for (Eigen::Index row = 0; row < samples; row += 2)
        {
          chosen.push_back(row);
        }
      }
      std::vector<Eigen::Index> others;
      auto next = chosen.begin();
      for (Eigen::Index row = 0; row < samples; ++row)
      {
        if (next != chosen.end() && *next == row)
        {
          ++next;
        }
        else
        {
          others.push_back(row);
        }
      }
      msi::copyRows(input, chosen, vtkTable::GetData(outputs, 0));
      msi::copyRows(input, others, vtkTable::GetData(outputs, 1));
    });
}
