#include "Formats/SceneFolder.h"

#include "Formats/FormatError.h"
#include "Formats/Images/StackFiles.h"
#include "Support/formats/TestFiles.h"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace
{

using msi::findScene;

class SceneFolders : public msi::testing::TemporaryFolder
{
protected:
  // A picture of noise, or of two even areas.
  std::string image(const std::string& name, bool even = false) const
  {
    const auto file = path(name);
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    std::vector<std::uint8_t> values(40 * 40);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = static_cast<std::uint8_t>(even ? (i % 40 < 20 ? 1 : 2) : (i * 7919) % 251);
    }
    auto output = OIIO::ImageOutput::create(file);
    output->open(file, OIIO::ImageSpec(40, 40, 1, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, values.data());
    output->close();
    return file;
  }

  std::string fault(const std::string& folder) const
  {
    try
    {
      findScene(path(folder));
    }
    catch (const msi::FormatError& error)
    {
      return error.what();
    }
    return {};
  }
};

TEST_F(SceneFolders, PartsAreFoundByNameAndContent)
{
  for (const char* channel : { "channel_450nm.png", "channel_550nm.png", "channel_1000nm.png" })
  {
    image(std::string("scene/") + channel);
    image(std::string("scene/White/") + channel, true); // as even as labels
  }
  image("scene/labels.png", true);
  write("scene/patches.csv", "label,R400,R410\n1,.1,.2\n2,.3,.4\n");
  write("scene/chart.csv", "sample,R400,R410,C1,C2\na,.1,.2,.1,.2\n");
  write("scene/swatches.csv", "sample,R400,R410,C1,C2\na,.1,.2,.1,.2\n");
  write("scene/notes.txt", "the lamp was changed at noon\n");
  image("scene/dark.png");
  const auto scene = findScene(path("scene"));
  EXPECT_EQ(scene.image,
    (std::vector<std::string>{ path("scene/channel_450nm.png"), path("scene/channel_550nm.png"),
      path("scene/channel_1000nm.png") }));
  EXPECT_EQ(scene.white.size(), 3u);
  EXPECT_EQ(scene.dark, std::vector<std::string>{ path("scene/dark.png") });
  EXPECT_EQ(scene.labels, path("scene/labels.png"));
  EXPECT_EQ(scene.patches, path("scene/patches.csv"));
  EXPECT_EQ(scene.calibration, path("scene/chart.csv"));
  EXPECT_EQ(scene.tuning, path("scene/swatches.csv"));
}

TEST_F(SceneFolders, OneFileIsAnImageToo)
{
  image("scene/page.png");
  image("scene/whitewash.txt.png"); // a name that starts with a word that starts with white
  EXPECT_NE(fault("scene").find("holds no wavelength"), std::string::npos) << fault("scene");
  std::filesystem::remove(path("scene/whitewash.txt.png"));
  const auto scene = findScene(path("scene"));
  EXPECT_EQ(scene.image.size(), 1u);
  EXPECT_TRUE(scene.white.empty() && scene.dark.empty() && scene.labels.empty());
}

TEST_F(SceneFolders, AChannelKnowsItsStack)
{
  for (const char* name : { "A_450 nm.png", "A_1000 nm.png", "A_500,5 nm.png", "white_450 nm.png",
         "A_450 nm.tif", "frame_450.png", "frame_460.png", "labels.png" })
  {
    write(std::string("scene/") + name, "");
  }
  const auto stack = msi::stackOf(path("scene/A_500,5 nm.png"));
  EXPECT_EQ(stack.pattern, "A_* nm.png");
  EXPECT_EQ(stack.files,
    (std::vector<std::string>{
      path("scene/A_450 nm.png"), path("scene/A_500,5 nm.png"), path("scene/A_1000 nm.png") }));
  // The only one of its name, a number that may count frames, none at all, a folder that is not there.
  for (const char* name :
    { "white_450 nm.png", "A_450 nm.tif", "frame_450.png", "labels.png", "no/A_450nm.png" })
  {
    EXPECT_TRUE(msi::stackOf(path(std::string("scene/") + name)).files.empty()) << name;
  }
}

TEST_F(SceneFolders, WhatIsNoSceneIsNamed)
{
  write("empty/readme.txt", "nothing here\n");
  EXPECT_NE(fault("empty").find("has no spectral image in it"), std::string::npos);
  EXPECT_NE(fault("nowhere").find("cannot be listed"), std::string::npos);
  image("twice/page.png");
  image("twice/a.png", true);
  image("twice/b.png", true);
  EXPECT_NE(
    fault("twice").find("two files for the label image: a.png and b.png"), std::string::npos)
    << fault("twice");
}

}
