#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/Transfer/TransferEstimation.h"

#include <stdexcept>

namespace msi
{

namespace
{
EstimationFit fitTransferMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& options)
{
  if (calibration.size() == 1)
  {
    throw std::invalid_argument(
      "transfer has 1 calibration sample; expected at least 2, which tell "
      "the range of the responses");
  }
  TransferFit transfer = fitTransfer(calibration, tuning, options.uncertainty);
  return { std::make_shared<TransferEstimator>(transfer.estimator), transfer.summary, {}, {} };
}
}

EstimationMethod transferMethod()
{
  return { "transfer", "Transfer", "statistical transfer with uncertainty", fitTransferMethod };
}

} // namespace msi
