#include "Kernels/Estimation/EstimationMethod.h"

#include "Kernels/Estimation/Methods/Methods.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

const std::vector<EstimationMethod>& estimationMethods()
{
  static const std::vector<EstimationMethod> methods{ directMethod(), pinvMethod(), pooledMethod(),
    rModelMethod(), bandedMethod(), transferMethod(), wienerMethod(), adaptiveWienerMethod(),
    pcaMethod(), kernelRidgeMethod(), localLinearMethod(), polynomialMethod(),
    rootPolynomialMethod(), sparseMethod() };
  return methods;
}

const EstimationMethod& estimationMethodNamed(std::string_view name)
{
  std::ostringstream message;
  message << "there is no estimation method '" << name << "'; expected one of";
  const char* separator = " ";
  for (const EstimationMethod& method : estimationMethods())
  {
    if (method.name == name)
    {
      return method;
    }
    message << std::exchange(separator, ", ") << method.name;
  }
  throw std::invalid_argument(message.str());
}

EstimationFit linearFit(AffineTransform transform, FitSummary summary)
{
  auto identity = AffineTransform::identity(transform.inputs());
  EstimationFit fit;
  fit.estimator = std::make_shared<AffineEstimator>(transform);
  fit.summary = std::move(summary);
  fit.factors = LinearFactors{ std::move(transform), std::move(identity) };
  return fit;
}

} // namespace msi
