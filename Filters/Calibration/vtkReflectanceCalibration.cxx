#include "vtkReflectanceCalibration.h"

#include "AlgorithmSupport.h"
#include "FitSummaryTable.h"
#include "ResponseRange.h"
#include "SampleColumns.h"
#include "TransformTable.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RidgeCalibration.h"

vtkStandardNewMacro(vtkReflectanceCalibration);

vtkReflectanceCalibration::vtkReflectanceCalibration()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

void vtkReflectanceCalibration::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "RankTolerance: " << this->RankTolerance << "\n";
}

int vtkReflectanceCalibration::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkReflectanceCalibration::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  msi::requestWhole(inputs, 0);
  return 1;
}

int vtkReflectanceCalibration::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* input = vtkTable::GetData(inputs[0]);
      const auto measured = msi::requireMeasuredSamples(input, "the calibration table");
      const auto fit = this->Method == RIDGE
        ? msi::fitRidge(measured.samples).fit
        : msi::fitPseudoinverse(measured.samples, { this->RankTolerance });
      if (!fit.summary.complete)
      {
        vtkWarningMacro(<< fit.summary.status);
      }
      for (const auto& doubt : msi::doubtsOf(measured))
      {
        vtkWarningMacro(<< doubt);
      }
      msi::writeResponseRange(vtkTable::GetData(outputs, 0), { measured.samples.response });
      msi::write(msi::ReflectanceTransform{ measured.bands, measured.channels, fit.transform },
        vtkTable::GetData(outputs, 0));
      msi::write(
        this->Method == RIDGE ? "ridge" : "direct", fit.summary, vtkTable::GetData(outputs, 1));
    });
}
