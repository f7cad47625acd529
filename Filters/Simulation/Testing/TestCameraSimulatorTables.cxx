#include "vtkCameraSimulator.h"

#include "SimulationTestData.h"

#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace
{
using namespace msi;
using namespace msi::testing;

class CameraSimulatorTables : public ::testing::Test
{
protected:
  CameraSimulatorTables()
  {
    Simulator->SetInputData(0, Samples);
    Simulator->SetInputData(1, cameraTable());
  }
  Eigen::MatrixXd responses()
  {
    EXPECT_EQ(errorOf(Simulator), "");
    return responsesOf(Simulator->GetTableOutput());
  }
  Eigen::MatrixXd with(const std::string& effects)
  {
    Simulator->SetEffects(vtkCameraSimulator::EFFECT_LIST);
    Simulator->SetEffectList(effects.c_str());
    return responses();
  }
  std::string errorWith(const std::string& effects)
  {
    Simulator->SetEffects(vtkCameraSimulator::EFFECT_LIST);
    Simulator->SetEffectList(effects.c_str());
    return errorOf(Simulator);
  }

  vtkSmartPointer<vtkTable> Samples = rasterTable();
  const CameraModel Camera = test::sevenChannels();
  // u = M r + b, written down again.
  const Eigen::MatrixXd Ideal =
    (Camera.responsivity() * test::rasterSamples().reflectance).colwise() + Camera.dark();
  vtkNew<vtkCameraSimulator> Simulator;
};

TEST_F(CameraSimulatorTables, AnswersAsTheSumOverWavelengths)
{
  const Eigen::MatrixXd u = responses();
  ASSERT_EQ(u.rows(), 7);
  EXPECT_LT((u - Ideal).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CameraSimulatorTables, KeepsMetadataAndReplacesResponses)
{
  addColumn(Samples, "C9", std::vector<double>(48, 5.0));
  responses();
  auto* output = Simulator->GetTableOutput();
  EXPECT_EQ(textCell(output, 3, "medium"), "fabric");
  EXPECT_EQ(cell(output, 3, "order"), 3.0);
  EXPECT_EQ(output->GetColumnByName("C9"), nullptr);
  EXPECT_NE(output->GetColumnByName("C430"), nullptr);
  EXPECT_NE(output->GetColumnByName("R400"), nullptr);
  EXPECT_EQ(cell(Samples, 0, "C9"), 5.0);
}

TEST_F(CameraSimulatorTables, NeutralEffectsChangeNoBit)
{
  const Eigen::MatrixXd ideal = responses();
  std::string list;
  for (const auto& effect : effectLibrary())
  {
    list += std::string(list.empty() ? "[" : ",") + "{\"effect\": \"" + effect.name + "\"" +
      (effect.need == EffectNeed::Medium ? ", \"medium\": \"fabric\"}" : "}");
  }
  EXPECT_EQ(with(list + "]"), ideal);
}

TEST_F(CameraSimulatorTables, EffectsActOnTheirMediumAndPlace)
{
  const Eigen::MatrixXd u = with(
    R"([{"effect": "medium_gain", "medium": "fabric", "parameters": {"gain": 0.9}},
        {"effect": "dark_offset", "parameters": {"offset": 0.01}, "channel": "590nm"}])");
  Eigen::MatrixXd expected = Ideal.colwise() - Camera.dark();
  for (Eigen::Index s = 1; s < expected.cols(); s += 2)
  {
    expected.col(s) *= 0.9;
  }
  expected.colwise() += Camera.dark();
  expected.row(4).array() += 0.01;
  EXPECT_LT((u - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CameraSimulatorTables, UsesTheEffectsOfTheCameraUnlessIdeal)
{
  Simulator->SetInputData(
    1, cameraTable(R"([{"effect": "exposure_gain", "parameters": {"gain": 2}}])"));
  const Eigen::MatrixXd twice = (2.0 * (Ideal.colwise() - Camera.dark())).colwise() + Camera.dark();
  EXPECT_LT((responses() - twice).cwiseAbs().maxCoeff(), 1e-12);
  Simulator->SetEffects(vtkCameraSimulator::IDEAL);
  EXPECT_LT((responses() - Ideal).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CameraSimulatorTables, ReadsEffectsFromAFile)
{
  const auto file = std::filesystem::temp_directory_path() /
    ("CameraSimulatorTables." + std::to_string(::getpid()) + ".json");
  std::ofstream(file) << R"({"effects": [{"effect": "exposure_gain", "parameters": {"gain": 2}}]})";
  Simulator->SetEffects(vtkCameraSimulator::EFFECT_FILE);
  Simulator->SetEffectFile(file.c_str());
  const Eigen::MatrixXd fromFile = responses();
  std::filesystem::remove(file);
  EXPECT_EQ(fromFile, with(R"([{"effect": "exposure_gain", "parameters": {"gain": 2}}])"));
}

TEST_F(CameraSimulatorTables, ExposureScalesTheLightAlone)
{
  Simulator->SetExposure(0.5);
  const Eigen::MatrixXd half = (0.5 * (Ideal.colwise() - Camera.dark())).colwise() + Camera.dark();
  EXPECT_LT((responses() - half).cwiseAbs().maxCoeff(), 1e-12);
  Simulator->SetExposure(0.0);
  EXPECT_EQ(errorOf(Simulator), "Exposure is 0.000000; expected more than 0");
}

TEST_F(CameraSimulatorTables, InterpolatesReflectanceOnAnotherGrid)
{
  // A straight line over wavelength, on 20 nm: exact under interpolation.
  const auto coarse = WavelengthGrid::uniform(400.0, 700.0, 20.0);
  vtkNew<vtkTable> line;
  addSpectra(line, 'R', coarse, (coarse.vector().array() / 1000.0).matrix());
  Simulator->SetInputData(0, line);
  const Eigen::VectorXd expected =
    Camera.responsivity() * (Camera.wavelengths().vector() / 1000.0) + Camera.dark();
  EXPECT_LT((responses() - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CameraSimulatorTables, RepeatsHaveTheNoiseThatIsAskedFor)
{
  constexpr int Repeats = 400;
  Simulator->SetRepeats(Repeats);
  Simulator->SetNoise(vtkCameraSimulator::NOISE_AS_GIVEN);
  Simulator->SetReadNoise(0.002);
  Simulator->SetShotNoise(0.01);
  const Eigen::MatrixXd u = responses();
  ASSERT_EQ(u.cols(), 48 * Repeats);
  auto* output = Simulator->GetTableOutput();
  EXPECT_EQ(cell(output, 0, "repeat"), 1.0);
  EXPECT_EQ(cell(output, 48 * Repeats - 1, "repeat"), Repeats);
  EXPECT_EQ(textCell(output, 49, "medium"), "fabric");
  const Eigen::MatrixXd deviation = u - Ideal.replicate(1, Repeats);
  const Eigen::ArrayXXd variance = 4e-6 + 1e-4 * Ideal.replicate(1, Repeats).array().max(0.0);
  const double ratio = (deviation.array().square() / variance).mean();
  // 134400 values: the mean of squared standard normal values has the deviation sqrt(2 / n) = 0.0039.
  EXPECT_NEAR(ratio, 1.0, 5 * 0.0039);
  EXPECT_NEAR(deviation.mean() / std::sqrt(variance.mean()), 0.0, 5 * 0.0028);
}

TEST_F(CameraSimulatorTables, NoiseFollowsSeedAndExposureNumber)
{
  Simulator->SetInputData(1, cameraTable({}, CameraNoise{ 0.01, 0.0 }));
  const Eigen::MatrixXd first = responses();
  EXPECT_GT((first - Ideal).cwiseAbs().maxCoeff(), 0.005);
  Simulator->SetSeed(2);
  EXPECT_NE(responses(), first);
  Simulator->SetSeed(1);
  Simulator->SetExposureNumber(1);
  const Eigen::MatrixXd second = responses();
  EXPECT_NE(second, first);
  Simulator->SetExposureNumber(0);
  EXPECT_EQ(responses(), first);
  Simulator->SetRepeats(2);
  EXPECT_EQ(responses().rightCols(48), second);
  Simulator->SetNoise(vtkCameraSimulator::NO_NOISE);
  Simulator->SetRepeats(1);
  EXPECT_LT((responses() - Ideal).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(CameraSimulatorTables, QuantisesToWholeSteps)
{
  Simulator->SetNoise(vtkCameraSimulator::NOISE_AS_GIVEN);
  Simulator->SetQuantisationStep(1.0 / 255.0);
  const Eigen::ArrayXXd steps = responses().array() * 255.0;
  EXPECT_LT((steps - steps.round()).abs().maxCoeff(), 1e-9);
}

TEST_F(CameraSimulatorTables, Errors)
{
  EXPECT_EQ(
    errorWith(R"([{"effect": "ghosts"}])").rfind("EffectList:1:3: effect 1 (ghosts): ", 0), 0u);
  EXPECT_EQ(errorWith("nothing"),
    "EffectList:1:2: this is no JSON; expected a JSON object; correct this line");
  Samples->RemoveColumnByName("x");
  Samples->RemoveColumnByName("y");
  EXPECT_EQ(errorWith(R"([{"effect": "vignetting", "parameters": {"falloff": 0.1}}])"),
    "an effect of the camera depends on the position, but the scene has no x and y");
  addTextColumn(Samples, "x", std::vector<std::string>(48, "left"));
  EXPECT_EQ(
    errorWith("[]"), "the sample table: the column 'x' is not a column of numbers, one per sample");
  Simulator->SetInputData(0, newTable({ { "C1", { 1.0 } } }));
  EXPECT_EQ(errorWith("[]"),
    "the sample table has no columns of measured reflectance (R400, R410, ..); it has 1 other "
    "columns");
  Simulator->SetInputData(1, newTable({ { "C1", { 1.0 } } }));
  EXPECT_EQ(errorWith("[]"),
    "the camera has no column of numbers 'wavelength'; expected wavelength and one curve a "
    "channel");
}

TEST_F(CameraSimulatorTables, NegativeNoiseIsRefused)
{
  Simulator->SetNoise(vtkCameraSimulator::NOISE_AS_GIVEN);
  Simulator->SetReadNoise(-1.0);
  EXPECT_NE(errorOf(Simulator), "");
  EXPECT_NE(printed(Simulator).find("ReadNoise: -1"), std::string::npos);
}

TEST(CameraSimulatorWhiteLevel, GoesFromTheCameraToTheResponses)
{
  vtkNew<vtkCameraSimulator> simulator;
  simulator->SetInputData(0, rasterTable());
  simulator->SetInputData(1, cameraTableOfCounts(4095.0));
  ASSERT_EQ(errorOf(simulator), "");
  auto* level = simulator->GetOutputDataObject(0)->GetFieldData()->GetArray("WhiteLevel");
  ASSERT_NE(level, nullptr);
  EXPECT_EQ(level->GetTuple1(0), 4095.0);
  // Responses stay relative to white.
  const Eigen::MatrixXd counted =
    responsesOf(vtkTable::SafeDownCast(simulator->GetOutputDataObject(0)));
  simulator->SetInputData(1, cameraTable());
  ASSERT_EQ(errorOf(simulator), "");
  EXPECT_EQ(simulator->GetOutputDataObject(0)->GetFieldData()->GetArray("WhiteLevel"), nullptr);
  EXPECT_EQ(responsesOf(vtkTable::SafeDownCast(simulator->GetOutputDataObject(0))), counted);
}

}
