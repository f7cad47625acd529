// Solves the problem on standard input with the kernels and prints every transform and estimate, for
// reference_estimation.py to compare.
#include "Kernels/Estimation/EstimationMethod.h"
#include "Kernels/Estimation/MetamerismCorrection.h"
#include "Kernels/Estimation/NamedMatrixText.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RModelCorrection.h"

#include <exception>
#include <iostream>

int main()
{
  try
  {
    const auto given = msi::readNamedMatrices(std::cin);
    const msi::SampleSet calibration{ given.at("R"), given.at("U") };
    const msi::SampleSet tuning{ given.at("S"), given.at("V") };
    msi::MetamerismOptions options;
    options.structure = given.at("neighbours")(0, 0) > 0.5 ? msi::BandStructure::Tridiagonal
                                                           : msi::BandStructure::Diagonal;
    const auto direct = msi::fitPseudoinverse(calibration);
    const auto rModel = msi::fitRModel(direct.transform(tuning.response), tuning.reflectance);
    const auto banded = msi::fitMetamerismCorrection(calibration, tuning, options);
    const auto print = [](const char* name, const msi::AffineTransform& transform)
    { msi::writeNamedMatrix(std::cout, name, transform.coefficients()); };
    print("direct", direct.transform);
    print("pinv", msi::fitPseudoinverse(tuning).transform);
    print("pooled", msi::fitPooled(calibration, tuning).transform);
    print("r_model", msi::AffineTransform::compose(rModel.correction, direct.transform));
    print("banded_w", banded.reflectance);
    print("banded_d", banded.metamerism);
    print("banded", banded.composite);
    if (given.count("X") != 0)
    {
      for (const char* name : { "wiener", "adaptive-wiener", "pca", "kernel-ridge", "local-linear",
             "polynomial", "root-polynomial" })
      {
        const auto fit = msi::estimationMethodNamed(name).fit(calibration, tuning, {});
        msi::writeNamedMatrix(std::cout, name, (*fit.estimator)(given.at("X")));
      }
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
