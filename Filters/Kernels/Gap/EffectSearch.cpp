#include "Kernels/Gap/EffectSearch.h"

#include "Kernels/Gap/ChannelStructure.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Iterations = 6;
constexpr int FormsFitted = 2; // of one effect
constexpr int FinalIterations = 20;
constexpr double ChanceOfMany =
  14.0; // dispersions: the best of some fifty useless effects stays below
constexpr double RelevantPart = 0.004; // of the gap's energy
constexpr double FormPart = 0.002;     // of the gap's energy, a parameter
constexpr double RicherFormPart =
  0.0002; // of the gap's energy, a parameter, once the effect is chosen
constexpr double UnlikelyForm =
  2.0; // dispersions: a form is e times less likely than the one before it
constexpr double FormDeviations = 4.0; // dispersions by which another form must be better
// What a simpler cause may be worse by: part of the gap's energy, dispersions.
constexpr double SimplerPart = 0.02;
constexpr double SimplerDeviations = 9.0;

// What speaks against a set before the data does, in dispersions: late forms, and an effect of a medium where there
// is but one.
double improbability(const EffectFitter& fitter, const EffectFit& fit)
{
  double sum = 0.0;
  for (const EffectChoice& choice : fit.set.choices)
  {
    sum += UnlikelyForm * static_cast<double>(choice.form - choice.effect->forms.data());
    const bool onlyMedium = !choice.medium.empty() && fitter.data().scene.media().size() == 1;
    sum += onlyMedium || choice.whiteAfter ? UnlikelyForm : 0.0;
  }
  return sum;
}

double cost(const EffectFitter& fitter, const EffectFit& fit, double gapEnergy, double dispersion)
{
  const double chance = 0.5 * std::log(std::fmax(fitter.trainingElements(), 2.0)) * dispersion;
  return fit.energy +
    static_cast<double>(fit.parameters()) * std::fmax(chance, FormPart * gapEnergy) +
    improbability(fitter, fit) * dispersion;
}

bool sameCauses(const EffectSet& a, const EffectSet& b)
{
  return a.size() == b.size() &&
    std::all_of(
      a.choices.begin(), a.choices.end(), [&b](const EffectChoice& c) { return b.has(c); });
}

// One fit for each set of causes, the cheapest.
void keepBestForms(
  std::vector<EffectFit>& fits, const std::function<double(const EffectFit&)>& price)
{
  std::stable_sort(fits.begin(), fits.end(),
    [&price](const EffectFit& a, const EffectFit& b) { return price(a) < price(b); });
  std::vector<EffectFit> kept;
  for (EffectFit& fit : fits)
  {
    const bool known = std::any_of(kept.begin(), kept.end(),
      [&fit](const EffectFit& other) { return sameCauses(fit.set, other.set); });
    if (!known)
    {
      kept.push_back(std::move(fit));
    }
  }
  fits = std::move(kept);
}

bool hasSecondary(const EffectChoice& choice)
{
  return std::any_of(choice.form->parameters.begin(), choice.form->parameters.end(),
    [](const EffectParameter& parameter) { return parameter.secondary; });
}

// With the secondary parameters of one effect free, where that predicts better.
EffectFit withSecondary(
  const EffectFitter& fitter, EffectFit fit, std::size_t position, int iterations)
{
  if (!hasSecondary(fit.set.choices[position]) || fit.set.secondaryFree[position] != 0)
  {
    return fit;
  }
  EffectSet freed = fit.set;
  freed.secondaryFree[position] = 1;
  EffectFit other = fitter.fit(std::move(freed), iterations);
  return other.energy + FormDeviations * other.dispersion < fit.energy ? other : fit;
}

bool betterForm(const EffectFit& other, const EffectFit& fit, double gapEnergy)
{
  const auto more = static_cast<double>(other.parameters() - fit.parameters());
  return other.energy + FormDeviations * other.dispersion + more * RicherFormPart * gapEnergy <
    fit.energy;
}

// The small errors that every camera has, after the causes: gain, dark and center of each channel, where the
// cross-validation alone asks for them.
EffectFit addSmallErrors(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (const char* name : { "channel_gain", "filter_shift", "dark_offset" })
  {
    const auto small = std::find_if(choices.begin(), choices.end(),
      [name](const EffectChoice& choice)
      {
        return choice.effect->name == name && choice.form->name == "per_channel" &&
          !choice.whiteAfter;
      });
    if (small == choices.end() || fit.set.has(*small))
    {
      continue;
    }
    EffectSet set = fit.set;
    set.add(*small, fitter.data().camera);
    EffectFit other = fitter.fit(std::move(set), Iterations);
    const double gain = fit.energy - other.energy;
    if (gain > ChanceOfMany * other.dispersion && gain > RelevantPart * gapEnergy)
    {
      fit = std::move(other);
    }
  }
  return fit;
}

// A passband that keeps its peak while it widens is brighter, and little else on smooth reflectances: where plain
// exposure does as well, it is that.
EffectFit preferExposure(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  const auto exposure = std::find_if(choices.begin(), choices.end(),
    [](const EffectChoice& choice) { return choice.effect->name == "exposure_gain"; });
  for (std::size_t position = 0; position < fit.set.size(); ++position)
  {
    if (exposure == choices.end() || fit.set.choices[position].form->name != "fixed_peak" ||
      fit.set.has(*exposure))
    {
      continue;
    }
    EffectSet set = fit.set;
    set.remove(position);
    set.add(*exposure, fitter.data().camera);
    EffectFit other = fitter.fit(std::move(set), FinalIterations);
    if (other.energy <=
      fit.energy + std::fmax(SimplerPart * gapEnergy, SimplerDeviations * fit.dispersion))
    {
      fit = std::move(other);
      break;
    }
  }
  return fit;
}

// Gains of single channels also do what exposure and lamp do, and mend the small errors on the way. Where exposure or
// lamp alone do more of it than chance lets them, they are a cause, and the gains are what is left.
EffectFit splitGains(
  const EffectFitter& fitter, EffectFit fit, const std::vector<EffectChoice>& choices)
{
  const auto gains = std::find_if(fit.set.choices.begin(), fit.set.choices.end(),
    [](const EffectChoice& c) { return c.effect->name == "channel_gain" && c.smallError(); });
  if (gains == fit.set.choices.end())
  {
    return fit;
  }
  const EffectChoice gain = *gains;
  EffectSet rest = fit.set;
  rest.remove(static_cast<std::size_t>(gains - fit.set.choices.begin()));
  const EffectFit without = rest.size() > 0 ? fitter.fit(rest, Iterations) : fitter.nominal();
  double least = StructuredChance;
  EffectSet best;
  for (const EffectChoice& choice : choices)
  {
    const bool common =
      choice.effect->name == "exposure_gain" || choice.effect->name == "illuminant_drift";
    if (!common || choice.whiteAfter || rest.has(choice))
    {
      continue;
    }
    EffectSet set = rest;
    set.add(choice, fitter.data().camera);
    const EffectFit special = fitter.fit(set, Iterations);
    const double fraction = (without.energy - special.energy) / (without.energy - fit.energy);
    const double chance =
      chanceOfFraction(fraction, static_cast<int>(special.parameters() - without.parameters()),
        static_cast<int>(fitter.data().channels()));
    if (chance < least)
    {
      least = chance;
      best = special.set;
    }
  }
  if (best.size() == 0)
  {
    return fit;
  }
  best.add(gain, fitter.data().camera);
  return fitter.fit(std::move(best), FinalIterations);
}

// Other forms of the effects in the set, and their secondary parameters.
EffectFit chooseForms(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (std::size_t position = 0; position < fit.set.size(); ++position)
  {
    const EffectChoice mine = fit.set.choices[position];
    EffectSet rest = fit.set;
    rest.remove(position);
    const EffectFit without = rest.size() > 0 ? fitter.fit(rest, 2) : fitter.nominal();
    std::vector<EffectChoice> forms;
    std::copy_if(choices.begin(), choices.end(), std::back_inserter(forms),
      [&mine](const EffectChoice& choice)
      {
        return choice.sameCause(mine) &&
          (choice.form != mine.form || choice.whiteAfter != mine.whiteAfter ||
            choice.leveled != mine.leveled);
      });
    for (const ScreenedEffect& form : screenEffects(fitter, without, forms, 0.0))
    {
      EffectSet set = rest;
      set.add(form.choice, fitter.data().camera, form.start);
      EffectFit other = fitter.fit(std::move(set), Iterations);
      const std::size_t last = other.set.size() - 1;
      other = withSecondary(fitter, std::move(other), last, Iterations);
      if (betterForm(other, fit, gapEnergy))
      {
        // Keep the position: the loop runs over it.
        std::rotate(other.set.choices.begin() + static_cast<std::ptrdiff_t>(position),
          other.set.choices.end() - 1, other.set.choices.end());
        std::rotate(other.set.effects.begin() + static_cast<std::ptrdiff_t>(position),
          other.set.effects.end() - 1, other.set.effects.end());
        std::rotate(other.set.secondaryFree.begin() + static_cast<std::ptrdiff_t>(position),
          other.set.secondaryFree.end() - 1, other.set.secondaryFree.end());
        fit = fitter.fit(other.set, Iterations);
      }
    }
    fit = withSecondary(fitter, std::move(fit), position, Iterations);
  }
  return fit.set.size() > 0 ? fitter.fit(fit.set, FinalIterations) : fit;
}

// An effect in a form that is not quite right leaves a rest that others mend, numbers of single channels above all, and
// they then hide the form that is right. Where the rest of the causes in their best forms do as well for the price, an
// effect goes.
EffectFit withoutMenders(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (std::size_t position = fit.set.size(); fit.set.size() > 1 && position-- > 0;)
  {
    EffectSet rest = fit.set;
    rest.remove(position);
    EffectFit other =
      chooseForms(fitter, fitter.fit(std::move(rest), Iterations), choices, gapEnergy);
    if (cost(fitter, other, gapEnergy, fit.dispersion) <
      cost(fitter, fit, gapEnergy, fit.dispersion))
    {
      fit = std::move(other);
      position = fit.set.size();
    }
  }
  return fit;
}

// Beside numbers of single channels all forms of a cause do equally well. The one is right that does most without them.
EffectFit leadingForms(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  EffectSet leading;
  leading.level = fit.set.level;
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    if (!fit.set.choices[e].smallError())
    {
      leading.add(fit.set, e);
    }
  }
  if (leading.size() == 0 || leading.size() == fit.set.size())
  {
    return fit;
  }
  const EffectFit alone = chooseForms(fitter, fitter.fit(leading, Iterations), choices, gapEnergy);
  EffectSet set;
  std::size_t next = 0;
  for (const EffectChoice& choice : fit.set.choices)
  {
    if (choice.smallError())
    {
      set.add(choice, fitter.data().camera);
    }
    else
    {
      set.add(alone.set, next++);
    }
  }
  set.level = alone.set.level;
  EffectFit other = fitter.fit(std::move(set), FinalIterations);
  const double tolerance = std::fmax(SimplerPart * gapEnergy, SimplerDeviations * fit.dispersion);
  return other.energy <= fit.energy + tolerance ? other : fit;
}
}

double parameterPrice(const EffectFitter& fitter, const EffectFit& fit, double gapEnergy)
{
  const double chance = 0.5 * std::log(std::fmax(fitter.trainingElements(), 2.0)) * fit.dispersion;
  return std::fmax(chance, FormPart * gapEnergy);
}

std::vector<EffectFit> extendFit(const EffectFitter& fitter, const EffectFit& current,
  const std::vector<EffectChoice>& choices, double gapEnergy, int fullFits)
{
  const double price = FormPart * gapEnergy;
  std::vector<EffectFit> fits;
  std::vector<EffectChoice> forms;
  for (const ScreenedEffect& screened : screenEffects(fitter, current, choices, price))
  {
    if (static_cast<int>(fits.size()) >= fullFits || screened.gain <= ChanceOfMany)
    {
      break;
    }
    const auto alike = std::count_if(forms.begin(), forms.end(),
      [&screened](const EffectChoice& form) { return form.sameCause(screened.choice); });
    if (alike >= FormsFitted + (hasSecondary(screened.choice) ? 1 : 0))
    {
      continue;
    }
    forms.push_back(screened.choice);
    EffectSet set = current.set;
    set.add(screened.choice, fitter.data().camera, screened.start);
    EffectFit fit = fitter.fit(std::move(set), Iterations);
    if (std::isfinite(fit.energy))
    {
      fits.push_back(withSecondary(fitter, std::move(fit), current.set.size(), Iterations));
    }
  }
  return fits;
}

SearchResult searchEffects(const EffectFitter& fitter, const std::vector<EffectChoice>& choices,
  const SearchLimits& limits, const std::function<bool()>& stop)
{
  SearchResult result;
  result.best = fitter.nominal();
  result.gapEnergy = std::fmax(result.best.energy - fitter.noiseEnergy(), 0.0);
  const double gapEnergy = result.gapEnergy;
  std::vector<EffectFit> beam{ result.best };
  for (int size = 1; size <= limits.maximumEffects && !stop(); ++size)
  {
    std::vector<EffectFit> grown;
    for (const EffectFit& from : beam)
    {
      if (stop())
      {
        return result;
      }
      std::vector<EffectFit> more = extendFit(fitter, from, choices, gapEnergy, limits.fullFits);
      std::move(more.begin(), more.end(), std::back_inserter(grown));
    }
    if (grown.empty())
    {
      break;
    }
    const auto least = std::min_element(grown.begin(), grown.end(),
      [](const EffectFit& a, const EffectFit& b) { return a.energy < b.energy; });
    const double dispersion = least->dispersion;
    const auto price = [&](const EffectFit& fit)
    { return cost(fitter, fit, gapEnergy, dispersion); };
    keepBestForms(grown, price);
    if (size == 1)
    {
      result.singles = grown;
    }
    const double improvement = result.best.energy - grown.front().energy;
    if (price(grown.front()) < price(result.best) && improvement > ChanceOfMany * dispersion &&
      improvement > RelevantPart * gapEnergy)
    {
      result.best = grown.front();
    }
    else if (size > 1)
    {
      break;
    }
    grown.resize(std::min(grown.size(), static_cast<std::size_t>(limits.width)));
    beam = std::move(grown);
  }
  result.best = withoutMenders(fitter, std::move(result.best), choices, gapEnergy);
  // Backward.
  bool dropped = true;
  while (dropped && result.best.set.size() > 1)
  {
    dropped = false;
    for (std::size_t position = 0; position < result.best.set.size() && !dropped; ++position)
    {
      EffectSet rest = result.best.set;
      rest.remove(position);
      EffectFit without = fitter.fit(std::move(rest), Iterations);
      const double loss = without.energy - result.best.energy;
      if (cost(fitter, without, gapEnergy, result.best.dispersion) <=
          cost(fitter, result.best, gapEnergy, result.best.dispersion) ||
        loss < std::fmax(ChanceOfMany * result.best.dispersion, RelevantPart * gapEnergy))
      {
        result.best = std::move(without);
        dropped = true;
      }
    }
  }
  if (result.best.set.size() > 0)
  {
    result.best = chooseForms(fitter, result.best, choices, gapEnergy);
    result.best = preferExposure(fitter, result.best, choices, gapEnergy);
    if (static_cast<int>(result.best.set.size()) < limits.maximumEffects)
    {
      result.best = splitGains(fitter, result.best, choices);
    }
    result.causes = result.best.set.size();
    if (static_cast<int>(result.causes) < limits.maximumEffects)
    {
      result.best = addSmallErrors(fitter, result.best, choices, gapEnergy);
    }
    result.best = leadingForms(fitter, std::move(result.best), choices, gapEnergy);
  }
  return result;
}

} // namespace msi
