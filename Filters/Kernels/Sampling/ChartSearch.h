// Finds a chart of equal patches in an image.
#pragma once

#include "Kernels/Sampling/ChartImage.h"
#include "Kernels/Sampling/PatchGrid.h"

#include <Eigen/Core>

namespace msi
{

struct ChartSearchOptions
{
  int columns = 6; // patches along the first row
  int rows = 4;
  // What is known of the patches' responses, channels x (columns * rows), up to a factor and an offset of the logarithm
  // per channel: measured reflectance at the channels' wavelengths. Patches are numbered along the rows; NaN where
  // nothing is known. Empty: the chart is taken to stand upright.
  Eigen::MatrixXd expected = {};
  // Of the chart's patches must be seen: those like their surroundings may be missing.
  double leastSeen = 0.4;
};

struct ChartPlacement
{
  // Pixels of the original, row 0 at the top: of the first patch's cell, the end of the first row, the last patch, the
  // start of the last row. Cells reach to the middle between neighbouring patches.
  PatchGrid::Corners corners;
  int seen = 0;          // patches that were seen as such
  double residual = 0.0; // rms distance of their middles from the grid, in cells
  double agreement =
    0.0; // mean correlation of log response and log expected response; NaN without expected ones
  double secondAgreement =
    0.0; // of the best other placement or orientation; -1 where there is none
};

// Even regions, their lattice, and the window of rows x columns in it, turned so that responses agree best with what is
// expected. A mirrored chart is not looked for.
//
// Errors: std::invalid_argument for options that do not fit; std::runtime_error where no such grid is seen, or its
//         colors do not agree with the expected ones (agreement below 0.5).
// Cost:   about a second for a small image; a large one is reduced first (ChartImage.h).
ChartPlacement findChart(const ChartImage& image, const ChartSearchOptions& options);

// The agreement of a placement; corners in pixels of the original.
double chartAgreement(
  const ChartImage& image, const ChartSearchOptions& options, const PatchGrid::Corners& corners);

} // namespace msi
