#include "Kernels/Colorimetry/StandardObserver.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

using msi::StandardObserver;

// The sums of the color-matching functions that CIE 15:2004 prints under the tables
// (380 to 780 nm at 5 nm).
TEST(StandardObserver, SumsMatchTheStandard)
{
  const auto sums = [](const StandardObserver& observer)
  {
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < observer.wavelengths().size(); ++i)
    {
      const int wavelength = static_cast<int>(observer.wavelengths()[i]);
      if (wavelength % 5 == 0 && wavelength >= 380 && wavelength <= 780)
      {
        total += observer.functions().col(i);
      }
    }
    return total;
  };
  const Eigen::Vector3d two = sums(StandardObserver::cie1931TwoDegree());
  EXPECT_LT((two - Eigen::Vector3d(21.371524, 21.371327, 21.371540)).cwiseAbs().maxCoeff(), 5e-5);
  const Eigen::Vector3d ten = sums(StandardObserver::cie1964TenDegree());
  EXPECT_LT((ten - Eigen::Vector3d(23.329353, 23.332036, 23.334153)).cwiseAbs().maxCoeff(), 5e-5);
}

TEST(StandardObserver, TablesRunFrom360To830At1Nanometre)
{
  for (const auto& name : StandardObserver::names())
  {
    const auto& observer = StandardObserver::named(name);
    EXPECT_EQ(observer.name(), name);
    EXPECT_EQ(observer.wavelengths(), msi::WavelengthGrid::uniform(360.0, 830.0, 1.0));
    EXPECT_EQ(observer.functions().cols(), 471);
  }
  // The luminous efficiency function peaks with 1 at 555 nm.
  EXPECT_EQ(StandardObserver::named("2").functions()(1, 555 - 360), 1.0);
  EXPECT_EQ(&StandardObserver::named("10"), &StandardObserver::cie1964TenDegree());
}

TEST(StandardObserver, AnUnknownNameListsTheKnownOnes)
{
  try
  {
    StandardObserver::named("CIE 2006");
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(),
      "unknown standard observer 'CIE 2006'; known are: 'CIE 1931 2 degree' 'CIE 1964 10 degree'");
  }
}

}
