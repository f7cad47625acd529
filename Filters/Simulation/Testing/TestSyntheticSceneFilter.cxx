#include "vtkCameraSimulator.h"
#include "vtkSyntheticScene.h"

#include "SimulationTestData.h"

#include "Support/vtk/Runs.h"

#include "Kernels/Scenes/SyntheticScene.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

class SyntheticSceneSource : public ::testing::Test
{
protected:
  static constexpr int Width = 200;
  static constexpr int Height = 140;

  SyntheticSceneSource()
  {
    Source->SetSize(Width, Height);
    Source->SetWavelengths(400.0, 700.0, 10.0);
    Source->SetSeed(5);
  }
  vtkImageData* image() { return vtkImageData::SafeDownCast(Source->GetOutputDataObject(0)); }
  vtkTable* patches() { return vtkTable::SafeDownCast(Source->GetOutputDataObject(1)); }

  vtkNew<vtkSyntheticScene> Source;
};

TEST_F(SyntheticSceneSource, TheTopRowOfTheSceneIsTheLastOfTheImage)
{
  ASSERT_EQ(errorOf(Source), "");
  scenes::SceneOptions options;
  options.width = Width;
  options.height = Height;
  options.seed = 5;
  const scenes::SyntheticScene scene(test::visibleGrid(), options);
  auto* reflectance = requireSpectralArray(image(), "the scene");
  EXPECT_STREQ(reflectance->GetName(), ReflectanceArray);
  EXPECT_EQ(axisOf(image(), reflectance).wavelengths->values(), test::visibleGrid().values());
  auto* labels = image()->GetPointData()->GetArray(LabelArray);
  ASSERT_NE(labels, nullptr);
  std::vector<float> pixel(static_cast<std::size_t>(test::visibleGrid().size()));
  for (const auto& [x, y] : { std::pair{ 0, 0 }, std::pair{ 17, 20 }, std::pair{ 150, 99 } })
  {
    const vtkIdType point = static_cast<vtkIdType>(Height - 1 - y) * Width + x;
    scene.reflectance(x, y, 1, pixel.data());
    for (int j = 0; j < reflectance->GetNumberOfComponents(); ++j)
    {
      EXPECT_EQ(reflectance->GetComponent(point, j),
        static_cast<double>(pixel[static_cast<std::size_t>(j)]));
    }
    EXPECT_EQ(labels->GetTuple1(point), scene.label(x, y));
  }
}

TEST_F(SyntheticSceneSource, ThePatchesAreATable)
{
  Source->SetSubject(vtkSyntheticScene::FABRIC);
  ASSERT_EQ(errorOf(Source), "");
  EXPECT_EQ(patches()->GetNumberOfRows(), 24);
  EXPECT_EQ(cell(patches(), 23, "label"), 24.0);
  EXPECT_EQ(textCell(patches(), 0, "medium"), "fabric");
  // The middle of a patch lies in the patch.
  auto* labels = image()->GetPointData()->GetArray(LabelArray);
  for (vtkIdType row = 0; row < 24; ++row)
  {
    const auto x = static_cast<vtkIdType>(cell(patches(), row, "x"));
    const auto y = static_cast<vtkIdType>(cell(patches(), row, "y"));
    EXPECT_EQ(labels->GetTuple1((Height - 1 - y) * Width + x), static_cast<double>(row + 1));
  }
}

TEST_F(SyntheticSceneSource, ThePatchesAloneDrawNoImage)
{
  Source->GetOutputPort(1);
  Source->Update(1);
  EXPECT_EQ(patches()->GetNumberOfRows(), 24);
  EXPECT_TRUE(isEmpty(image()));
  Source->Update(0);
  EXPECT_EQ(image()->GetNumberOfPoints(), Width * Height);
  EXPECT_FALSE(isEmpty(image()));
}

TEST_F(SyntheticSceneSource, AChartGivesTheSameBytesInThreadsAndPieces)
{
  Source->SetSubject(vtkSyntheticScene::CHART_140);
  expectSameBytesInThreads(Source);
  expectSameBytesInPieces(Source, 3);
}

TEST_F(SyntheticSceneSource, FabricGivesTheSameBytesInThreadsAndPieces)
{
  Source->SetSubject(vtkSyntheticScene::FABRIC);
  expectSameBytesInThreads(Source);
  expectSameBytesInPieces(Source, 3);
}

TEST_F(SyntheticSceneSource, ACameraLooksAtIt)
{
  Source->SetTexture(0.0);
  vtkNew<vtkCameraSimulator> simulator;
  simulator->SetInputConnection(0, Source->GetOutputPort(0));
  simulator->SetInputData(1, cameraTable());
  simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  ASSERT_EQ(errorOf(simulator), "");
  auto* seen = vtkImageData::SafeDownCast(simulator->GetOutputDataObject(0));
  auto* responses = requireSpectralArray(seen, "the responses");
  auto* labels = seen->GetPointData()->GetArray(LabelArray);
  const auto spectra = requireSpectra(patches(), SampleQuantity::Reflectance, "the patches");
  const CameraModel camera = test::sevenChannels();
  const Eigen::MatrixXd expected =
    (camera.responsivity() * spectra.values).colwise() + camera.dark();
  int compared = 0;
  for (vtkIdType point = 0; point < seen->GetNumberOfPoints(); point += 13)
  {
    if (const auto label = static_cast<Eigen::Index>(labels->GetTuple1(point)); label > 0)
    {
      for (Eigen::Index k = 0; k < camera.channelCount(); ++k)
      {
        ASSERT_NEAR(
          responses->GetComponent(point, static_cast<int>(k)), expected(k, label - 1), 2e-6);
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
}

TEST_F(SyntheticSceneSource, SaysWhatItCannotDraw)
{
  Source->SetSize(20, 20);
  EXPECT_EQ(errorOf(Source), "the scene has 20 x 20 pixels; 6 x 4 patches need at least 39 x 27");
  Source->SetSize(200, 140);
  Source->SetWavelengths(700.0, 400.0, 10.0);
  EXPECT_NE(errorOf(Source), "");
  Source->SetWavelengths(400.0, 700.0, 10.0);
  Source->SetTexture(9.0);
  EXPECT_EQ(errorOf(Source), "the scene's texture is 9; expected a value from 0 to 3");
}

}
