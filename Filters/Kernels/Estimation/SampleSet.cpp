#include "Kernels/Estimation/SampleSet.h"

#include "Kernels/Spectra/Reject.h"

#include <cmath>

namespace msi
{

void requireFinite(
  const Eigen::MatrixXd& values, const std::string& name, const std::string& rowName)
{
  for (Eigen::Index sample = 0; sample < values.cols(); ++sample)
  {
    for (Eigen::Index row = 0; row < values.rows(); ++row)
    {
      const double value = values(row, sample);
      if (!std::isfinite(value))
      {
        reject(name, " sample ", sample + 1, ", ", rowName, " ", row + 1, " is ", value,
          "; expected a finite number");
      }
    }
  }
}

SampleSet SampleSet::subset(const std::vector<Eigen::Index>& columns) const
{
  return { reflectance(Eigen::all, columns), response(Eigen::all, columns) };
}

void requireValid(const SampleSet& samples, const std::string& name)
{
  if (samples.bands() < 1 || samples.channels() < 1 || samples.reflectance.cols() < 1)
  {
    reject(name, " has ", samples.reflectance.cols(), " samples, ", samples.bands(),
      " reflectance bands and ", samples.channels(),
      " response channels; expected at least one of each");
  }
  if (samples.reflectance.cols() != samples.response.cols())
  {
    reject(name, " has ", samples.reflectance.cols(), " reflectances but ", samples.response.cols(),
      " responses; expected one of each per sample");
  }
  requireFinite(samples.reflectance, name, "reflectance band");
  requireFinite(samples.response, name, "response channel");
}

void requireSameShape(
  const SampleSet& a, const std::string& nameOfA, const SampleSet& b, const std::string& nameOfB)
{
  const auto compare = [&](Eigen::Index ofA, Eigen::Index ofB, const char* what)
  {
    if (ofA != ofB)
    {
      reject(nameOfA, " has ", ofA, " ", what, " but ", nameOfB, " has ", ofB,
        "; expected the same ", what, " in both");
    }
  };
  compare(a.bands(), b.bands(), "reflectance bands");
  compare(a.channels(), b.channels(), "response channels");
}

SampleSet joined(const SampleSet& a, const SampleSet& b)
{
  SampleSet both;
  both.reflectance.resize(a.bands(), a.size() + b.size());
  both.reflectance << a.reflectance, b.reflectance;
  both.response.resize(a.channels(), a.size() + b.size());
  both.response << a.response, b.response;
  return both;
}

} // namespace msi
