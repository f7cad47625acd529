#include "Kernels/Gap/Field/FieldFit.h"

#include "Kernels/Gap/ReportParts.h"

#include <algorithm>

namespace msi
{

namespace
{
// What a profile counts for beside its strength. Its lines are no parameters: blocks that took no part in it judge it.
constexpr Eigen::Index ProfileParameters = 3;
}

std::vector<FieldChoice> fieldChoices(const std::vector<std::string>& without)
{
  requireKnown(without);
  std::vector<FieldChoice> choices;
  for (const EffectDefinition& effect : effectLibrary())
  {
    for (const ImageForm& form : effect.imageForms)
    {
      if (std::find(without.begin(), without.end(), effect.name) == without.end())
      {
        choices.push_back({ &effect, form.form, form.terms });
      }
    }
  }
  // Of effects that do as well the exact ones come first.
  std::stable_partition(choices.begin(), choices.end(),
    [](const FieldChoice& choice) { return choice.has(EffectTrait::Exact); });
  return choices;
}

bool FieldChoice::has(ImageParameter parameter) const noexcept
{
  return std::any_of(terms.begin(), terms.end(),
    [parameter](const ImageTerm& term) { return term.parameter == parameter; });
}

bool isBanding(const FieldChoice& choice)
{
  const ImageParameter first = choice.terms.front().parameter;
  return first >= ImageParameter::RowSine && first <= ImageParameter::ColumnOffset;
}

bool isProfile(const FieldChoice& choice)
{
  return choice.terms.front().parameter >= ImageParameter::RowGain && isBanding(choice);
}

bool isOfRows(const FieldChoice& choice)
{
  return choice.form.rfind("row", 0) == 0;
}

bool compatible(const FieldSet& set, const FieldChoice& choice)
{
  for (const FieldChoice* other : set)
  {
    const bool bothBands =
      isBanding(*other) && isBanding(choice) && isOfRows(*other) != isOfRows(choice);
    if (other == &choice || (other->effect == choice.effect && !bothBands) ||
      other->terms.front().parameter == choice.terms.front().parameter)
    {
      return false;
    }
  }
  return true;
}

Eigen::Index parameterCount(const FieldSet& set, Eigen::Index channels)
{
  Eigen::Index count = 0;
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      count += term.perChannel ? channels : 1;
    }
    count += isBanding(*choice) ? 1 : 0; // the period
    count += isProfile(*choice) ? ProfileParameters * channels : 0;
  }
  return count;
}

} // namespace msi
