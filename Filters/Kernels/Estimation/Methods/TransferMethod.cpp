#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/TransferEstimation.h"

namespace msi
{

namespace
{
EstimationFit fitTransferMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  TransferFit transfer = fitTransfer(calibration, tuning);
  return { std::make_shared<TransferEstimator>(transfer.estimator), transfer.summary, {}, {} };
}
}

EstimationMethod transferMethod()
{
  return { "transfer", "Transfer", "statistical transfer with uncertainty", fitTransferMethod };
}

} // namespace msi
