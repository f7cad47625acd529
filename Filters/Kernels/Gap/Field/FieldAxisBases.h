// The columns that stand for an axis of the gap, and their least squares.
#pragma once

#include "Kernels/Gap/Field/FieldStatistics.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

struct FieldAxis
{
  const char* name;
  std::vector<int> common, own; // columns: one coefficient for all channels, or one for each
};

// channel and level first. Where the surround is partly not simulated (gaps) it is no part of the edges.
std::vector<FieldAxis> fieldAxisBases(const FieldModel& model, bool gaps);

// The normal matrices of one part of the blocks, K.
std::vector<Eigen::MatrixXd> sumOfNormals(
  const FieldData& data, const FieldStatistics& statistics, bool training);

// Least squares of the common and the channels' own columns; change of the columns, K.
std::vector<Eigen::VectorXd> regress(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<int>& common, const std::vector<int>& own);

// The common gain is the level's: takes it off the channels' and solves for the others again.
void takeCommonGain(
  std::vector<Eigen::MatrixXd> normal, std::vector<int> own, std::vector<Eigen::VectorXd>& change);

// Leaves to the columns of the position only what differs over the field: takes off their part along u.
void centerPosition(std::vector<Eigen::MatrixXd>& training, std::vector<Eigen::MatrixXd>& test);

double energyLeft(
  const std::vector<Eigen::MatrixXd>& normal, const std::vector<Eigen::VectorXd>& change);

} // namespace msi
