#include "Kernels/Estimation/MetamerismCorrection.h"

#include "Kernels/Estimation/MeanColorDifference.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <sstream>

namespace msi
{

namespace
{
constexpr double DiagonalSpacing = 30.0; // nm
constexpr double AssumedSpan = 300.0;    // nm, 400..700
// Directions of response that W_s carries to less than this share of the largest are no reflectance
// but rounding: its inverse must not bring them back.
constexpr double TransformRankTolerance = 1e-10;

Eigen::Index neighboursOf(BandStructure structure)
{
  return structure == BandStructure::Diagonal ? 0 : 1;
}

void requireSolvable(
  const SampleSet& calibration, const SampleSet& tuning, const MetamerismOptions& options)
{
  requireValid(calibration, "calibration");
  requireValid(tuning, "tuning");
  requireSameShape(calibration, "calibration", tuning, "tuning");
  if (calibration.channels() > calibration.bands())
  {
    reject("there are ", calibration.channels(), " response channels but only ",
      calibration.bands(),
      " reflectance bands; the metamerism correction expects at least as many bands");
  }
  if (options.maximumRounds < 1)
  {
    reject("the number of rounds is ", options.maximumRounds, "; expected at least 1");
  }
  if (!(options.tuningWeight >= 0.0) || !std::isfinite(options.tuningWeight))
  {
    reject("the tuning weight is ", options.tuningWeight,
      "; expected a positive finite number, or 0 for sqrt(L_A / L_T)");
  }
  if (options.channelWavelengths && options.channelWavelengths->size() != calibration.channels())
  {
    reject(options.channelWavelengths->size(), " channel wavelengths are given for ",
      calibration.channels(), " response channels; expected one a channel");
  }
}

struct StructureChoice
{
  BandStructure structure;
  bool reduced; // diagonal because of too few samples
};

StructureChoice chooseStructure(
  Eigen::Index channels, Eigen::Index tuningSamples, const MetamerismOptions& options)
{
  const bool automatic = options.structure == BandStructure::Automatic;
  StructureChoice choice{
    automatic ? bandStructureFor(channels, options.channelWavelengths) : options.structure, false
  };
  const auto needed = [&] { return unknownsPerRow(channels, neighboursOf(choice.structure)); };
  if (automatic && tuningSamples < needed() && choice.structure == BandStructure::Tridiagonal)
  {
    choice = { BandStructure::Diagonal, true };
  }
  if (tuningSamples < needed())
  {
    reject("there ", tuningSamples == 1 ? "is " : "are ", counted(tuningSamples, "tuning sample"),
      " for ", needed(), " unknowns a channel of the ",
      (choice.structure == BandStructure::Diagonal ? "diagonal" : "tridiagonal"),
      " metamerism transform; expected at least ", counted(needed(), "sample"));
  }
  return choice;
}

std::string statusOf(const StructureChoice& choice, const MetamerismFit& fit,
  const BandedFit& banded, const CalibrationFit& reflectance, bool stoppedByColor)
{
  std::ostringstream status;
  const auto rounds = fit.history.size();
  status << (fit.structure == BandStructure::Diagonal ? "diagonal" : "tridiagonal")
         << " transform after " << counted(static_cast<std::ptrdiff_t>(rounds), "round");
  if (stoppedByColor)
  {
    status << ", stopped by the change of the mean color difference";
  }
  if (choice.reduced)
  {
    status << "; diagonal because a tridiagonal one needs 4 tuning samples and there "
           << (fit.summary.samples == 1 ? "is " : "are ") << fit.summary.samples;
  }
  if (!banded.deficientRows.empty())
  {
    status << "; undetermined and kept nearest to no change in channel "
           << listOfRows(banded.deficientRows);
  }
  if (!reflectance.summary.complete)
  {
    status << "; the reflectance transform is " << reflectance.summary.status;
  }
  return status.str();
}
}

BandStructure bandStructureFor(
  Eigen::Index channels, const std::optional<WavelengthGrid>& channelWavelengths)
{
  if (channels < 2)
  {
    return BandStructure::Diagonal;
  }
  const double span =
    channelWavelengths ? channelWavelengths->back() - channelWavelengths->front() : AssumedSpan;
  return span / static_cast<double>(channels - 1) >= DiagonalSpacing ? BandStructure::Diagonal
                                                                     : BandStructure::Tridiagonal;
}

MetamerismFit fitMetamerismCorrection(
  const SampleSet& calibration, const SampleSet& tuning, const MetamerismOptions& options)
{
  requireSolvable(calibration, tuning, options);
  std::optional<MeanColorDifference> meanColorDifference;
  if (options.colorStop)
  {
    meanColorDifference.emplace(*options.colorStop, tuning.reflectance);
  }
  const StructureChoice choice = chooseStructure(calibration.channels(), tuning.size(), options);
  const double weight = options.tuningWeight > 0.0
    ? options.tuningWeight
    : std::sqrt(static_cast<double>(calibration.size()) / static_cast<double>(tuning.size()));
  const CalibrationOptions calibrationOptions{ options.rankTolerance };

  CalibrationFit reflectance = fitPseudoinverse(calibration, calibrationOptions);
  BandedFit banded;
  MetamerismFit fit{ reflectance.transform, AffineTransform::identity(tuning.channels()),
    reflectance.transform, choice.structure, weight, {}, {} };
  bool stoppedByColor = false;
  while (static_cast<int>(fit.history.size()) < options.maximumRounds && !stoppedByColor)
  {
    // W_s+ (S - w 1') = X solves W_s X = S - w 1', so X' W_s' = (S - w 1')'.
    const LeastSquaresSolution inverted = solveLeastSquares(fit.reflectance.linear().transpose(),
      (tuning.reflectance.colwise() - fit.reflectance.constant()).transpose(),
      options.rankTolerance >= 0.0 ? options.rankTolerance : TransformRankTolerance);
    const Eigen::MatrixXd wanted = inverted.coefficients.transpose();
    banded =
      fitBanded(tuning.response, wanted, neighboursOf(choice.structure), options.rankTolerance);
    fit.metamerism = AffineTransform(banded.coefficients);
    const SampleSet corrected{ tuning.reflectance, fit.metamerism(tuning.response) };
    reflectance = fitPooled(calibration, corrected, weight, calibrationOptions);
    fit.reflectance = reflectance.transform;

    MetamerismRound round;
    const Eigen::MatrixXd estimate = fit.reflectance(corrected.response);
    round.responseResidualRms = rootMeanSquare(corrected.response - wanted);
    round.reflectanceResidualRms = rootMeanSquare(estimate - tuning.reflectance);
    if (meanColorDifference)
    {
      round.meanColorDifference = (*meanColorDifference)(estimate);
      stoppedByColor = !fit.history.empty() &&
        std::abs(*round.meanColorDifference - *fit.history.back().meanColorDifference) <
          options.colorStop->threshold;
    }
    fit.history.push_back(round);
  }
  fit.composite = AffineTransform::compose(fit.reflectance, fit.metamerism);

  fit.summary.residualRms = fit.history.back().reflectanceResidualRms;
  fit.summary.rank = reflectance.summary.rank;
  fit.summary.condition = reflectance.summary.condition;
  fit.summary.unknowns = reflectance.summary.unknowns + banded.unknowns;
  fit.summary.samples = tuning.size();
  fit.summary.iterations = static_cast<int>(fit.history.size());
  fit.summary.complete =
    reflectance.summary.complete && banded.deficientRows.empty() && !choice.reduced;
  fit.summary.status = statusOf(choice, fit, banded, reflectance, stoppedByColor);
  return fit;
}

} // namespace msi
