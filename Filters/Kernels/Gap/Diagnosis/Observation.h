// The seam between the diagnosis and its data: a table of samples or a pair of images.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/Diagnosis/LinearFit.h"
#include "Kernels/Gap/ReportParts.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

// One form of one effect that may be tried.
struct GapOption
{
  const EffectDefinition* effect = nullptr;
  std::string form;
  std::string medium;
  bool perChannel = false;    // a number for every channel, and not because of the light
  double improbability = 0.0; // minus the logarithm of its probability before the data speak
  bool besideLine = false;    // FormTrait::BesideLine
  bool inDisguise = false;    // also a gain, which white would take away

  // The same effect on the same medium, whatever the form; but for FormTrait::BesideLine.
  bool sameCause(const GapOption& other) const noexcept
  {
    return effect == other.effect && medium == other.medium && besideLine == other.besideLine;
  }
};

// A set of options fitted to the data.
class ObservedFit
{
public:
  virtual ~ObservedFit() = default;

  std::vector<std::size_t> set; // numbers of options
  double energy = 0.0;          // weighted sum of squares, cross-validated by groups
  // Independent residuals would scatter by that much less in the sum over a group.
  double coherence = 1.0;
  BlockPrior prior;           // of its numbers, by which it is judged
  SparseMatrix information;   // their normal matrix without prior; unit dispersion
  double surprise = 0.0;      // LearnedPrior::surprise
  double chanceOfCurve = 1.0; // LearnedPrior::chanceOfCurve
  bool atBound = false;       // a parameter lies at the end of its range, or stripes are slow
};
using FitPointer = std::shared_ptr<const ObservedFit>;

// With one more option, or in the place of a plainer form, after one linear step.
struct GapPreview
{
  std::size_t option = 0;
  std::vector<double> start; // one number a parameter of the form; empty: neutral
  ObservedFit fit;
};

class Observation
{
public:
  virtual ~Observation() = default;

  const std::vector<GapOption>& options() const noexcept { return Options; }
  // Of all channels, the most that an effect needs.
  Eigen::Index channelNumbers() const noexcept { return ChannelNumbers; }
  double elements() const noexcept { return Elements; } // residuals with weight
  // What noise alone leaves of the energy.
  double noiseEnergy() const noexcept { return NoiseEnergy; }
  // Of the nominal fit, without a large gain of all channels or large ones of each (energiesBesideGain()).
  double inexactEnergy(bool ofChannels) const { return InexactEnergy[ofChannels ? 1 : 0]; }
  const FitPointer& nominal() const noexcept { return Nominal; }

  // Options whose effect the fit does not have, or has in a plainer form.
  virtual std::vector<GapPreview> previews(const ObservedFit& from) const = 0;
  virtual FitPointer extended(const ObservedFit& from, const GapPreview& with) const = 0;
  // The positions of `from` whose bit is set.
  virtual FitPointer reduced(const ObservedFit& from, std::size_t positions) const = 0;
  virtual GroupEnergies energies(const ObservedFit& fit) const = 0;
  // Of each position of the fit.
  virtual std::vector<std::vector<GapParameter>> parameters(const ObservedFit& fit) const = 0;

protected:
  std::vector<GapOption> Options;
  Eigen::Index ChannelNumbers = 1;
  double Elements = 0.0;
  double NoiseEnergy = 0.0;
  std::array<double, 2> InexactEnergy{};
  FitPointer Nominal;
};

} // namespace msi
