// Frames that are missing or in each other's place: what would give a black image, or a wrong one, is said.
#include "vtkFlatFieldCorrection.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

class Frames : public ::testing::Test
{
protected:
  static vtkSmartPointer<vtkImageData> flat(double value)
  {
    return newImage(
      4, 3, "counts", Eigen::MatrixXd::Constant(2, 12, value), WavelengthGrid({ 450.0, 550.0 }));
  }
  std::string error() { return errorOf(this->Correction); }
  std::string warning()
  {
    MessageLog log(this->Correction);
    this->Correction->Update();
    EXPECT_EQ(log.firstError(), "");
    return log.firstWarning();
  }
  void connect(double raw, double white, double dark)
  {
    this->Correction->SetInputData(0, flat(raw));
    this->Correction->SetInputData(1, flat(white));
    this->Correction->SetInputData(2, flat(dark));
  }

  vtkNew<vtkFlatFieldCorrection> Correction;
};

TEST_F(Frames, InTheirPlacesAreNotRemarkedOn)
{
  this->connect(500.0, 1000.0, 100.0);
  EXPECT_EQ(this->warning(), "");
  this->connect(
    90.0, 1000.0, 100.0); // a black sample, below the dark by its noise, is most of no image
  EXPECT_NE(this->warning(), "");
}

TEST_F(Frames, WhiteAndDarkSwapped)
{
  this->connect(500.0, 100.0, 1000.0);
  EXPECT_EQ(this->error(),
    "the white image is above the dark image in no pixel and no channel; expected the white to be "
    "brighter; are white "
    "and dark swapped?");
}

TEST_F(Frames, RawAndDarkSwapped)
{
  this->connect(100.0, 1000.0, 500.0);
  EXPECT_EQ(
    this->warning(), "100 % of the raw values are below the dark image; are the images swapped?");
}

TEST_F(Frames, RawAndWhiteSwapped)
{
  this->connect(1000.0, 500.0, 100.0);
  EXPECT_EQ(this->warning(),
    "100 % of the raw values exceed the white 1.5 times; are the images swapped, or exposed "
    "differently "
    "(Exposure Times)?");
}

TEST_F(Frames, ValuesAtTheEndOfTheirRange)
{
  const auto saturated = [](double value, double end)
  {
    auto image = flat(value);
    auto* scalars = image->GetPointData()->GetScalars();
    for (vtkIdType i = 0; i < scalars->GetNumberOfTuples() / 4; ++i)
    {
      scalars->SetComponent(i, 0, end);
    }
    return image;
  };
  this->connect(1000.0, 3000.0, 100.0);
  this->Correction->SetInputData(0, saturated(1000.0, 4095.0));
  EXPECT_NE(this->warning().find(
              "13 % of the values of the raw image are at the end of their range (4095)"),
    std::string::npos)
    << this->warning();
  this->connect(0.5, 0.9, 0.1);
  this->Correction->SetInputData(1, saturated(0.9, 1.0));
  EXPECT_NE(
    this->warning().find("13 % of the values of the white image are at the end of their range (1)"),
    std::string::npos)
    << this->warning();
  this->Correction->SetSaturationLevel(1.0);
  EXPECT_EQ(this->warning(), "");
  this->Correction->SetSaturationLevel(0.0);
  this->Correction->SetInputData(1, saturated(0.9, 0.95));
  EXPECT_EQ(this->warning(), "");
}

TEST_F(Frames, Missing)
{
  this->Correction->SetInputData(0, flat(0.5));
  EXPECT_EQ(this->error(),
    "neither a white nor a dark image is connected, so the raw values would pass unchanged; "
    "connect a white image, or set White Level");
  this->Correction->SetWhiteLevel(2.0);
  EXPECT_EQ(this->warning(), "");
  this->Correction->SetWhiteLevel(1.0);
  this->Correction->SetInputData(2, flat(0.1));
  EXPECT_EQ(this->warning(),
    "no white image is connected and White Level is 1: the responses are not relative to white; "
    "connect a white image, or set White Level");
  this->Correction->SetInputData(2, flat(100.0));
  EXPECT_EQ(this->error(),
    "the White Level is above the dark image in no pixel and no channel; expected the white to be "
    "brighter; set "
    "White Level, or connect a white image");
}
}
