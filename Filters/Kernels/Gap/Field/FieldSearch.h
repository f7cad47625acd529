// Which set of effects explains the gap of an image pair.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/Field/FieldPeriod.h"

#include <functional>
#include <string>
#include <vector>

namespace msi
{

// An effect and what it costs without and with it.
struct FieldSingle
{
  const FieldChoice* choice;
  double energy;               // cross-validated, alone
  Eigen::VectorXd blockEnergy; // of each block
};

struct FieldSearchResult
{
  FieldSet set;
  FieldStatistics before; // the nominal model
  FieldStatistics after;  // with the effects
  FieldWeights weights;
  double gapEnergy = 0.0; // weighted, beyond noise, before any effect
  double price = 0.0;     // of a parameter, in energy
  std::vector<FieldSingle> singles;
  std::vector<std::string> indistinct; // effects that the scene cannot show
  FieldPeriod rows, columns;
};

// Forward: the effect that lowers the cross-validated energy of the training blocks most (and the price of
// its parameters) is added where the gain is significant from block to block and a relevant part of the gap; each
// time the two best by linear prediction are fitted in full. Backward: effects are exchanged or dropped where
// that costs nothing; at last up to two at once take the place of up to two. stop() is asked now and then; true ends the search early.
FieldSearchResult searchField(const FieldData& data, const std::vector<FieldChoice>& choices,
  int maximumEffects, const FieldLoop& loop, const std::function<bool()>& stop);

// Mean over blocks and channels of the squared block mean of the residual over what white noise allows.
double blockMeanExcess(const FieldData& data, const FieldStatistics& statistics, bool training);

} // namespace msi
