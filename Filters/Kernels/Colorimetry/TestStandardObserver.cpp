#include "Kernels/Colorimetry/StandardObserver.h"

#include <gtest/gtest.h>

#include <cmath>
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

// A table at 5 nm comes close to the observer at 1 nm that it was taken from.
TEST(StandardObserver, OnesOwnIsCarriedToOneNanometre)
{
  const auto& known = StandardObserver::named("2");
  const auto coarse = msi::WavelengthGrid::uniform(360.0, 830.0, 5.0);
  Eigen::Matrix3Xd functions(3, coarse.size());
  for (Eigen::Index i = 0; i < coarse.size(); ++i)
  {
    functions.col(i) = known.functions().col(5 * i);
  }
  const StandardObserver own("mine", coarse, functions);
  EXPECT_EQ(own.name(), "mine");
  EXPECT_EQ(own.wavelengths(), known.wavelengths());
  EXPECT_LT((own.functions() - known.functions()).cwiseAbs().maxCoeff(), 3e-3);
  const StandardObserver fine("mine", known.wavelengths(), known.functions());
  EXPECT_EQ(fine.functions(), known.functions());
}

TEST(StandardObserver, RefusesWhatIsNoObserver)
{
  const msi::WavelengthGrid grid({ 400.0, 401.0 });
  const auto message = [&grid](const Eigen::Matrix3Xd& functions) -> std::string
  {
    try
    {
      StandardObserver("mine", grid, functions);
    }
    catch (const std::invalid_argument& error)
    {
      return error.what();
    }
    return {};
  };
  Eigen::Matrix3Xd functions = Eigen::Matrix3Xd::Ones(3, 2);
  EXPECT_EQ(message(functions), "");
  functions(2, 1) = std::nan("");
  EXPECT_EQ(message(functions), "observer 'mine' has a value that is not finite at 401 nm");
  functions.setZero();
  EXPECT_NE(message(functions).find("y-bar"), std::string::npos);
  EXPECT_EQ(message(Eigen::Matrix3Xd::Ones(3, 3)),
    "observer 'mine' has 3 values of each function for 2 wavelengths; expected one each");
}

}
