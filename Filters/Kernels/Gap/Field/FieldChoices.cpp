#include "Kernels/Gap/Field/FieldFit.h"

#include <algorithm>
#include <stdexcept>

namespace msi
{

namespace
{
// What a profile counts for beside its strength. Its lines are no parameters: blocks that took no part in it judge it.
constexpr Eigen::Index ProfileParameters = 3;
}

std::vector<FieldChoice> fieldChoices(const std::vector<std::string>& without)
{
  using P = FieldParameter;
  const FieldTerm glare{ P::Glare, false, 0.0, 0.5, 0.01 };
  const FieldTerm right{ P::Right, true, -20.0, 20.0, 0.5 };
  const FieldTerm down{ P::Down, true, -20.0, 20.0, 0.5 };
  const FieldTerm magnification{ P::Magnification, true, -0.02, 0.02, 0.001 };
  const FieldTerm rotation{ P::Rotation, true, -5.0, 5.0, 0.1 };
  const FieldTerm falloff{ P::Falloff, false, -0.45, 0.45, 0.03 };
  const FieldTerm steep{ P::Falloff, false, -1.5, 1.5, 0.03 }; // beside higher orders
  const FieldTerm fourth{ P::Fourth, false, -1.5, 1.5, 0.03 };
  const FieldTerm sixth{ P::Sixth, false, -1.5, 1.5, 0.03 };
  const FieldTerm centerX{ P::CenterX, false, -1.0, 1.0, 0.1 };
  const FieldTerm centerY{ P::CenterY, false, -1.0, 1.0, 0.1 };
  const FieldTerm slopeRight{ P::GradientRight, false, -0.5, 0.5, 0.03 };
  const FieldTerm slopeDown{ P::GradientDown, false, -0.5, 0.5, 0.03 };
  std::vector<FieldTerm> surround;
  surround.reserve(FreePasses);
  for (int i = 0; i < FreePasses; ++i)
  {
    surround.push_back({ surroundWeight(i), false, -0.05, 0.6, 0.01 });
  }
  const FieldTerm blur{ P::BlurVariance, false, 0.0, 16.0, 0.25 };
  const auto perChannel = [](FieldTerm term)
  {
    term.perChannel = true;
    return term;
  };
  std::vector<FieldChoice> all = {
    { "exposure_gain", "common", { { P::Gain, false, 0.2, 5.0, 0.03 } } },
    { "channel_gain", "per_channel", { { P::Gain, true, 0.2, 5.0, 0.03 } } },
    { "dark_offset", "common", { { P::Dark, false, -0.2, 0.2, 0.005 } } },
    { "dark_offset", "per_channel", { { P::Dark, true, -0.2, 0.2, 0.005 } } },
    { "veiling_glare", "common", { glare } },
    { "veiling_glare", "conserving", { { P::ConservingGlare, false, 0.0, 0.5, 0.01 } } },
    { "veiling_glare", "per_channel", { perChannel(glare) } },
    { "local_stray_light", "neighbours",
      { { P::TailFraction, false, -0.1, 0.6, 0.01 }, { P::TailRadius, false, 1.0, 64.0, 4.0 } } },
    // Any shape; the effect's own form is fitted to it where it is put back.
    { "local_stray_light", "free", surround },
    { "vignetting", "quadratic", { falloff } },
    { "vignetting", "quadratic", { falloff, centerX, centerY } },
    { "vignetting", "polynomial", { steep, fourth, sixth } },
    { "vignetting", "polynomial", { steep, fourth, sixth, centerX, centerY } },
    { "illumination_gradient", "plane", { slopeRight, slopeDown } },
    { "illumination_gradient", "bent",
      { slopeRight, slopeDown, { P::GradientBend, false, -0.3, 0.3, 0.03 } } },
    { "misregistration", "per_channel", { right, down } },
    { "misregistration", "per_channel", { right, down, magnification } },
    { "misregistration", "per_channel", { right, down, magnification, rotation } },
    { "defocus", "common", { blur } },
    { "defocus", "per_channel", { perChannel(blur) } },
    { "banding", "rows",
      { { P::RowSine, true, -0.3, 0.3, 0.01 }, { P::RowCosine, true, -0.3, 0.3, 0.01 } } },
    { "banding", "columns",
      { { P::ColumnSine, true, -0.3, 0.3, 0.01 }, { P::ColumnCosine, true, -0.3, 0.3, 0.01 } } },
    // A profile of any shape; three sines come nearest to it where it is put back.
    { "banding", "row_harmonics", { { P::RowGain, true, 0.0, 2.0, 0.3 } } },
    { "banding", "column_harmonics", { { P::ColumnGain, true, 0.0, 2.0, 0.3 } } },
    { "banding", "row_offsets", { { P::RowOffset, true, 0.0, 2.0, 0.3 } } },
    { "banding", "column_offsets", { { P::ColumnOffset, true, 0.0, 2.0, 0.3 } } },
    { "detector_nonlinearity", "quadratic", { { P::Square, false, -0.45, 0.9, 0.05 } } },
    { "detector_nonlinearity", "gamma", { { P::Exponent, false, 0.4, 2.5, 0.05 } } },
    { "detector_nonlinearity", "compressive", { { P::Compression, false, -0.4, 2.0, 0.05 } } },
    { "saturation", "soft",
      { { P::Clip, false, 0.0, 1.0, 0.3 }, { P::ClipLevel, false, 0.1, 8.0, 0.1 } } },
    { "lag", "common", { { P::Retained, false, 0.0, 0.3, 0.01 } } },
  };
  for (const std::string& name : without)
  {
    if (findEffect(name) == nullptr)
    {
      throw std::invalid_argument("there is no effect '" + name + "' to leave out");
    }
    all.erase(std::remove_if(all.begin(), all.end(),
                [&name](const FieldChoice& choice) { return choice.effect == name; }),
      all.end());
  }
  return all;
}

bool isProfile(const FieldChoice& choice)
{
  const FieldParameter first = choice.terms.front().parameter;
  return first == FieldParameter::RowGain || first == FieldParameter::RowOffset ||
    first == FieldParameter::ColumnGain || first == FieldParameter::ColumnOffset;
}

bool isOfRows(const FieldChoice& choice)
{
  return choice.form.rfind("row", 0) == 0;
}

bool compatible(const FieldSet& set, const FieldChoice& choice)
{
  for (const FieldChoice* other : set)
  {
    const bool bothBands = other->effect == "banding" && choice.effect == "banding" &&
      isOfRows(*other) != isOfRows(choice);
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
    for (const FieldTerm& term : choice->terms)
    {
      count += term.perChannel ? channels : 1;
    }
    count += choice->effect == "banding" ? 1 : 0; // the period
    count += isProfile(*choice) ? ProfileParameters * channels : 0;
  }
  return count;
}

} // namespace msi
