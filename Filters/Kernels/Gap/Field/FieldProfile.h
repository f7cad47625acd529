// What the lines of an image pair, rows or columns, have of their own.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Numbers of the lines with their weights; lines x K.
struct LineValues
{
  Eigen::ArrayXXd value, weight;
};

// The relative gain and the offset of the residual of each line, from one fold's blocks.
struct LineSums
{
  LineValues gain, offset; // value: times weight
};

// Of each fold. limit: residuals count up to this size, K; empty: in full.
std::vector<LineSums> lineSums(const FieldData& data, const FieldModel& model, bool alongRows,
  const Eigen::ArrayXd& limit, const FieldLoop& loop);

// Takes a polynomial off each channel: 1 term is the mean, 3 a quadratic.
void detrend(LineValues& lines, Eigen::Index terms);

// Gain and offset of each line as the residual of the model shows them, without their mean and, but for keepTrend, without
// the quadratic that may as well be light. The strongest fiftieth of the lines are cut to the next: a line that is defect
// is no stripe.
FieldProfile findProfile(const FieldData& data, const FieldModel& model, bool alongRows,
  bool keepTrend, const Eigen::ArrayXd& limit, const FieldLoop& loop);

} // namespace msi
