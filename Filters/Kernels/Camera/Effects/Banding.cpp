// Stripes of rows or columns.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Numerics/Angle.h"

#include <cmath>
#include <string>
#include <vector>

namespace msi
{

namespace
{
// s_k = sum over n of amplitude_n,k sin(2 pi (n position / period + start_n,k)): u_k (1 + s_k), or u_k + s_k
class Banding
{
public:
  explicit Banding(const BoundEffect& effect)
    : AlongRows(effect.form().name.rfind("column", 0) != 0)
    , Offset(effect.form().name == "row_offsets" || effect.form().name == "column_offsets")
    , Period(effect.value("period"))
    , Amplitude{ effect.perChannel("amplitude") }
  {
    if (effect.form().name == "sine")
    {
      Start = { effect.value("phase") *
        Eigen::ArrayXd::LinSpaced(
          Amplitude[0].size(), 0.0, static_cast<double>(Amplitude[0].size() - 1)) };
      return;
    }
    Start = { effect.perChannel("start") };
    if (effect.form().name != "rows" && effect.form().name != "columns")
    {
      for (const char* harmonic : { "_2", "_3" })
      {
        Amplitude.push_back(effect.perChannel(std::string("amplitude") + harmonic));
        Start.push_back(effect.perChannel(std::string("start") + harmonic));
      }
    }
  }
  void operator()(Eigen::Map<Eigen::MatrixXf> block, int x, int y) const
  {
    Eigen::ArrayXf change = changes(AlongRows ? y : x);
    for (Eigen::Index j = 0; j < block.cols(); ++j)
    {
      if (!AlongRows && j > 0)
      {
        change = changes(x + static_cast<int>(j));
      }
      if (Offset)
      {
        block.col(j).array() += change;
      }
      else
      {
        block.col(j).array() *= change;
      }
    }
  }

private:
  // Factors, or what is added.
  Eigen::ArrayXf changes(int place) const
  {
    Eigen::ArrayXf changes(Amplitude[0].size());
    for (Eigen::Index k = 0; k < changes.size(); ++k)
    {
      double sum = Offset ? 0.0 : 1.0;
      for (std::size_t n = 0; n < Amplitude.size(); ++n)
      {
        const double cycles = static_cast<double>(n + 1) * place / Period + Start[n][k];
        sum += Amplitude[n][k] * std::sin(TwoPi * cycles);
      }
      changes[k] = static_cast<float>(sum);
    }
    return changes;
  }

  bool AlongRows;
  bool Offset;
  double Period;
  std::vector<Eigen::ArrayXd> Amplitude; // of each harmonic
  std::vector<Eigen::ArrayXd> Start;
};

// Its step on image pairs.
struct StripesOfImage
{
  enum Number : std::size_t
  {
    Sine,
    Cosine,
    Gain,
    Added,
    OfColumns // and the same of columns
  };

  static double stripe(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    double factor = 1.0;
    double added = 0.0;
    for (const ImageLine* line : { &pixel.row, &pixel.column })
    {
      factor +=
        numbers[Sine] * line->sine + numbers[Cosine] * line->cosine + numbers[Gain] * line->gain;
      added += numbers[Added] * line->offset;
      if (by != nullptr)
      {
        by[Sine] = line->sine * signal;
        by[Cosine] = line->cosine * signal;
        by[Gain] = line->gain * signal;
        by[Added] = line->offset;
        by += OfColumns;
      }
      numbers += OfColumns;
    }
    signal = signal * factor + added;
    return factor;
  }
};

// Sine and cosine of a period, in every channel.
std::vector<ImageTerm> sines(std::size_t first)
{
  return { { first + StripesOfImage::Sine, true, -0.3, 0.3, 0.01 },
    { first + StripesOfImage::Cosine, true, -0.3, 0.3, 0.01 } };
}

// The strength of a profile of any shape; three sines come nearest to it where it is put back.
ImageTerm profile(std::size_t strength)
{
  return { strength, true, 0.0, 2.0, 0.3 };
}

// Three sines of a period, each with amplitude and phase of its own in every channel.
std::vector<EffectParameter> harmonics(const char* unit, const char* kind)
{
  std::vector<EffectParameter> parameters = { { "amplitude", unit, 0.0, 0.0, 0.45, 0.01, kind,
                                                true },
    { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "one cycle", false, true },
    { "start", "cycle", 0.0, 0.0, 1.0, 0.1, "phase at pixel 0", true, true } };
  for (const char* number : { "2", "3" })
  {
    const std::string index = number;
    parameters.push_back({ "amplitude_" + index, unit, 0.0, 0.0, 0.45, 0.01,
      std::string(kind) + ", " + index + " cycles a period", true });
    parameters.push_back({ "start_" + index, "cycle", 0.0, 0.0, 1.0, 0.1,
      "phase at pixel 0, " + index + " cycles a period", true, true });
  }
  return parameters;
}
}

Effect banding()
{
  const std::vector<EffectParameter> stripes = { { "amplitude", "1", 0.0, 0.0, 0.45, 0.01,
                                                   "relative", true },
    { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "one cycle", false, true },
    { "start", "cycle", 0.0, 0.0, 1.0, 0.1, "phase at pixel 0", true, true } };
  Effect effect;
  effect.definition = { "banding", "Banding",
    "A gain or an offset that changes from row to row or column to column: flicker, readout.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "sine", "u (1 + amplitude sin(2 pi (row / period + phase k)))",
        { { "amplitude", "1", 0.0, 0.0, 0.3, 0.01, "relative" },
          { "period", "pixels", 32.0, 2.0, 4096.0, 8.0, "rows of one cycle", false, true },
          { "phase", "cycle", 0.25, 0.0, 1.0, 0.1, "advance from channel to channel", false,
            true } } },
      { "rows", "u (1 + amplitude_k sin(2 pi (row / period + start_k)))", stripes },
      { "columns", "u (1 + amplitude_k sin(2 pi (column / period + start_k)))", stripes },
      { "row_harmonics",
        "u (1 + sum over n = 1..3 of amplitude_nk sin(2 pi (n row / period + start_nk)))",
        harmonics("1", "relative") },
      { "column_harmonics", "the same with the column", harmonics("1", "relative") },
      { "row_offsets",
        "u + sum over n = 1..3 of amplitude_nk sin(2 pi (n row / period + start_nk))",
        harmonics("white", "of white") },
      { "column_offsets", "the same with the column", harmonics("white", "of white") } },
    { "flat field at two exposure times", 5.0 }, EffectTrait::None,
    { { "rows", sines(0) }, { "columns", sines(StripesOfImage::OfColumns) },
      { "row_harmonics", { profile(StripesOfImage::Gain) } },
      { "column_harmonics", { profile(StripesOfImage::OfColumns + StripesOfImage::Gain) } },
      { "row_offsets", { profile(StripesOfImage::Added) } },
      { "column_offsets", { profile(StripesOfImage::OfColumns + StripesOfImage::Added) } } } };
  effect.onImage.makePixels = [](const BoundEffect& bound) -> PixelOperator
  { return Banding(bound); };
  static const ImageStep step{ ImageStage::Lines,
    { { 0.0, ImageAxis::Rows }, { 0.0, ImageAxis::Rows }, { 0.0, ImageAxis::Rows },
      { 0.0, ImageAxis::Rows }, { 0.0, ImageAxis::Columns }, { 0.0, ImageAxis::Columns },
      { 0.0, ImageAxis::Columns }, { 0.0, ImageAxis::Columns } },
    StripesOfImage::stripe };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
