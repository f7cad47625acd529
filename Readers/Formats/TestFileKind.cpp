#include "Formats/FileKind.h"

#include "Support/formats/TestFiles.h"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace
{

using msi::FileKind;
using msi::fileKind;

class FileKinds : public msi::testing::TemporaryFolder
{
protected:
  std::string picture(
    const std::string& name, int width, const std::vector<std::uint8_t>& values) const
  {
    const auto file = path(name);
    auto output = OIIO::ImageOutput::create(file);
    const int height = static_cast<int>(values.size()) / width;
    output->open(file, OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, values.data());
    output->close();
    return file;
  }
};

TEST_F(FileKinds, TablesOfSamples)
{
  EXPECT_EQ(fileKind(write("a.csv", "sample,R400,R410,R420\na,.1,.2,.3\n")), FileKind::SampleTable);
  EXPECT_EQ(fileKind(write("b.csv", "sample;400nm;410nm\na;0,1;0,2\n")), FileKind::SampleTable);
  EXPECT_EQ(fileKind(write("c.csv", "sample,C1,C2\na,.1,.2\n")), FileKind::SampleTable);
  EXPECT_EQ(
    fileKind(write("d.csv", "wavelength,red patch,blue patch\n400,.6,.5\n500,.7,.9\n600,.8,.8\n")),
    FileKind::SampleTable);
  EXPECT_EQ(fileKind(write("e.csv", "wavelength,C400,C500,constant\n400,1,-.5,.1\n500,-.2,1,0\n")),
    FileKind::SampleTable);
}

TEST_F(FileKinds, OtherTablesAreUnknown)
{
  EXPECT_EQ(fileKind(write("a.csv", "time,temperature\n1,20\n2,21\n")), FileKind::Unknown);
  EXPECT_EQ(
    fileKind(write("b.txt", "Dear all,\nplease find the results attached.\n")), FileKind::Unknown);
  EXPECT_EQ(fileKind(write("c.csv", "")), FileKind::Unknown);
  EXPECT_EQ(fileKind(path("missing.csv")), FileKind::Unknown);
}

TEST_F(FileKinds, CamerasAndCaptures)
{
  const std::string curves = "wavelength,C1,C2\n400,.5,.2\n410,.3,.4\n420,.2,.4\n";
  EXPECT_EQ(fileKind(write("camera.csv", curves)), FileKind::Camera);
  EXPECT_EQ(fileKind(write("named.csv", "wavelength,blue,red\n400,.5,.2\n410,.3,.4\n420,.2,.4\n")),
    FileKind::Camera);
  EXPECT_EQ(fileKind(write("camera.json", R"({"dark": 0.01})")), FileKind::Camera);
  EXPECT_EQ(fileKind(write("other.json", R"({"dark": 0.01})")), FileKind::Unknown);

  write("c/camera.csv", curves);
  write("c/samples.csv", "sample,R400,R410,R420\na,.1,.2,.3\n");
  const auto capture = write("c/capture.json", R"({"name": "bench"})");
  EXPECT_NE(fileKind(capture), FileKind::Capture);
  write("c/responses.csv", "sample,C1,C2\na,.1,.2\n");
  EXPECT_EQ(fileKind(capture), FileKind::Capture);
  EXPECT_EQ(fileKind(path("c")), FileKind::Capture);
}

TEST_F(FileKinds, LabelsAreEvenAreas)
{
  std::vector<std::uint8_t> labels(40 * 40, 0);
  std::vector<std::uint8_t> photograph(labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    const std::size_t x = i % 40;
    labels[i] = static_cast<std::uint8_t>(x < 10 ? 0 : x < 25 ? 1 : 2);
    photograph[i] = static_cast<std::uint8_t>((i * 7919) % 251);
  }
  EXPECT_EQ(fileKind(picture("labels.png", 40, labels)), FileKind::LabelImage);
  EXPECT_EQ(fileKind(picture("frame.png", 40, photograph)), FileKind::SpectralImage);
  EXPECT_EQ(
    fileKind(picture("dark.png", 40, std::vector<std::uint8_t>(1600, 3))), FileKind::SpectralImage);
  // A wavelength in the name: a channel, however even it is.
  EXPECT_EQ(fileKind(picture("channel_450nm.png", 40, labels)), FileKind::SpectralImage);
}

TEST_F(FileKinds, RealFiles)
{
  const char* data = std::getenv("MULTISPECTRAL_DATA");
  if (!data)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  const std::string folder(data);
  for (const char* name :
    { "files/D65.exr", "files/Macbeth.exr", "filterwheel-cc24/channel_550nm.tif" })
  {
    EXPECT_EQ(fileKind(folder + "/" + name), FileKind::SpectralImage) << name;
  }
  for (const char* name : { "files/cc24_ref.cie", "filterwheel-cc24/patches.csv",
         "hkpolyu/cotton.csv", "reflectances/ces99.csv", "reflectances/clothes.csv" })
  {
    EXPECT_EQ(fileKind(folder + "/" + name), FileKind::SampleTable) << name;
  }
  EXPECT_EQ(fileKind(folder + "/filterwheel-cc24/labels.png"), FileKind::LabelImage);
  EXPECT_EQ(fileKind(folder + "/filterwheel-cc24/filters.csv"), FileKind::Camera);
}

}
