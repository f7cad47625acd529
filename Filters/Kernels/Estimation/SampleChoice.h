// Which samples of a medium to measure next, from camera responses alone.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

struct SampleChoice
{
  std::vector<Eigen::Index> samples; // columns of the candidates, the most informative first
  // Per rank: the share of the expected error, summed over all candidates, that the chart leaves, and
  // that measuring this sample and those before it takes away. Increasing, 0..1.
  std::vector<double> explained;
};

// Greedy choice for the method "transfer": its Gaussian processes with the hyperparameters from which
// its fit starts tell how uncertain the reflectance of every candidate is once the chart is known, and
// how far a measurement of one candidate reduces that of all. Each sample chosen is the one that reduces
// the sum of standard deviations most, given those before it; of equal candidates the first.
//
// Source: choice by the expected mean error, there squared: Cohn, "Neural network exploration using optimal
//         experiment design", 1996, doi 10.1016/0893-6080(95)00137-9; Seo, Wallat, Graepel and
//         Obermayer, "Gaussian process regression: active data selection", 2000, doi
//         10.1109/IJCNN.2000.861310.
// Shapes: responses of chart and candidates are K x L; any unit and any gain of a channel, the same in
//         both.
// Errors: std::invalid_argument where a set is empty or not finite, where channels differ, or unless
//         1 <= count <= candidates.
// Cost:   O((L_A + L) L_A^2 + count L^2) flop.
SampleChoice chooseSamples(const Eigen::MatrixXd& chartResponses,
  const Eigen::MatrixXd& candidateResponses, Eigen::Index count);

} // namespace msi
