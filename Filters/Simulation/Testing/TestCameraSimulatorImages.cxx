#include "vtkCameraSimulator.h"

#include "SimulationTestData.h"

#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

constexpr const char* PixelEffects =
  R"([{"effect": "filter_shift", "parameters": {"shift": 2}},
      {"effect": "vignetting", "parameters": {"falloff": 0.1}},
      {"effect": "banding", "parameters": {"amplitude": 0.02}},
      {"effect": "channel_crosstalk", "parameters": {"coupling": 0.02}}])";
constexpr const char* NeighbourEffects =
  R"([{"effect": "misregistration", "parameters": {"along_x": 0.7, "along_y": -1.2, "magnification": 0.002}},
      {"effect": "defocus", "parameters": {"blur": 0.8}},
      {"effect": "local_stray_light", "parameters": {"fraction": 0.05, "radius": 2}}])";
constexpr const char* SceneEffects =
  R"([{"effect": "veiling_glare", "parameters": {"fraction": 0.03}},
      {"effect": "defocus", "parameters": {"blur": 0.8}}])";

class CameraSimulatorImages : public ::testing::Test
{
protected:
  static constexpr int Width = 90;
  static constexpr int Height = 400;

  CameraSimulatorImages()
  {
    Source->SetImage(Image);
    Simulator->SetInputConnection(0, Source->GetOutputPort());
    Simulator->SetInputData(
      1, cameraTable({}, CameraNoise{ 0.002, 0.004, 0.01, 0.001, 1.0 / 4095 }));
    Simulator->SetEffects(vtkCameraSimulator::EFFECT_LIST);
    use("[]");
  }
  void use(const char* effects) { Simulator->SetEffectList(effects); }
  Eigen::MatrixXd responses()
  {
    EXPECT_EQ(errorOf(Simulator), "");
    return valuesOf(Simulator->GetImageDataOutput(), ResponsesArray);
  }

  vtkSmartPointer<vtkImageData> Image = reflectanceImage(Width, Height);
  vtkNew<PieceSource> Source;
  vtkNew<vtkCameraSimulator> Simulator;
};

TEST_F(CameraSimulatorImages, AnswersAsTheSumOverWavelengths)
{
  Simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  const CameraModel camera = test::sevenChannels();
  const Eigen::MatrixXd expected =
    (camera.responsivity() * valuesOf(Image, ReflectanceArray)).colwise() + camera.dark();
  EXPECT_LT((responses() - expected).cwiseAbs().maxCoeff(), 2e-6);
  auto* output = Simulator->GetImageDataOutput();
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_STREQ(array->GetName(), ResponsesArray);
  EXPECT_EQ(axisOf(output, array).wavelengths->values(),
    (std::vector<double>{ 430, 470, 510, 550, 590, 630, 670 }));
  EXPECT_EQ(output->GetPointData()->GetArray(ReflectanceArray), nullptr);
}

TEST_F(CameraSimulatorImages, AnImageIsATableOfItsPixels)
{
  Simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  use(R"([{"effect": "exposure_gain", "parameters": {"gain": 1.1}},
          {"effect": "medium_gain", "medium": "paper", "parameters": {"gain": 0.8}},
          {"effect": "detector_nonlinearity", "parameters": {"square": -0.05}},
          {"effect": "veiling_glare", "parameters": {"fraction": 0.03}}])");
  Simulator->SetMedia("paper");
  const Eigen::MatrixXd image = responses();
  vtkNew<vtkTable> pixels;
  addSpectra(pixels, 'R', test::visibleGrid(), valuesOf(Image, ReflectanceArray));
  addTextColumn(pixels, "medium", std::vector<std::string>(Width * Height, "paper"));
  Simulator->SetInputData(0, pixels);
  ASSERT_EQ(errorOf(Simulator), "");
  EXPECT_LT((image - responsesOf(Simulator->GetTableOutput())).cwiseAbs().maxCoeff(), 5e-6);
}

TEST_F(CameraSimulatorImages, ActsOnThePixelsOfAMedium)
{
  Simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  const Eigen::MatrixXd ideal = responses();
  vtkNew<vtkIntArray> medium;
  medium->SetName("Medium");
  for (vtkIdType i = 0; i < Image->GetNumberOfPoints(); ++i)
  {
    medium->InsertNextValue(i % 3 == 0 ? 1 : 0);
  }
  Image->GetPointData()->AddArray(medium);
  Source->SetImage(Image);
  use(R"([{"effect": "medium_gain", "medium": "fabric", "parameters": {"gain": 0.5}}])");
  EXPECT_EQ(errorOf(Simulator),
    "an effect acts on one medium, but the image's media are not named; set Media, and MediumArray "
    "where there are several");
  Simulator->SetMedia("paper, fabric");
  Simulator->SetMediumArray("Medium");
  const Eigen::MatrixXd u = responses();
  const Eigen::VectorXd dark = test::sevenChannels().dark();
  EXPECT_EQ(u.col(1), ideal.col(1));
  EXPECT_LT((u.col(3) - dark - 0.5 * (ideal.col(3) - dark)).cwiseAbs().maxCoeff(), 2e-6);
  Simulator->SetMediumArray("Media");
  EXPECT_EQ(errorOf(Simulator),
    "the image has no point array 'Media' of one component; expected the number of the medium of "
    "each pixel, counted from 0");
}

TEST_F(CameraSimulatorImages, PixelEffectsAskForNoMorePixels)
{
  use(PixelEffects);
  ASSERT_TRUE(Simulator->UpdatePiece(1, 4, 0));
  EXPECT_EQ(Source->LargestRequest(), Simulator->GetImageDataOutput()->GetNumberOfPoints());
}

TEST_F(CameraSimulatorImages, NeighbourEffectsAskForAMargin)
{
  use(NeighbourEffects);
  ASSERT_TRUE(Simulator->UpdatePiece(1, 4, 0));
  EXPECT_GT(Source->LargestRequest(), Simulator->GetImageDataOutput()->GetNumberOfPoints());
  EXPECT_LT(Source->LargestRequest(), Width * Height);
}

TEST_F(CameraSimulatorImages, TheSceneMeanAsksForTheWholeImage)
{
  use(SceneEffects);
  ASSERT_TRUE(Simulator->UpdatePiece(1, 4, 0));
  EXPECT_EQ(Source->LargestRequest(), Width * Height);
}

TEST_F(CameraSimulatorImages, HasTheSameBytesInPieces)
{
  for (const char* effects : { "[]", PixelEffects, NeighbourEffects, SceneEffects })
  {
    SCOPED_TRACE(effects);
    use(effects);
    expectSameBytesInPieces(Simulator, 4);
  }
}

TEST_F(CameraSimulatorImages, HasTheSameBytesInThreads)
{
  for (const char* effects : { PixelEffects, NeighbourEffects, SceneEffects })
  {
    SCOPED_TRACE(effects);
    use(effects);
    expectSameBytesInThreads(Simulator);
  }
}

TEST_F(CameraSimulatorImages, KeepsOtherArraysInTheirPlace)
{
  use(NeighbourEffects);
  vtkNew<vtkFloatArray> number;
  number->SetName("Number");
  for (vtkIdType i = 0; i < Image->GetNumberOfPoints(); ++i)
  {
    number->InsertNextValue(static_cast<float>(i));
  }
  Image->GetPointData()->AddArray(number);
  Source->SetImage(Image);
  ASSERT_TRUE(Simulator->UpdatePiece(1, 4, 0));
  auto* output = Simulator->GetImageDataOutput();
  double place[3];
  output->GetPoint(0, place);
  EXPECT_EQ(output->GetPointData()->GetArray("Number")->GetTuple1(0), Image->FindPoint(place));
}

TEST_F(CameraSimulatorImages, TheDriftOfACorrectedCameraIsLeftOutWithAWarning)
{
  Simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  const auto shift = R"({"effect": "filter_shift", "parameters": {"shift": 2}})";
  use(("[" + std::string(shift) + "]").c_str());
  const Eigen::MatrixXd expected = responses();
  Simulator->SetEffects(vtkCameraSimulator::OF_CAMERA);
  Simulator->SetInputData(1,
    cameraTable("[" + std::string(shift) +
      R"(, {"effect": "session_drift", "parameters": {"change": 0.1}}])"));
  MessageLog log(Simulator);
  EXPECT_EQ(responses(), expected);
  EXPECT_EQ(log.firstWarning().rfind("the camera's session_drift is left out", 0), 0u)
    << log.firstWarning();
}

TEST_F(CameraSimulatorImages, CanBeStopped)
{
  EXPECT_EQ(errorWhenStopped(Simulator), "stopped by the user");
}

TEST_F(CameraSimulatorImages, Errors)
{
  use(R"([{"effect": "session_drift", "parameters": {"change": 0.1}}])");
  EXPECT_EQ(errorOf(Simulator).rfind("session_drift concerns samples", 0), 0u);
  use("[]");
  Simulator->SetInputData(0, newImage(4, 4, ReflectanceArray, patternValues(31, 16)));
  EXPECT_EQ(errorOf(Simulator),
    "the image has no wavelengths; expected reflectance with the field data 'Wavelength'");
}
}
