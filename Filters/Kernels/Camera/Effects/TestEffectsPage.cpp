// Documentation/CameraEffects.md is made from the library. After a change of an effect write it again:
//   MULTISPECTRAL_WRITE_PAGES=1 ctest --test-dir build/kernels -R EffectsPage
#include "Kernels/Camera/CameraEffect.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace
{
const char* const Preamble =
  R"(# Camera effects

What makes a real camera differ from u = M r + b, as [Camera Simulator](Filters/CameraSimulator.md) knows it. They act in this order, whatever the order of
the list: reflectance of one medium, lamp and filters (M), irradiance, detector, noise; those of images at the end of this page between irradiance
and detector. An effect with its parameters at neutral changes no bit. The list as a file: [Formats](Formats.md).

x and y run from -1 to 1 over the longer side of the field (of an image, or of the box around the samples' positions) in the directions of the samples' x and
y and of the image's axes: y grows upward in a VTK image. rho is the distance from the optical axis, time runs from 0 to 1 over the capture order,
k counts the channels. `veiling_glare` and `local_stray_light` take the scene's mean and the neighbours from the column `scene` and the positions.

Each effect names the capture that shows it by itself. [Sim To Real Gap](Filters/SimToRealGap.md) recommends that capture where two effects look alike.

This page is made from the effect library (`Filters/Kernels/Camera/Effects`, one file each); a test fails where it is not up to date.
)";

std::string parameterText(const msi::EffectParameter& parameter)
{
  std::ostringstream text;
  text << "`" << parameter.name << "`" << (parameter.perChannel ? " per channel" : "") << ": "
       << parameter.neutral << ", " << parameter.lower << ".." << parameter.upper;
  if (parameter.unit != "1")
  {
    text << " " << parameter.unit;
  }
  text << ", " << parameter.meaning;
  return text.str();
}

std::string page()
{
  std::ostringstream text;
  text << Preamble;
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    text << "\n### " << effect.name << "\n\n" << effect.meaning << "\n";
    text << "Separating capture: " << effect.separatingCapture.name << ".\n\n";
    text << "| form | formula | parameters: neutral, range |\n|---|---|---|\n";
    for (const msi::EffectForm& form : effect.forms)
    {
      text << "| `" << form.name << "` | " << form.meaning << " | ";
      const char* separator = "";
      for (const msi::EffectParameter& parameter : form.parameters)
      {
        text << separator << parameterText(parameter);
        separator = "; ";
      }
      text << " |\n";
    }
  }
  return text.str();
}
}

TEST(EffectsPage, IsUpToDate)
{
  const std::string path =
    std::string(MULTISPECTRAL_SOURCE_DIR) + "/Documentation/CameraEffects.md";
  const std::string expected = page();
  if (std::getenv("MULTISPECTRAL_WRITE_PAGES") != nullptr)
  {
    std::ofstream(path) << expected;
  }
  std::ostringstream written;
  written << std::ifstream(path).rdbuf();
  EXPECT_EQ(written.str(), expected)
    << path << " is not up to date; write it again with MULTISPECTRAL_WRITE_PAGES=1";
}

TEST(EffectsPage, EveryEffectHasASeparatingCapture)
{
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    EXPECT_GT(std::string(effect.separatingCapture.name).size(), 0U) << effect.name;
    EXPECT_GT(effect.separatingCapture.minutes, 0.0) << effect.name;
  }
}
