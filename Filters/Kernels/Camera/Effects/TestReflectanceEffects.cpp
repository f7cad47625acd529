#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using msi::CameraEffect;
using msi::test::visibleGrid;

// A camera that reports the reflectance itself, and two samples: paper, fabric, both of reflectance r.
double seenOn(const char* medium, const CameraEffect& effect, double r, double wavelength)
{
  const msi::CameraModel identity(
    visibleGrid(), Eigen::MatrixXd::Identity(31, 31), Eigen::VectorXd::Zero(31));
  msi::SceneSamples samples;
  samples.reflectance = Eigen::MatrixXd::Constant(31, 2, r);
  samples.medium = { "paper", "fabric" };
  const Eigen::MatrixXd seen =
    msi::CameraSimulator(identity, { effect }).respond({ visibleGrid(), samples });
  return seen(
    static_cast<Eigen::Index>((wavelength - 400.0) / 10.0), medium == std::string("paper") ? 0 : 1);
}

TEST(ReflectanceEffects, ActOnTheirMediumOnly)
{
  const CameraEffect effects[] = { { "specular_component", "", "fabric", { 0.03 } },
    { "translucency", "", "fabric", { 0.3, 2.0 } }, { "interreflection", "", "fabric", { 0.3 } },
    { "fluorescence", "uncoloured", "fabric", { 0.1, 440.0, 18.0 } },
    { "medium_gain", "", "fabric", { 0.8 } } };
  for (const CameraEffect& effect : effects)
  {
    EXPECT_EQ(seenOn("paper", effect, 0.4, 440.0), 0.4) << effect.name;
    EXPECT_GT(std::abs(seenOn("fabric", effect, 0.4, 440.0) - 0.4), 0.01) << effect.name;
  }
}

TEST(SpecularComponent, IsAPedestal)
{
  EXPECT_NEAR(
    seenOn("paper", { "specular_component", "", "paper", { 0.03 } }, 0.4, 500.0), 0.43, 1e-15);
  EXPECT_NEAR(
    seenOn("paper", { "specular_component", "", "paper", { -0.03 } }, 0.4, 500.0), 0.37, 1e-15);
  const CameraEffect body{ "specular_component", "body", "paper", { 0.04 } };
  EXPECT_NEAR(seenOn("paper", body, 1.0, 500.0), 1.0, 1e-15);
  EXPECT_NEAR(seenOn("paper", body, 0.0, 500.0), 0.04, 1e-15);
}

TEST(Interreflection, IsTheSumOfAllBounces)
{
  const double p = 0.35;
  const double r = 0.7;
  double sum = 0.0;
  double travelling = r;
  for (int bounce = 0; bounce < 200; ++bounce)
  {
    sum += travelling * (1.0 - p);
    travelling *= p * r;
  }
  EXPECT_NEAR(seenOn("fabric", { "interreflection", "", "fabric", { p } }, r, 600.0), sum, 1e-14);
  EXPECT_NEAR(seenOn("fabric", { "interreflection", "", "fabric", { p } }, 1.0, 600.0), 1.0, 1e-15);
}

TEST(Translucency, TakesMoreFromLongWavesAndHighReflectances)
{
  const CameraEffect effect{ "translucency", "", "fabric", { 0.25, 2.0 } };
  EXPECT_NEAR(seenOn("fabric", effect, 0.8, 550.0), 0.8 / (1.0 + 0.25 * 0.8), 1e-15);
  const double square = std::pow(700.0 / 550.0, 2.0);
  EXPECT_NEAR(seenOn("fabric", effect, 0.8, 700.0), 0.8 / (1.0 + 0.25 * square * 0.8), 1e-15);
  const double share = [&](double r, double wavelength)
  { return 1.0 - seenOn("fabric", effect, r, wavelength) / r; }(0.8, 650.0);
  EXPECT_GT(share, 1.0 - seenOn("fabric", effect, 0.8, 450.0) / 0.8);
  EXPECT_GT(share, 1.0 - seenOn("fabric", effect, 0.1, 650.0) / 0.1);
}

TEST(Fluorescence, AddsItsBandInProportionToTheExcitation)
{
  const double at460 = std::exp(-0.5 * std::pow(20.0 / 18.0, 2.0));
  const auto seen = [](const char* form, double wavelength)
  {
    return seenOn(
      "paper", { "fluorescence", form, "paper", { 0.1, 440.0, 18.0 } }, 0.6, wavelength);
  };
  EXPECT_NEAR(seen("uncoloured", 440.0), 0.6 + 0.1, 1e-15);
  EXPECT_NEAR(seen("uncoloured", 460.0), 0.6 + 0.1 * at460, 1e-15);
  EXPECT_NEAR(seen("through_colorant", 440.0), 0.6 + 0.1 * 0.6, 1e-15);
  EXPECT_NEAR(seen("absorbed", 440.0), 0.6 + 0.1 * 0.4, 1e-15);
  EXPECT_NEAR(seen("uncoloured", 700.0), 0.6, 1e-15);
}

TEST(MediumGain, IsAFactor)
{
  EXPECT_NEAR(seenOn("fabric", { "medium_gain", "", "fabric", { 0.85 } }, 0.4, 500.0), 0.34, 1e-15);
}

}
