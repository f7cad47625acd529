#include "vtkSampleCheck.h"

#include "AlgorithmSupport.h"
#include "SampleColumns.h"

#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

vtkStandardNewMacro(vtkSampleCheck);

vtkSampleCheck::vtkSampleCheck()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

void vtkSampleCheck::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SamplesName: " << this->SamplesName << "\n";
}

int vtkSampleCheck::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSampleCheck::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  msi::requestWhole(inputs, 1);
  return 1;
}

int vtkSampleCheck::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      const auto samples = msi::readSamples(vtkTable::GetData(inputs[0]), this->SamplesName);
      std::vector<std::string> doubts;
      if (auto* table = vtkTable::GetData(inputs[1]))
      {
        const auto chart = msi::readSamples(table, "the calibration table");
        msi::requireAlike(chart, samples);
        doubts = msi::doubtsOf(chart, &samples);
      }
      else
      {
        doubts = msi::doubtsOf(samples);
      }
      vtkNew<vtkStringArray> questions;
      questions->SetName("question");
      for (const auto& doubt : doubts)
      {
        questions->InsertNextValue(doubt);
        vtkWarningMacro(<< doubt);
      }
      vtkTable::GetData(outputs, 0)->AddColumn(questions);
    });
}
