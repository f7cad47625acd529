#include "Kernels/Gap/EffectForms.h"

#include "Kernels/Gap/EffectScreen.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{

bool betterForm(const EffectFit& other, const EffectFit& fit, double gapEnergy)
{
  const auto more = static_cast<double>(other.parameters() - fit.parameters());
  return other.energy + TableDecision::FormDeviations * other.dispersion +
    more * TableDecision::RicherFormPart * gapEnergy <
    fit.energy;
}

// Little worse: a simpler cause is taken for it.
bool nearlyAsGood(const EffectFit& other, const EffectFit& fit, double gapEnergy)
{
  return other.energy <= fit.energy +
    std::fmax(
      TableDecision::SimplerPart * gapEnergy, TableDecision::SimplerDeviations * fit.dispersion);
}
}

bool hasSecondary(const EffectChoice& choice)
{
  return std::any_of(choice.form->parameters.begin(), choice.form->parameters.end(),
    [](const EffectParameter& parameter) { return parameter.secondary && !parameter.given; });
}

EffectFit withSecondary(
  const EffectFitter& fitter, EffectFit fit, std::size_t position, const FitEffort& effort)
{
  if (!hasSecondary(fit.set.choices[position]) || fit.set.secondaryFree[position] != 0)
  {
    return fit;
  }
  EffectSet freed = fit.set;
  freed.secondaryFree[position] = 1;
  EffectFit other =
    fitter.fit(std::move(freed), effort.unwantedAbove(std::fmin(effort.unwanted, fit.energy)));
  return other.energy + TableDecision::FormDeviations * other.dispersion < fit.energy ? other : fit;
}

EffectFit chooseForms(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  for (std::size_t position = 0; position < fit.set.size(); ++position)
  {
    const EffectChoice mine = fit.set.choices[position];
    EffectSet rest = fit.set;
    rest.remove(position);
    const EffectFit without = fitter.fit(rest, RoughFit);
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
      const FitEffort better = SearchFit.unwantedAbove(fit.energy);
      // What a secondary parameter may still mend is not known yet.
      EffectFit other = fitter.fit(std::move(set), hasSecondary(form.choice) ? SearchFit : better);
      const std::size_t last = other.set.size() - 1;
      other = withSecondary(fitter, std::move(other), last, better);
      if (betterForm(other, fit, gapEnergy))
      {
        // Keep the position: the loop runs over it.
        other.set.moveLastTo(position);
        fit = fitter.fit(other.set, SearchFit);
      }
    }
    fit = withSecondary(fitter, std::move(fit), position, SearchFit);
  }
  return fitter.fit(fit.set, FinalFit);
}

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
  const EffectFit alone = chooseForms(fitter, fitter.fit(leading, SearchFit), choices, gapEnergy);
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
  EffectFit other = fitter.fit(std::move(set), FinalFit);
  return nearlyAsGood(other, fit, gapEnergy) ? other : fit;
}

EffectFit preferExposure(const EffectFitter& fitter, EffectFit fit,
  const std::vector<EffectChoice>& choices, double gapEnergy)
{
  const auto exposure = std::find_if(choices.begin(), choices.end(),
    [](const EffectChoice& choice) { return choice.effect->has(EffectTrait::CommonGain); });
  for (std::size_t position = 0; position < fit.set.size(); ++position)
  {
    const EffectChoice& mine = fit.set.choices[position];
    const bool unbalanced = mine.form->has(FormTrait::Brightens) && !mine.whiteAfter;
    const bool exposed = exposure != choices.end() && fit.set.has(*exposure);
    if (exposure == choices.end() || !(unbalanced || (mine.leveled && !exposed)))
    {
      continue;
    }
    EffectSet set = fit.set;
    if (exposed)
    {
      set.choices[position].whiteAfter = true;
    }
    else
    {
      set.remove(position);
      set.add(*exposure, fitter.data().camera);
    }
    EffectFit other = fitter.fit(std::move(set), FinalFit);
    if (nearlyAsGood(other, fit, gapEnergy))
    {
      fit = std::move(other);
      break;
    }
  }
  return fit;
}

} // namespace msi
