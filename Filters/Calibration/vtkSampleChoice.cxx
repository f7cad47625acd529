#include "vtkSampleChoice.h"

#include "AlgorithmSupport.h"
#include "SampleColumns.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Estimation/SampleChoice.h"

vtkStandardNewMacro(vtkSampleChoice);

vtkSampleChoice::vtkSampleChoice()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

void vtkSampleChoice::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Count: " << this->Count << "\n";
}

int vtkSampleChoice::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkSampleChoice::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  msi::requestWhole(inputs, 1);
  return 1;
}

int vtkSampleChoice::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* candidates = vtkTable::GetData(inputs[1]);
      const auto ofChart = msi::requireSpectra(
        vtkTable::GetData(inputs[0]), msi::SampleQuantity::Response, "the calibration table");
      const auto ofCandidates =
        msi::requireSpectra(candidates, msi::SampleQuantity::Response, "the candidates table");
      msi::requireSameChannels(
        ofChart.axis, "the calibration table", ofCandidates.axis, "the candidates table");
      const auto choice = msi::chooseSamples(ofChart.values, ofCandidates.values, this->Count);

      vtkNew<vtkTable> chosen;
      msi::copyRows(candidates, choice.samples, chosen);
      const auto count = static_cast<Eigen::Index>(choice.samples.size());
      auto* output = vtkTable::GetData(outputs, 0);
      msi::setNumbers(
        output, "rank", Eigen::VectorXd::LinSpaced(count, 1.0, static_cast<double>(count)));
      for (vtkIdType column = 0; column < chosen->GetNumberOfColumns(); ++column)
      {
        output->AddColumn(chosen->GetColumn(column));
      }
      msi::setNumbers(
        output, "explained", Eigen::Map<const Eigen::VectorXd>(choice.explained.data(), count));
    });
}
