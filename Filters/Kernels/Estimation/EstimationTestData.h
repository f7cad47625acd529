// What the tests of this room share: the expected values of reference_estimation.py, and
// the real samples outside the repository.
#pragma once

#include "Kernels/Estimation/NamedMatrixText.h"
#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/NumericsTestData.h"

#include <Eigen/Core>

#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace msi::test
{

// One problem with its solutions, all computed by NumPy.
class ExpectedEstimation
{
public:
  explicit ExpectedEstimation(int problem)
    : Suffix(std::to_string(problem))
  {
    std::ifstream file(
      MULTISPECTRAL_SOURCE_DIR "/Filters/Kernels/Estimation/ExpectedEstimation.txt");
    Matrices = readNamedMatrices(file);
  }
  const Eigen::MatrixXd& operator[](const std::string& name) const
  {
    return Matrices.at(name + Suffix);
  }
  SampleSet calibration() const { return { (*this)["R"], (*this)["U"] }; }
  SampleSet tuning() const { return { (*this)["S"], (*this)["V"] }; }

private:
  std::string Suffix;
  std::map<std::string, Eigen::MatrixXd> Matrices;
};

// A table with columns R<nm> and C<nm>.
inline SampleSet samplesIn(const std::string& path)
{
  std::ifstream file(path);
  std::vector<std::vector<double>> reflectances;
  std::vector<std::vector<double>> responses;
  std::string header;
  std::getline(file, header);
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream names(header);
    std::istringstream cells(line);
    reflectances.emplace_back();
    responses.emplace_back();
    std::string column;
    std::string cell;
    while (std::getline(names, column, ',') && std::getline(cells, cell, ','))
    {
      if (column[0] == 'R')
      {
        reflectances.back().push_back(std::stod(cell));
      }
      else if (column[0] == 'C')
      {
        responses.back().push_back(std::stod(cell));
      }
    }
  }
  const auto toMatrix = [](const std::vector<std::vector<double>>& rows)
  {
    Eigen::MatrixXd matrix(
      static_cast<Eigen::Index>(rows.at(0).size()), static_cast<Eigen::Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      matrix.col(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::VectorXd>(rows[i].data(), matrix.rows());
    }
    return matrix;
  };
  return { toMatrix(reflectances), toMatrix(responses) };
}

// Such a table under $MULTISPECTRAL_DATA; empty without the variable.
inline std::optional<SampleSet> realSamples(const std::string& name)
{
  const char* folder = std::getenv("MULTISPECTRAL_DATA");
  if (folder == nullptr)
  {
    return std::nullopt;
  }
  return samplesIn(std::string(folder) + "/" + name);
}

} // namespace msi::test
