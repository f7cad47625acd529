#include "Kernels/Gap/Field/FieldObservation.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldStarts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace msi
{

namespace
{
const FieldHypothesis& hypothesisOf(const ObservedFit& fit)
{
  return static_cast<const FieldObservedFit&>(fit).hypothesis;
}

std::vector<GapOption> fieldOptions(const std::vector<FieldChoice>& choices)
{
  std::vector<GapOption> options;
  for (std::size_t c = 0; c < choices.size(); ++c)
  {
    const auto before = std::count_if(choices.begin(), choices.begin() + c,
      [&](const FieldChoice& other) { return other.effect == choices[c].effect; });
    const bool ofChannels = std::any_of(choices[c].terms.begin(), choices[c].terms.end(),
      [](const ImageTerm& term) { return term.perChannel && !term.followsLight; });
    options.push_back({ choices[c].effect, choices[c].form, "", ofChannels,
      Decision::EffectImprobability + Decision::FormImprobability * static_cast<double>(before) });
  }
  return options;
}

// Of a channel, the most that an effect needs.
Eigen::Index numbersOfAChannel(const std::vector<FieldChoice>& choices)
{
  std::map<const EffectDefinition*, std::ptrdiff_t> fewest; // forms with more come later
  Eigen::Index most = 0;
  for (const FieldChoice& choice : choices)
  {
    const auto count = std::count_if(choice.terms.begin(), choice.terms.end(),
      [](const ImageTerm& term) { return term.perChannel; });
    if (count > 0)
    {
      most = std::max(most, fewest.emplace(choice.effect, count).first->second);
    }
  }
  return most;
}

bool hasProfile(const FieldSet& set, bool rows)
{
  return hasChoice(set,
    [rows](const FieldChoice& choice) { return isProfile(choice) && isOfRows(choice) == rows; });
}

bool hasSine(const FieldSet& set, bool rows)
{
  return hasChoice(set,
    [rows](const FieldChoice& choice)
    { return isBanding(choice) && !isProfile(choice) && isOfRows(choice) == rows; });
}

// A form takes the place of a plainer one of the same effect.
FieldSet joined(FieldSet set, const FieldChoice& choice)
{
  set.erase(std::remove_if(set.begin(), set.end(),
              [&choice](const FieldChoice* other) { return extends(choice, *other); }),
    set.end());
  set.push_back(&choice);
  return set;
}

bool clips(const FieldChoice& choice)
{
  return choice.has(EffectTrait::LimitsResponse);
}
}

FieldObservation::FieldObservation(const FieldData& data, const std::vector<FieldChoice>& choices,
  const FieldWeights& weights, const std::vector<ImageDisplacement>& start)
  : Data(data)
  , Choices(choices)
  , Weights(weights)
  , Start(start)
{
  Options = fieldOptions(choices);
  ChannelNumbers = numbersOfAChannel(choices) * data.channels();
  FieldHypothesis hypothesis;
  hypothesis.statistics =
    std::make_shared<FieldStatistics>(fieldStatistics(data, FieldModel(data.channels()), &weights));
  const FieldFitter fitter(data, *hypothesis.statistics);
  hypothesis.fit = fitter.fit({});
  NoiseEnergy = groupSums(data, hypothesis.statistics->ofBlocks(&BlockSums::chance), true).sum();
  for (const std::vector<Eigen::MatrixXd>& fold : fitter.folds())
  {
    InexactEnergy[0] += energiesBesideGain(fold, false).sum();
    InexactEnergy[1] += energiesBesideGain(fold, true).sum();
  }
  Elements = groupSums(data, hypothesis.statistics->ofBlocks(&BlockSums::pixels), true).sum();
  Nominal = described(std::move(hypothesis));
}

bool FieldObservation::hasStart(const FieldModel& model, const FieldChoice& choice)
{
  if (isBanding(choice))
  {
    const FieldStripes& stripes = model.stripes(isOfRows(choice));
    return isProfile(choice) ? stripes.profile != nullptr : stripes.period > 0.0;
  }
  return !clips(choice) || !model.isNeutral(clippingTerms()[1].parameter);
}

const FieldHypothesis& FieldObservation::started(const ObservedFit& fit) const
{
  std::optional<FieldHypothesis>& known = static_cast<const FieldObservedFit&>(fit).started;
  if (known)
  {
    return *known;
  }
  FieldHypothesis hypothesis = hypothesisOf(fit);
  FieldModel model = hypothesis.statistics->model;
  const std::vector<FieldResidual> residuals = fieldResiduals(Data, model);
  for (const bool rows : { true, false })
  {
    if (!hasSine(hypothesis.set, rows))
    {
      findPeriod(Data, residuals, rows, model.stripes(rows));
    }
  }
  findProfiles(model, residuals, hypothesis.set, false);
  if (!hasChoice(hypothesis.set, clips))
  {
    model[clippingTerms()[1].parameter] = findClipLevels(residuals, Data.channels());
  }
  hypothesis.statistics = std::make_shared<FieldStatistics>(fieldStatistics(Data, model, &Weights));
  hypothesis.fit = FieldFitter(Data, *hypothesis.statistics).fit(hypothesis.set);
  return known.emplace(std::move(hypothesis));
}

// Of lines whose profile is not in the set; those of others stay as they are.
void FieldObservation::findProfiles(FieldModel& model, const std::vector<FieldResidual>& residuals,
  const FieldSet& set, bool keepTrend) const
{
  for (const bool rows : { true, false })
  {
    if (!hasProfile(set, rows))
    {
      model.stripes(rows).profile = std::make_shared<const FieldProfile>(
        findProfile(Data, residuals, rows, keepTrend, Weights.limit));
    }
  }
}

FieldModel FieldObservation::registered(const FieldModel& model, const FieldChoice& choice) const
{
  FieldModel moved = model;
  std::vector<double> numbers(choice.step().step->numbers.size());
  for (Eigen::Index k = 0; k < model.channels(); ++k)
  {
    choice.step().step->place(Start[k], numbers.data());
    for (const ImageTerm& term : choice.terms)
    {
      moved[term.parameter][k] = numbers[term.parameter - choice.step().number];
    }
  }
  for (const ImageTerm& term : choice.terms)
  {
    if (!term.perChannel)
    {
      moved[term.parameter].setConstant(moved[term.parameter].mean());
    }
  }
  return moved;
}

std::vector<GapPreview> FieldObservation::previews(const ObservedFit& from) const
{
  const FieldHypothesis& base = started(from);
  const FieldModel& model = base.statistics->model;
  const FieldFitter fitter(Data, *base.statistics);
  std::vector<GapPreview> previews;
  for (std::size_t option = 0; option < Choices.size(); ++option)
  {
    const FieldChoice& choice = Choices[option];
    if (!compatible(base.set, choice) || !hasStart(model, choice))
    {
      continue;
    }
    const FieldSet set = joined(base.set, choice);
    GapPreview preview{ option, {}, {} };
    FieldFit fit = fitter.fitFromBestStart(set);
    if (choice.step().step->place != nullptr && !Start.empty())
    {
      const FieldModel moved = registered(model, choice);
      const FieldStatistics there = fieldStatistics(Data, moved, &Weights, stepsOf(set));
      FieldFit other = FieldFitter(Data, there).fit(set);
      if (other.energy < fit.energy)
      {
        fit = std::move(other);
        preview.start = { 1.0 };
      }
    }
    describe(preview.fit, set, fit);
    previews.push_back(std::move(preview));
  }
  return previews;
}

FitPointer FieldObservation::extended(const ObservedFit& from, const GapPreview& with) const
{
  const FieldHypothesis& base = started(from);
  const FieldChoice& choice = Choices[with.option];
  const FieldSet set = joined(base.set, choice);
  FieldHypothesis hypothesis = refitted(Data, Weights, set,
    with.start.empty() ? FieldFitter(Data, *base.statistics).fitFromBestStart(set).next
                       : registered(base.statistics->model, choice));
  // Once more beside the other effects.
  for (const FieldChoice* profile : set)
  {
    if (isProfile(*profile))
    {
      const FieldModel found = hypothesis.fit.next;
      const ImageParameter strength = profile->terms.front().parameter;
      FieldSet others = set;
      others.erase(std::remove(others.begin(), others.end(), profile), others.end());
      FieldModel without = found;
      without[strength].setZero();
      const std::vector<FieldResidual> residuals = fieldResiduals(Data, without);
      for (const bool keepTrend : { false, true })
      {
        FieldModel model = found;
        findProfiles(model, residuals, others, keepTrend);
        FieldHypothesis other = refitted(Data, Weights, set, model);
        if (!keepTrend || other.fit.energy < hypothesis.fit.energy)
        {
          hypothesis = std::move(other);
        }
      }
    }
  }
  return described(std::move(hypothesis));
}

FitPointer FieldObservation::reduced(const ObservedFit& from, std::size_t positions) const
{
  FitPointer& known = static_cast<const FieldObservedFit&>(from).reduced[positions];
  if (known)
  {
    return known;
  }
  const FieldHypothesis& all = hypothesisOf(from);
  FieldSet set;
  for (std::size_t e = 0; e < all.set.size(); ++e)
  {
    if ((positions >> e & 1U) != 0)
    {
      set.push_back(all.set[e]);
    }
  }
  return known = described(
           refitted(Data, Weights, set, FieldFitter(Data, *all.statistics).fit(set).next));
}

void FieldObservation::describe(
  ObservedFit& described, const FieldSet& set, const FieldFit& fit) const
{
  for (const FieldChoice* choice : set)
  {
    described.set.push_back(choice - Choices.data());
  }
  described.energy = fit.energy;
  fit.linear.describe(described, fit.increase);
}

FitPointer FieldObservation::described(FieldHypothesis hypothesis) const
{
  auto described = std::make_shared<FieldObservedFit>();
  describe(*described, hypothesis.set, hypothesis.fit);
  for (const FieldChoice* choice : hypothesis.set)
  {
    described->atBound =
      described->atBound || (isProfile(*choice) && isSlow(*choice, hypothesis.fit.next));
  }
  described->hypothesis = std::move(hypothesis);
  return described;
}

GroupEnergies FieldObservation::energies(const ObservedFit& fit) const
{
  const FieldStatistics& nominal = *hypothesisOf(*Nominal).statistics;
  const auto sums = [this](const FieldHypothesis& hypothesis)
  { return groupSums(Data, blockEnergies(Data, *hypothesis.statistics, hypothesis.fit), true); };
  const Eigen::ArrayXd noise = groupSums(Data, nominal.ofBlocks(&BlockSums::chance), true);
  GroupEnergies energies(noise.size(), 3);
  energies << sums(hypothesisOf(*Nominal)), sums(hypothesisOf(fit)), noise;
  return energies;
}

std::vector<std::vector<GapParameter>> FieldObservation::parameters(const ObservedFit& fit) const
{
  const FieldHypothesis& hypothesis = hypothesisOf(fit);
  const Eigen::VectorXd error =
    FieldFitter(Data, *hypothesis.statistics).standardErrors(hypothesis.set, hypothesis.fit);
  const FieldModel& model = hypothesis.statistics->model;
  Eigen::Index next = 0;
  std::vector<std::vector<GapParameter>> parameters;
  for (const FieldChoice* choice : hypothesis.set)
  {
    parameters.push_back(fieldParameters(*choice, model, Data.pair.channels, error, next));
  }
  return parameters;
}

} // namespace msi
