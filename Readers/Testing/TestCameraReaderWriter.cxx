#include "vtkCameraReader.h"
#include "vtkCameraWriter.h"

#include "CameraTable.h"

#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace
{
using namespace msi;
using namespace msi::testing;
namespace fs = std::filesystem;

constexpr const char* Curves = "wavelength,C400,C420\n400,0.5,0.1\n410,0.4,0.4\n420,0.1,0.5\n";
constexpr const char* Effects =
  R"([{"effect": "filter_shift", "parameters": {"shift": 2.9}},
      {"effect": "medium_gain", "medium": "paper", "parameters": {"gain": 0.95}}])";

class CameraFiles : public ::testing::Test
{
protected:
  CameraFiles()
    : Folder(fs::path(::testing::TempDir()) /
        ("camera-files-" +
          std::string(::testing::UnitTest::GetInstance()->current_test_info()->name())))
  {
    fs::remove_all(Folder);
    fs::create_directories(Folder);
  }
  ~CameraFiles() override { fs::remove_all(Folder); }

  std::string put(const std::string& name, const std::string& text) const
  {
    std::ofstream(Folder / name, std::ios::binary) << text;
    return (Folder / name).string();
  }
  static std::string textOf(const fs::path& file)
  {
    std::ifstream in(file, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), {} };
  }
  // The reader's error without the folder; empty where there was none.
  std::string readingError(const std::string& file)
  {
    Reader->SetFileName(file.c_str());
    Reader->Modified(); // the file, if not its name
    std::string text = errorOf(Reader);
    const std::string folder = Folder.string() + "/";
    if (const auto at = text.find(folder); at != std::string::npos)
    {
      text.erase(at, folder.size());
    }
    return text;
  }
  std::string write(vtkTable* table, const std::string& name)
  {
    Writer->SetInputData(table);
    Writer->SetFileName((Folder / name).string().c_str());
    return writingError();
  }

  std::string writingError()
  {
    const MessageLog log(Writer);
    Writer->Write();
    return log.firstError();
  }

  fs::path Folder;
  vtkNew<vtkCameraReader> Reader;
  vtkNew<vtkCameraWriter> Writer;
};

TEST_F(CameraFiles, EverythingReadIsWrittenAndReadAgain)
{
  put("bench.csv", Curves);
  const std::string file = put("bench.json",
    std::string(R"({"camera": "bench.csv", "dark": [0.01, 0.02], "white_level": 4095,
      "noise": {"read": 0.001, "shot": 0.002, "quantisation_step": 0.25},
      "white_after_effects": true, "effects": )") +
      Effects + "}");
  ASSERT_EQ(readingError(file), "");
  const CameraTable first = readCamera(Reader->GetOutput(), "the camera");
  EXPECT_EQ(first.camera.channels(), (std::vector<std::string>{ "C400", "C420" }));
  EXPECT_EQ(first.camera.responsivity(),
    (Eigen::MatrixXd(2, 3) << 0.5, 0.4, 0.1, 0.1, 0.4, 0.5).finished());
  EXPECT_EQ(first.camera.dark(), Eigen::Vector2d(0.01, 0.02));
  EXPECT_EQ(first.whiteLevel, 4095.0);
  ASSERT_TRUE(first.noise);
  EXPECT_EQ(first.noise->quantisationStep, 0.25);
  EXPECT_TRUE(first.whiteAfterEffects);

  ASSERT_EQ(write(Reader->GetOutput(), "again.json"), "");
  ASSERT_EQ(readingError((Folder / "again.json").string()), "");
  const CameraTable second = readCamera(Reader->GetOutput(), "the camera");
  EXPECT_EQ(second.camera.wavelengths(), first.camera.wavelengths());
  EXPECT_EQ(second.camera.responsivity(), first.camera.responsivity());
  EXPECT_EQ(second.camera.dark(), first.camera.dark());
  EXPECT_EQ(second.camera.channels(), first.camera.channels());
  EXPECT_EQ(second.whiteLevel, 4095.0);
  EXPECT_EQ(second.effects, first.effects);
  EXPECT_EQ(second.noise->shot, first.noise->shot);
  EXPECT_TRUE(second.whiteAfterEffects);
}

TEST_F(CameraFiles, CurvesAloneAreACameraWithoutDarkNoiseAndEffects)
{
  ASSERT_EQ(readingError(put("bench.csv", Curves)), "");
  const CameraTable camera = readCamera(Reader->GetOutput(), "the camera");
  EXPECT_EQ(camera.camera.dark(), Eigen::Vector2d::Zero());
  EXPECT_EQ(camera.whiteLevel, 1.0);
  EXPECT_FALSE(camera.noise);
  EXPECT_TRUE(camera.effects.empty());
  EXPECT_EQ(Reader->GetOutput()->GetFieldData()->GetAbstractArray("WhiteLevel"), nullptr);
}

TEST_F(CameraFiles, MalformedFilesAreOneLineEach)
{
  put("bench.csv", Curves);
  const auto jsonError = [this](const std::string& text)
  { return readingError(put("bench.json", text)); };
  EXPECT_EQ(readingError(""), "no file is given; choose a camera (.json or .csv) as File Name");
  EXPECT_EQ(jsonError("{\"dark\": [1, 2, 3]}"),
    "bench.json:1:2: 'dark' has 3 values; expected one, or 2 as the curves have channels; correct "
    "the list");
  EXPECT_EQ(jsonError("{\"white_level\": 0}"),
    "bench.json:1:2: 'white_level' has a value that cannot be used; expected a number above 0; "
    "correct the value");
  EXPECT_EQ(jsonError("{\"effects\": [{\"effect\": \"ghosts\"}]}").substr(0, 67),
    "bench.json:1:15: effect 1 (ghosts): there is no effect of this name");
  EXPECT_EQ(readingError(put("uneven.csv", "wavelength,C1\n400,1\n410,1\n430,1\n")),
    "uneven.csv: the wavelengths step by 10 nm at first and by 20 nm before 430 nm; expected a "
    "uniform grid; interpolate the curves");
  // An error leaves nothing of the camera before.
  EXPECT_EQ(Reader->GetOutput()->GetNumberOfRows(), 0);
  for (const char* text : { "", "{", "[1]", "{\"camera\": \"none.csv\"}", "{\"noise\": 3}" })
  {
    const std::string error = jsonError(text);
    EXPECT_FALSE(error.empty()) << text;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

TEST_F(CameraFiles, TheWriterRefusesWhatIsNoCameraAndLeavesNoFile)
{
  EXPECT_EQ(write(newTable({ { "C1", { 1.0 } } }), "camera.json"),
    "the camera has no column of numbers 'wavelength'; expected wavelength and one curve a "
    "channel");
  const auto camera = newTable({ { "wavelength", { 400.0, 410.0 } }, { "C1", { 0.1, 0.2 } } });
  EXPECT_EQ(write(camera, "camera.txt"),
    "the camera is to be written to '" + (Folder / "camera.txt").string() +
      "'; expected a name that ends in .json");
  EXPECT_TRUE(fs::is_empty(Folder));
  Writer->SetFileName("");
  EXPECT_EQ(writingError(), "no file is given; choose where to write as File Name");
  EXPECT_NE(write(camera, "no-such-folder/camera.json"), "");
}

TEST_F(CameraFiles, WhatIsNotSaidIsWrittenAsTheDefault)
{
  const auto camera = newTable({ { "wavelength", { 400.0, 410.0 } }, { "C1", { 0.1, 0.2 } } });
  ASSERT_EQ(write(camera, "plain.json"), "");
  EXPECT_NE(textOf(Folder / "plain.json").find("\"white_level\": 1.0"), std::string::npos);
  EXPECT_NE(textOf(Folder / "plain.json").find("\"noise\": null"), std::string::npos);
  EXPECT_EQ(textOf(Folder / "plain.csv").substr(0, 14), "wavelength,C1\n");
}

}
