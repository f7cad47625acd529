// The real reflectances of MULTISPECTRAL_DATA through ArgyllCMS spec2cie, if both are there.
#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TestTable.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using msi::Illuminant;
using msi::InterpolationMethod;
using msi::StandardObserver;
using msi::TristimulusTransform;
using msi::WavelengthGrid;

struct Reflectances
{
  WavelengthGrid grid;
  Eigen::MatrixXd values; // bands x samples
};

Reflectances read(const std::string& path)
{
  const TestTable table(path);
  std::vector<double> wavelengths;
  for (const std::string& name : table.header)
  {
    if (name.size() == 4 && name[0] == 'R')
    {
      wavelengths.push_back(std::stod(name.substr(1)));
    }
  }
  Reflectances result{ WavelengthGrid(wavelengths), {} };
  result.values.resize(result.grid.size(), static_cast<Eigen::Index>(table.rows.size()));
  for (Eigen::Index band = 0; band < result.grid.size(); ++band)
  {
    const std::string column = "R" + std::to_string(static_cast<int>(result.grid[band]));
    for (std::size_t row = 0; row < table.rows.size(); ++row)
    {
      result.values(band, static_cast<Eigen::Index>(row)) = table.number(row, column);
    }
  }
  return result;
}

// A CGATS file of spectra; `before` are columns that spec2cie wants to be there.
void writeCgats(const std::string& path, const std::string& head, const std::string& before,
  const WavelengthGrid& grid, const Eigen::MatrixXd& spectra)
{
  std::ofstream file(path);
  file << head << "SPECTRAL_BANDS \"" << grid.size() << "\"\nSPECTRAL_START_NM \"" << grid.front()
       << "\"\nSPECTRAL_END_NM \"" << grid.back()
       << "\"\nSPECTRAL_NORM \"100.0\"\n\nBEGIN_DATA_FORMAT\n"
       << before;
  for (Eigen::Index band = 0; band < grid.size(); ++band)
  {
    file << " SPEC_" << static_cast<int>(grid[band]);
  }
  file << "\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS " << spectra.cols() << "\nBEGIN_DATA\n"
       << std::fixed << std::setprecision(10);
  for (Eigen::Index i = 0; i < spectra.cols(); ++i)
  {
    file << (before.empty() ? "" : "S" + std::to_string(i + 1) + " 0 0 0 0 0 0");
    for (const double value : spectra.col(i))
    {
      file << ' ' << value;
    }
    file << '\n';
  }
  file << "END_DATA\n";
}

// A folder of its own for each run, because tests run side by side.
struct ScratchFolder
{
  std::string path = ::testing::TempDir() + "multispectral-argyll-XXXXXX";

  ScratchFolder()
  {
    if (mkdtemp(path.data()) == nullptr)
    {
      throw std::runtime_error("cannot make the folder " + path);
    }
    path += '/';
  }
  ~ScratchFolder() { std::filesystem::remove_all(path); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
};

struct Colors
{
  Eigen::Matrix3Xd xyz;
  Eigen::Matrix3Xd lab;
};

Colors spec2cie(const Reflectances& reflectances, const Illuminant& illuminant, bool tenDegree)
{
  const ScratchFolder scratch;
  const std::string& folder = scratch.path;
  std::string choice = illuminant.name();
  if (choice == "FL2")
  {
    choice = folder + "illuminant.sp";
    const auto fine = WavelengthGrid::uniform(360.0, 830.0, 1.0);
    writeCgats(choice, "SPECT\n\nMEAS_TYPE \"EMISSION\"\n", "", fine, illuminant.powerAt(fine));
  }
  writeCgats(folder + "in.ti3", "CTI3\n\nDEVICE_CLASS \"INPUT\"\nCOLOR_REP \"XYZ_RGB\"\n",
    "SAMPLE_ID XYZ_X XYZ_Y XYZ_Z RGB_R RGB_G RGB_B", reflectances.grid,
    100.0 * reflectances.values);
  const std::string command = "spec2cie -n -i '" + choice + "' -o " +
    (tenDegree ? "1964_10" : "1931_2") + " '" + folder + "in.ti3' '" + folder +
    "out.ti3' > /dev/null";
  if (std::system(command.c_str()) != 0)
  {
    throw std::runtime_error("failed: " + command);
  }

  std::ifstream file(folder + "out.ti3");
  std::string word;
  while (file >> word && word != "BEGIN_DATA_FORMAT")
  {
  }
  std::vector<std::string> names;
  while (file >> word && word != "END_DATA_FORMAT")
  {
    names.push_back(word);
  }
  while (file >> word && word != "BEGIN_DATA")
  {
  }
  const auto position = [&names](const char* name)
  { return std::find(names.begin(), names.end(), name) - names.begin(); };
  const auto x = position("XYZ_X");
  const auto l = position("LAB_L");
  Colors colors{ Eigen::Matrix3Xd(3, reflectances.values.cols()),
    Eigen::Matrix3Xd(3, reflectances.values.cols()) };
  for (Eigen::Index i = 0; i < reflectances.values.cols(); ++i)
  {
    for (std::ptrdiff_t field = 0; field < static_cast<std::ptrdiff_t>(names.size()); ++field)
    {
      file >> word;
      if (field >= x && field < x + 3)
      {
        colors.xyz(field - x, i) = std::stod(word);
      }
      else if (field >= l && field < l + 3)
      {
        colors.lab(field - l, i) = std::stod(word);
      }
    }
  }
  return colors;
}

// The two ask for the same colors from the same spectra, which our side interpolates by `method` from
// `own` and ArgyllCMS in its own way from `theirs`.
void compare(const Reflectances& own, const Reflectances& theirs, InterpolationMethod method)
{
  const msi::CIELAB iccLab(Eigen::Vector3d(96.42, 100.0, 82.49));
  for (const char* name : { "D65", "D50", "A", "FL2" })
  {
    for (const bool tenDegree : { false, true })
    {
      const Illuminant illuminant = Illuminant::named(name);
      const TristimulusTransform transform(own.grid, illuminant,
        tenDegree ? StandardObserver::cie1964TenDegree() : StandardObserver::cie1931TwoDegree(),
        method);
      const Eigen::Matrix3Xd xyz = transform(own.values);
      Eigen::Matrix3Xd lab(3, xyz.cols());
      iccLab.fromXYZ(xyz, lab);
      const Colors expected = spec2cie(theirs, illuminant, tenDegree);
      EXPECT_LT((xyz - expected.xyz).cwiseAbs().maxCoeff(), 0.01) << name << ' ' << tenDegree;
      EXPECT_LT((lab - expected.lab).cwiseAbs().maxCoeff(), 0.01) << name << ' ' << tenDegree;
    }
  }
}

class ArgyllLive : public ::testing::Test
{
protected:
  void SetUp() override
  {
    const char* data = std::getenv("MULTISPECTRAL_DATA");
    if (data == nullptr)
    {
      GTEST_SKIP() << "skipped: MULTISPECTRAL_DATA is not set";
    }
    if (std::system("command -v spec2cie > /dev/null 2>&1") != 0)
    {
      GTEST_SKIP() << "skipped: spec2cie of ArgyllCMS is not installed";
    }
    Folder = std::string(data) + "/reflectances/";
  }

  std::string Folder;
};

TEST_F(ArgyllLive, TextilesPaintsAndAChartAtTenNanometres)
{
  for (const char* name : { "clothes", "paint-chips", "colorchecker-sg" })
  {
    SCOPED_TRACE(name);
    const Reflectances measured = read(Folder + name + ".csv");
    compare(measured, measured, InterpolationMethod::CubicLagrange);
  }
}

TEST_F(ArgyllLive, TestColorsAtFiveNanometres)
{
  const Reflectances measured = read(Folder + "ces99.csv");
  compare(measured, measured, InterpolationMethod::Linear);

  const auto fine = WavelengthGrid::uniform(380.0, 780.0, 1.0);
  for (const auto method : { InterpolationMethod::CubicLagrange, InterpolationMethod::Sprague })
  {
    const Reflectances resampled{ fine,
      msi::resamplingMatrix(measured.grid, fine, method) * measured.values };
    compare(measured, resampled, method);
  }
}

}
