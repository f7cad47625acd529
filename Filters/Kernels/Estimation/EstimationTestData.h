// What the tests of this room share: the expected values of reference_estimation.py, instruction sets, error texts, and
// the real samples outside the repository.
#pragma once

#include "Kernels/Estimation/NamedMatrixText.h"
#include "Kernels/Estimation/SampleSet.h"

#include <hwy/targets.h>

#include <Eigen/Core>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace msi::test
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// Calls check() with the best instruction set of this processor off, then the two best, and so on.
template <typename Check>
void withLesserInstructionSets(const Check& check)
{
  std::uint32_t disabled = 0;
  for (std::uint32_t best = hwy::SupportedTargets(); (best & (best - 1)) != 0;
       best = hwy::SupportedTargets())
  {
    disabled |= best & (~best + 1U);
    hwy::DisableTargets(disabled);
    SCOPED_TRACE("without targets " + std::to_string(disabled));
    check();
  }
  hwy::DisableTargets(0);
  EXPECT_NE(disabled, 0U) << "only one instruction set was tried";
}

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

inline double largestDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  if (a.rows() != b.rows() || a.cols() != b.cols())
  {
    return std::numeric_limits<double>::infinity();
  }
  return (a - b).cwiseAbs().maxCoeff();
}

template <typename F>
std::string messageOf(F&& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

inline Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed)
{
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

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
