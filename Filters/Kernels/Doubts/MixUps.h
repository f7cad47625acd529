// Readings that seem to belong to other samples, places or channels than they are said to: a chart the other way round, filters in
// another order. And channels that do not work, or are there twice.
#pragma once

#include "Kernels/Doubts/PairSums.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// Another order of samples or places. instead: of each column the one that it is taken for.
struct Arrangement
{
  std::string what; // "in reverse order"
  std::vector<Eigen::Index> instead;
};
// Of so many samples: in reverse order, shifted by one; where x and y are not empty, turnedPlaces(), too.
std::vector<Arrangement> arrangementsOf(
  Eigen::Index samples, const Eigen::ArrayXd& x = {}, const Eigen::ArrayXd& y = {});
// Mirrored, upside down, turned by 180 degrees; those alone that take every place to another one. x, y: in any unit in which
// places are at least 0.04 apart.
std::vector<Arrangement> turnedPlaces(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y);

// Channels that do not change with the scene as the others do.
std::vector<Eigen::Index> deadChannels(const std::vector<PairSums>& channels);
// In words; empty where there are none. consequence: ", and takes no part".
std::string deadChannelsNote(const std::vector<Eigen::Index>& dead,
  const std::vector<std::string>& channels, const std::string& consequence = {});

struct MixUp
{
  std::string question; // empty: nothing
  // Channels, or all samples or places, are others than told: whatever explains the gap otherwise is in doubt.
  bool ofAll = false;
};
// In words, which channel is dead, else which have the same values, else what fits much better than as told: a quarter of the
// squares left, after a gain of each channel. Empty: nothing.
// together: that they go together at all is known.
// observed, simulated: K x S, NaN: not measured. channels, columns: K and S names; without columns no single ones are looked at.
MixUp mixUp(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<Arrangement>& arrangements, const std::vector<std::string>& channels,
  const std::vector<std::string>& columns = {}, bool together = false);

} // namespace msi
