#include "Kernels/Gap/EffectExtension.h"

#include "Kernels/Gap/EffectCost.h"
#include "Kernels/Gap/EffectForms.h"
#include "Kernels/Gap/TableDecisions.h"

#include <algorithm>
#include <cmath>

namespace msi
{

std::vector<EffectFit> extendFit(const EffectFitter& fitter, const EffectFit& current,
  const std::vector<ScreenedEffect>& screened, int fullFits)
{
  std::vector<EffectFit> fits;
  std::vector<EffectChoice> forms;
  for (const ScreenedEffect& effect : screened)
  {
    if (static_cast<int>(fits.size()) >= fullFits || effect.gain <= TableDecision::ChanceOfMany)
    {
      break;
    }
    const auto alike = std::count_if(forms.begin(), forms.end(),
      [&effect](const EffectChoice& form) { return form.sameCause(effect.choice); });
    if (alike >= TableDecision::FormsFitted + (hasSecondary(effect.choice) ? 1 : 0))
    {
      continue;
    }
    forms.push_back(effect.choice);
    EffectSet set = current.set;
    set.add(effect.choice, fitter.data().camera, effect.start);
    EffectFit fit = fitter.fit(std::move(set), SearchFit);
    if (std::isfinite(fit.energy))
    {
      fits.push_back(withSecondary(fitter, std::move(fit), current.set.size(), SearchFit));
    }
  }
  return fits;
}

} // namespace msi
