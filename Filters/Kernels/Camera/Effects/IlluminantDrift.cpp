// A lamp whose spectrum is not the one of the model.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/Passbands.h"
#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Spectra/Interpolation.h"

#include <Eigen/SVD>

#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

namespace msi
{

namespace
{
constexpr Eigen::Index LampShapes = 6;
constexpr double DarkestPart = 0.01; // of a lamp's mean power; what is darker shapes no lamp
constexpr double LampStep = 5.0;     // nm
constexpr double GainSize =
  0.03; // typical, as of channel_gain, from which few channels cannot tell a lamp

const WavelengthGrid& lampGrid()
{
  static const WavelengthGrid grid = WavelengthGrid::uniform(380.0, 780.0, LampStep);
  return grid;
}

// The principal directions in which the logarithms of these lamps' spectra, in steps of 10 nm, differ from 400 to 700 nm: one a
// row, over lampGrid(). Times the square root of 2, as two lamps differ.
Eigen::MatrixXd makeLampShapes()
{
  static const char* const names[] = { "BB2500K", "BB3400K", "D50", "D65", "D100", "FL1", "FL2",
    "FL3", "FL4", "FL5", "FL6", "FL7", "FL8", "FL9", "FL10", "FL11", "FL12", "LED-B1", "LED-B2",
    "LED-B3", "LED-B4", "LED-B5", "LED-BH1", "LED-RGB1", "LED-V1", "LED-V2" };
  const Eigen::Index size = lampGrid().size();
  const auto first =
    static_cast<Eigen::Index>(std::lround((400.0 - lampGrid().front()) / LampStep));
  const auto seen = static_cast<Eigen::Index>(std::lround((700.0 - 400.0) / LampStep)) + 1;
  Eigen::MatrixXd spectra(static_cast<Eigen::Index>(std::size(names)), size);
  for (Eigen::Index lamp = 0; lamp < spectra.rows(); ++lamp)
  {
    const Eigen::ArrayXd power = Illuminant::named(names[lamp]).powerAt(lampGrid());
    Eigen::ArrayXd smooth = power;
    smooth.segment(1, size - 2) =
      0.25 * power.head(size - 2) + 0.5 * power.segment(1, size - 2) + 0.25 * power.tail(size - 2);
    const Eigen::ArrayXd logarithm =
      (smooth / smooth.segment(first, seen).mean()).max(DarkestPart).log();
    spectra.row(lamp) = logarithm - logarithm.segment(first, seen).mean();
  }
  spectra.rowwise() -= spectra.colwise().mean().eval();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(spectra.middleCols(first, seen), Eigen::ComputeThinU);
  Eigen::MatrixXd shapes = std::sqrt(2.0 / static_cast<double>(spectra.rows() - 1)) *
    svd.matrixU().leftCols(LampShapes).transpose() * spectra;
  for (Eigen::Index shape = 0; shape < LampShapes; ++shape)
  {
    Eigen::Index largest = 0;
    shapes.row(shape).cwiseAbs().maxCoeff(&largest);
    shapes.row(shape) *= shapes(shape, largest) > 0.0 ? 1.0 : -1.0;
  }
  return shapes;
}

std::string nameOfShape(Eigen::Index shape)
{
  return "shape_" + std::to_string(shape + 1);
}

// The other lamp over the model's; beyond the tables as at their ends.
Eigen::ArrayXd anotherLamp(const BoundEffect& effect)
{
  static const Eigen::MatrixXd shapes = makeLampShapes();
  Eigen::VectorXd logarithm = Eigen::VectorXd::Zero(shapes.cols());
  for (Eigen::Index shape = 0; shape < LampShapes; ++shape)
  {
    logarithm += effect.value(nameOfShape(shape)) * shapes.row(shape).transpose();
  }
  const Eigen::MatrixXd onGrid =
    resamplingMatrix(lampGrid(), effect.camera().wavelengths(), InterpolationMethod::Linear);
  return (onGrid * logarithm).array().exp();
}

// Its step on image pairs.
struct LampOfImage
{
  static double shine(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    const double x = pixel.channel;
    const std::array<double, 4> legendre{ x, 1.0, 1.5 * x * x - 0.5, (2.5 * x * x - 1.5) * x };
    const double factor =
      std::exp(std::inner_product(legendre.begin(), legendre.end(), numbers, 0.0));
    signal *= factor;
    for (std::size_t n = 0; n < legendre.size() && by != nullptr; ++n)
    {
      by[n] = signal * legendre[n];
    }
    return factor;
  }
};

class IlluminantDrift : public ResponsivityOperator
{
public:
  explicit IlluminantDrift(const BoundEffect& effect)
  {
    const Eigen::ArrayXd x = gridPosition(effect.camera().wavelengths());
    if (effect.form().name == "band")
    {
      const Eigen::ArrayXd z =
        (effect.camera().wavelengths().vector().array() - effect.value("center")) /
        effect.value("width");
      Factor = 1.0 + effect.value("change") * (-0.5 * z.square()).exp();
      return;
    }
    if (effect.form().name == "another_lamp")
    {
      Factor = anotherLamp(effect);
      return;
    }
    if (effect.form().name == "tilt")
    {
      Factor = (effect.value("tilt") * x).exp();
      return;
    }
    const double tilt = effect.value("tilt");
    const double curvature = effect.value("curvature");
    const double twist = effect.value("twist");
    OverChannels = effect.form().name == "over_channels";
    if (!OverChannels)
    {
      Factor = legendre(x, tilt, curvature, twist).exp();
      return;
    }
    const double numbers[] = { tilt, effect.value("level"), curvature, twist };
    Factor.setOnes(effect.camera().channelCount());
    for (Eigen::Index k = 0; k < Factor.size(); ++k)
    {
      ImagePixel pixel;
      pixel.channel = channelPlace(k, Factor.size());
      LampOfImage::shine(numbers, pixel, Factor[k], nullptr);
    }
  }
  void apply(Eigen::MatrixXd& responsivity) const override
  {
    if (OverChannels)
    {
      responsivity.array().colwise() *= Factor;
      return;
    }
    responsivity.array().rowwise() *= Factor.transpose();
  }

private:
  Eigen::ArrayXd Factor;
  bool OverChannels = false; // and not over the wavelengths
};
}

Effect illuminantDrift()
{
  const EffectParameter tilt{ "tilt", "1", 0.0, -2.0, 2.0, 0.1,
    "natural logarithm of the change at the long end; minus that at the short end" };
  const EffectParameter curvature{ "curvature", "1", 0.0, -2.0, 2.0, 0.1, "weight of P2" };
  const EffectParameter twist{ "twist", "1", 0.0, -2.0, 2.0, 0.1, "weight of P3" };
  const EffectParameter level{ "level", "1", 0.0, -1.5, 1.5, 0.1,
    "natural logarithm of the change of all channels" };
  std::vector<EffectParameter> shapes;
  for (Eigen::Index shape = 0; shape < LampShapes; ++shape)
  {
    shapes.push_back(
      { nameOfShape(shape), "1", 0.0, -5.0, 5.0, 1.0, "weight of B_" + std::to_string(shape + 1) });
  }
  Effect effect;
  effect.definition = { "illuminant_drift", "Illuminant drift",
    "The lamp's spectrum is not the one of the model: aged, another voltage, another lamp.",
    EffectStage::Responsivity, EffectNeed::Nothing,
    { { "tilt", "M exp(tilt x), x = -1..1 over the grid", { tilt } },
      { "smooth", "M exp(tilt P1(x) + curvature P2(x) + twist P3(x)), Legendre polynomials",
        { tilt, curvature, twist } },
      { "band", "M (1 + change exp(-(wavelength - center)^2 / (2 width^2)))",
        { { "change", "1", 0.0, -0.9, 3.0, 0.1, "change of the lamp at the band's middle" },
          { "center", "nm", 560.0, 300.0, 1100.0, 60.0, "middle of the band", false, true },
          { "width", "nm", 50.0, 25.0, 150.0, 15.0, "standard deviation of the band", false,
            true } },
        { { 0.05, 440.0, 30.0 }, { 0.05, 500.0, 40.0 }, { 0.05, 560.0, 50.0 },
          { 0.05, 620.0, 40.0 }, { 0.05, 680.0, 40.0 } } },
      { "another_lamp",
        "M exp(sum of shape_i B_i(wavelength)), B_i the principal directions in which the "
        "logarithms of standard lamps differ (blackbodies, daylight, FL1..FL12 and the LED lamps "
        "of CIE 15:2018), as large as two of them differ on average",
        shapes },
      { "over_channels",
        "M_k exp(tilt P1(x) + level + curvature P2(x) + twist P3(x)), x = -1..1 over the channels: "
        "all that images tell of a lamp",
        { tilt, level, curvature, twist }, {}, FormTrait::OfImages } },
    Captures::LampSpectrum, EffectTrait::SpectralGain };
  const EffectForm& ofImages = effect.definition.forms.back();
  for (const std::size_t count : { 1, 3, 4 })
  {
    ImageForm form{ ofImages.name, {} };
    form.brightens = count > 1; // the level is the second
    for (std::size_t number = 0; number < count; ++number)
    {
      form.terms.push_back(imageTerm(number, ofImages.parameters[number]));
      form.terms.back().typical = GainSize;
    }
    effect.definition.imageForms.push_back(form);
  }
  effect.makeResponsivity = makeResponsivityOperator<IlluminantDrift>;
  static const ImageStep step{ ImageStage::Detector, { {}, {}, {}, {} }, LampOfImage::shine };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
