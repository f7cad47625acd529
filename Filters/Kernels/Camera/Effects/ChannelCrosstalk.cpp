// A part of the neighbouring channels' signal.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
// u_k + before_k (u_k-1 - u_k) + after_k (u_k+1 - u_k) + all (mean - u_k); at the ends the neighbour that is missing gives nothing.
class ChannelCrosstalk
{
public:
  explicit ChannelCrosstalk(const BoundEffect& effect)
    : Before(share(effect, "from_previous"))
    , After(share(effect, "from_next"))
    , OfAll(effect.form().name == "shared" ? effect.value("coupling") : 0.0)
  {
  }
  template <typename Scalar>
  void operator()(Block<Scalar> signal, const ColumnContext&) const noexcept
  {
    const auto& before = Before.as<Scalar>();
    const auto& after = After.as<Scalar>();
    const auto all = static_cast<Scalar>(OfAll);
    const Eigen::Index last = signal.rows() - 1;
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      const Scalar mean = OfAll != 0.0 ? signal.col(j).mean() : Scalar(0);
      Scalar previous = signal(0, j);
      for (Eigen::Index k = 0; k <= last; ++k)
      {
        const Scalar self = signal(k, j);
        Scalar change = before[k] * (previous - self) + all * (mean - self);
        if (k < last)
        {
          change += after[k] * (signal(k + 1, j) - self);
        }
        signal(k, j) = self + change;
        previous = self;
      }
    }
  }

private:
  static ChannelValues share(const BoundEffect& effect, const char* side)
  {
    const Eigen::Index channels = effect.camera().channelCount();
    const Eigen::ArrayXd all = Eigen::ArrayXd::Ones(channels);
    if (effect.form().name == "shared")
    {
      return ChannelValues(Eigen::ArrayXd::Zero(channels));
    }
    if (effect.form().name == "one_sided")
    {
      return ChannelValues(effect.value(side) * all);
    }
    const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(channels, -1.0, 1.0);
    return ChannelValues(effect.value("coupling") * (all + effect.value("growth") * place));
  }
  ChannelValues Before;
  ChannelValues After;
  double OfAll;
};

// Its step on image pairs.
double crosstalkStep(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
{
  const double before = pixel.previous != nullptr ? *pixel.previous - pixel.self : 0.0;
  const double behind = pixel.next != nullptr ? *pixel.next - pixel.self : 0.0;
  const double all = pixel.ofAll - pixel.self;
  if (by != nullptr)
  {
    by[0] = before;
    by[1] = behind;
    by[2] = all;
  }
  signal += numbers[0] * before + numbers[1] * behind + numbers[2] * all;
  return 1.0; // what changes the light here changes that of the neighbours much alike
}
}

Effect channelCrosstalk()
{
  const auto share = [](const char* name, double least, const char* meaning) {
    return EffectParameter{ name, "1", 0.0, least, 0.45, 0.01, meaning };
  };
  const EffectParameter previous =
    share("from_previous", 0.0, "share taken over from the channel before");
  const EffectParameter next = share("from_next", 0.0, "share taken over from the channel behind");
  const EffectParameter all = share("coupling", -0.2, "share of what all channels have in common");
  Effect effect;
  effect.definition = { "channel_crosstalk", "Channel crosstalk",
    "A part of the neighbouring channels' signal: charge, lag between exposures, a mosaic's "
    "leak.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "symmetric",
        "u_k + c_k (u_k-1 - u_k) + c_k (u_k+1 - u_k), c_k = coupling (1 + growth x), x = -1..1 "
        "from the first channel to the last",
        { share("coupling", -0.2, "share exchanged with each neighbour"),
          { "growth", "1", 0.0, -1.0, 1.0, 0.3, "relative growth of the coupling over the channels",
            false, true } } },
      { "one_sided", "u_k + from_previous (u_k-1 - u_k) + from_next (u_k+1 - u_k)",
        { previous, next } },
      { "shared",
        "u_k + coupling (mean of all channels - u_k): what filters let pass beside their bands, "
        "as far as images tell it",
        { all }, {}, FormTrait::OfImages } },
    Captures::NarrowBands, EffectTrait::CouplesChannels,
    { { "one_sided", { imageTerm(0, previous), imageTerm(1, next) } },
      { "shared", { imageTerm(2, all) } } } };
  effect.makeBlock = makeBlockOperator<ChannelCrosstalk>;
  static const ImageStep step{ ImageStage::Exposure, { {}, {}, {} }, crosstalkStep };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
