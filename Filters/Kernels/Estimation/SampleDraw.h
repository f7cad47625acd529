// Reproducible random draws of samples.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace msi
{

// 'count' different indices out of [0, population), in increasing order; every such choice is equally likely.
// The same seed and draw give the same indices on every platform: Floyd's sampling (doi
// 10.1145/30401.315746) on std::mt19937_64, whose output the C++ standard fixes, seeded with the
// SplitMix64 hash (doi 10.1145/2714064.2660195) of seed and draw, bounded by rejection.
//
// Errors: std::invalid_argument unless 0 <= count <= population.
std::vector<Eigen::Index> drawSamples(
  Eigen::Index population, Eigen::Index count, std::uint64_t seed, std::uint64_t draw);

// The indices of [0, population) that are not in 'chosen', which is increasing.
std::vector<Eigen::Index> remainingSamples(
  Eigen::Index population, const std::vector<Eigen::Index>& chosen);

// Samples to leave out together, fold by fold: sample i with all that equal it modulo the number of folds, which is
// 'mostFolds' or the number of samples where there are fewer.
std::vector<std::vector<Eigen::Index>> leftOutFolds(Eigen::Index samples, Eigen::Index mostFolds);

} // namespace msi
