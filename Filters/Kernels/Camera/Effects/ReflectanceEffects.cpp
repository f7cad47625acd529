// What one medium does to its light on the way from the spectrophotometer's geometry to the camera's.
#include "Kernels/Camera/Effects/EffectEntry.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double ReferenceWavelength = 550.0;

// Calls Derived::change(column) for the columns of one medium.
template <typename Derived>
class MediumOperator : public BlockOperatorOf<Derived>
{
public:
  explicit MediumOperator(const BoundEffect& effect)
    : Medium(effect.medium())
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> reflectance, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < reflectance.cols(); ++j)
    {
      if (columns.medium[j] == Medium)
      {
        static_cast<const Derived*>(this)->template change<Scalar>(reflectance.col(j).array());
      }
    }
  }

private:
  int Medium;
};

class SpecularComponent : public MediumOperator<SpecularComponent>
{
public:
  explicit SpecularComponent(const BoundEffect& effect)
    : MediumOperator(effect)
    , Pedestal(effect.value("pedestal"))
    , Scale(effect.form().name == "body" ? 1.0 - Pedestal : 1.0)
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r = static_cast<Scalar>(Scale) * r + static_cast<Scalar>(Pedestal);
  }

private:
  double Pedestal;
  double Scale;
};

class Translucency : public MediumOperator<Translucency>
{
public:
  explicit Translucency(const BoundEffect& effect)
    : MediumOperator(effect)
    , Loss(effect.value("loss") *
        (effect.camera().wavelengths().vector().array() / ReferenceWavelength)
          .pow(effect.value("exponent")))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r = r / (Scalar(1) + Loss.as<Scalar>() * r);
  }

private:
  ChannelValues Loss;
};

class Interreflection : public MediumOperator<Interreflection>
{
public:
  explicit Interreflection(const BoundEffect& effect)
    : MediumOperator(effect)
    , Probability(effect.value("probability"))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    const auto p = static_cast<Scalar>(Probability);
    r = (Scalar(1) - p) * r / (Scalar(1) - p * r);
  }

private:
  double Probability;
};

class Fluorescence : public MediumOperator<Fluorescence>
{
public:
  explicit Fluorescence(const BoundEffect& effect)
    : MediumOperator(effect)
    , Offset(effect.form().name == "uncoloured" || effect.form().name == "absorbed" ? 1.0 : 0.0)
    , Slope(effect.form().name == "uncoloured" ? 0.0
          : effect.form().name == "absorbed"   ? -1.0
                                               : 1.0)
  {
    const Eigen::ArrayXd distance =
      (effect.camera().wavelengths().vector().array() - effect.value("peak")) /
      effect.value("width");
    Emission = ChannelValues(effect.value("yield") * (-0.5 * distance.square()).exp());
    const WavelengthGrid& grid = effect.camera().wavelengths();
    ExcitedBands = 1;
    while (ExcitedBands < grid.size() && grid[ExcitedBands] <= LongestExcitation)
    {
      ++ExcitedBands;
    }
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    // A plain loop: the order of the sum must not depend on the column's alignment.
    Scalar sum = 0;
    for (Eigen::Index j = 0; j < ExcitedBands; ++j)
    {
      sum += r[j];
    }
    const Scalar excitation = static_cast<Scalar>(Offset) +
      static_cast<Scalar>(Slope) * sum / static_cast<Scalar>(ExcitedBands);
    r += Emission.as<Scalar>() * excitation;
  }

private:
  static constexpr double LongestExcitation = 420.0;
  double Offset;
  double Slope;
  ChannelValues Emission;
  Eigen::Index ExcitedBands;
};

class MediumGain : public MediumOperator<MediumGain>
{
public:
  explicit MediumGain(const BoundEffect& effect)
    : MediumOperator(effect)
    , Gain(effect.value("gain"))
  {
  }
  template <typename Scalar, typename Column>
  void change(Column r) const noexcept
  {
    r *= static_cast<Scalar>(Gain);
  }

private:
  double Gain;
};
}

std::vector<EffectEntry> reflectanceEffects()
{
  const EffectParameter pedestal{ "pedestal", "1", 0.0, -0.2, 0.2, 0.01,
    "specular reflection that the camera sees beyond the spectrophotometer" };
  const std::vector<EffectParameter> emission = { { "yield", "1", 0.0, -0.5, 1.0, 0.02,
                                                    "emission at its peak for full excitation" },
    { "peak", "nm", 440.0, 420.0, 480.0, 10.0, "wavelength of the strongest emission", false,
      true },
    { "width", "nm", 18.0, 8.0, 40.0, 5.0, "standard deviation of the emission", false, true } };
  return {
    { { "specular_component", "Specular component",
        "Surface reflection that only one of the two instruments collects.",
        EffectStage::Reflectance, EffectNeed::Medium,
        { { "pedestal", "r + pedestal", { pedestal } },
          { "body",
            "(1 - pedestal) r + pedestal: what the surface reflects does not reach the body",
            { pedestal } } } },
      nullptr, makeBlockOperator<SpecularComponent> },
    { { "translucency", "Translucency",
        "Light spreads sideways in the medium and leaves outside the measured spot: more of it the "
        "less "
        "is absorbed and the longer the wavelength.",
        EffectStage::Reflectance, EffectNeed::Medium,
        { { "power", "r / (1 + loss (wavelength / 550 nm)^exponent r)",
          { { "loss", "1", 0.0, -0.4, 2.0, 0.05, "loss at 550 nm for a reflectance of one" },
            { "exponent", "1", 2.0, 1.0, 10.0, 1.0, "growth with the wavelength", false,
              true } } } } },
      nullptr, makeBlockOperator<Translucency> },
    { { "fluorescence", "Fluorescence",
        "A brightener in the medium turns light below 420 nm into light around 440 nm.",
        EffectStage::Reflectance, EffectNeed::Medium,
        { { "through_colorant",
            "r + yield E r_x; r_x is the mean reflectance up to 420 nm, the part that reaches the "
            "brightener",
            emission },
          { "uncoloured", "r + yield E", emission },
          { "absorbed", "r + yield E (1 - r_x)", emission } } },
      nullptr, makeBlockOperator<Fluorescence> },
    { { "interreflection", "Interreflection",
        "A share p of the light that leaves a point of the surface strikes the surface again.",
        EffectStage::Reflectance, EffectNeed::Medium,
        { { "cavity", "r (1 - p) / (1 - p r)",
          { { "probability", "1", 0.0, -0.8, 0.9, 0.05,
            "probability of a further reflection; negative where the spectrophotometer saw more of "
            "them" } } } } },
      nullptr, makeBlockOperator<Interreflection> },
    { { "medium_gain", "Gain of one medium",
        "The camera's geometry sees less light from this medium than the spectrophotometer's.",
        EffectStage::Reflectance, EffectNeed::Medium,
        { { "gain", "gain r",
          { { "gain", "1", 1.0, 0.3, 2.0, 0.05, "factor on the reflectance" } } } } },
      nullptr, makeBlockOperator<MediumGain> },
  };
}

} // namespace msi
