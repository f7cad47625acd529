#include "Kernels/Gap/Field/FieldStarts.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/Imaging/ChannelDisplacement.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/Angle.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <Eigen/Cholesky>
#include <unsupported/Eigen/SpecialFunctions>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>

namespace msi
{

namespace
{
constexpr double LeastMove = 0.5; // pixels: a fit by gradients finds less by itself

// A channel of the simulated image, and of the real one.
std::vector<PixelBuffer> tilesOf(const FieldPair& pair, std::size_t channel)
{
  const std::size_t K = pair.channels.size();
  std::vector<PixelBuffer> tiles;
  for (const ImageWindow& window : displacementTiles(pair.extent))
  {
    PixelBuffer& tile = tiles.emplace_back();
    tile.resize(window, 2);
    for (int y = window.y; y < window.y + window.height; ++y)
    {
      for (int x = window.x; x < window.x + window.width; ++x)
      {
        const std::size_t value = pair.index(x, y) * K + channel;
        tile.pixel(x, y)[0] = pair.simulated[value];
        tile.pixel(x, y)[1] = pair.real[value];
      }
    }
  }
  return tiles;
}
}

std::vector<ImageDisplacement> registrationStart(const FieldData& data)
{
  const FieldPair& pair = data.pair;
  const ImageExtent& extent = pair.extent;
  const auto K = static_cast<int>(pair.channels.size());
  if (std::min(extent.width, extent.height) < DisplacementSearch::LeastTileSide)
  {
    return {};
  }
  std::vector<ImageDisplacement> start(K);
  const double corner = 0.5 * std::hypot(extent.width, extent.height);
  data.loop(K,
    [&](int channel)
    {
      const std::vector<PixelBuffer> tiles = tilesOf(pair, channel);
      const ChannelDisplacement found =
        DisplacementSearch(tiles, extent, DisplacementModel::Similarity)(0, 1);
      const double farthest = std::hypot(found.right, found.down) +
        corner * std::hypot(found.magnification, Degree * found.rotation);
      if (found.standardError.isFinite().all() && farthest > LeastMove)
      {
        start[channel] = { found.right, found.down, found.magnification, found.rotation };
      }
    });
  const bool far = std::any_of(start.begin(), start.end(),
    [](const ImageDisplacement& one) { return one.right != 0.0 || one.down != 0.0; });
  return far ? start : std::vector<ImageDisplacement>();
}

namespace
{
constexpr double LeastLevel = 0.1;
constexpr std::size_t FewestPixels = 20; // beyond the level
constexpr double Better = 0.5;           // of the squares beyond the level must go
}

const std::vector<ImageTerm>& clippingTerms()
{
  return effectWith(EffectTrait::LimitsResponse).imageForms.front().terms;
}

namespace
{
struct ClipPixel
{
  double level; // of the model
  double real;
};

double findClipLevel(std::vector<ClipPixel> pixels)
{
  std::sort(pixels.begin(), pixels.end(),
    [](const ClipPixel& a, const ClipPixel& b)
    { return a.level != b.level ? a.level > b.level : a.real > b.real; });
  // From the brightest down: the mean of the real values beyond a level is the level.
  double n = 0.0;
  double sum = 0.0;
  double square = 0.0;
  double before = 0.0;
  double most = 0.0;
  double best = numberOf(clippingTerms()[1].parameter).neutral;
  for (std::size_t i = 0; i < pixels.size(); ++i)
  {
    const auto& [level, real] = pixels[i];
    n += 1.0;
    sum += real;
    square += real * real;
    before += (real - level) * (real - level);
    const double mean = sum / n;
    const double gain = before - (square - sum * mean);
    // Where the brightest are seen darker than the level that they pass the level is theirs.
    if (i + 1 >= FewestPixels && level >= LeastLevel && mean <= level && gain > most &&
      gain > Better * before)
    {
      most = gain;
      best = mean;
    }
  }
  return best;
}
}

Eigen::ArrayXd findClipLevels(const std::vector<FieldResidual>& residuals, Eigen::Index channels)
{
  std::vector<std::vector<ClipPixel>> own(channels);
  std::vector<ClipPixel> all;
  for (std::size_t part = 0; part < residuals.size(); ++part)
  {
    const FieldResidual& here = residuals[part];
    for (Eigen::Index n = 0; n < here.level.size(); ++n)
    {
      all.push_back({ here.level[n], here.level[n] + here.residual[n] });
      own[part % own.size()].push_back(all.back());
    }
  }
  const double neutral = numberOf(clippingTerms()[1].parameter).neutral;
  const double common = findClipLevel(std::move(all));
  Eigen::ArrayXd levels(channels);
  std::transform(std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()),
    levels.begin(), findClipLevel);
  const double found = (levels == neutral).select(0.0, levels).maxCoeff();
  const double other = common != neutral || found == 0.0 ? common : found;
  return (levels == neutral).select(other, levels);
}

namespace
{
// A number of each line and channel, and its weight; lines x K. Of each channel: the energy in all lines, and how many pixels they
// have.
struct LineValues
{
  Eigen::ArrayXXd value, weight;
  Eigen::ArrayXd energy, pixels;

  LineValues(Eigen::Index lines, Eigen::Index channels)
    : value(Eigen::ArrayXXd::Zero(lines, channels))
    , weight(value)
    , energy(Eigen::ArrayXd::Zero(channels))
    , pixels(energy)
  {
  }
};

constexpr Eigen::Index DefectPart = 50; // one line of so many may be defect

// The relative gain of the residual of each line, or its offset, from the blocks of each fold; value: times weight.
// limit: residuals count up to this size, K; empty: in full.
std::vector<LineValues> lineSums(const FieldData& data, const std::vector<FieldResidual>& residuals,
  bool alongRows, bool ofGain, const Eigen::ArrayXd& limit)
{
  const Eigen::Index lines = alongRows ? data.pair.extent.height : data.pair.extent.width;
  std::vector<LineValues> folds(FieldFolds, LineValues(lines, data.channels()));
  for (std::size_t i = 0; i < residuals.size(); ++i)
  {
    const FieldResidual& part = residuals[i];
    const FieldBlock& block = data.blocks[i / data.pair.channels.size()];
    const Eigen::Index k = i % data.pair.channels.size();
    for (Eigen::Index n = 0; n < part.residual.size(); ++n)
    {
      LineValues& fold = folds[block.fold];
      const ImagePlace place = block.place(part.pixel[n]);
      const int line = alongRows ? place.y : place.x;
      const double u = ofGain ? part.gain[n] : 1.0;
      const double size = std::fabs(part.residual[n]);
      const double weight = limit.size() > 0 && size > limit[k] ? limit[k] / size : 1.0;
      fold.value(line, k) += weight * u * part.residual[n];
      fold.weight(line, k) += weight * u * u;
      fold.energy[k] += weight * size * size;
      fold.pixels[k] += 1.0;
    }
  }
  return folds;
}

// Takes a polynomial off each channel: 1 term is the mean, 3 a quadratic.
void detrend(LineValues& lines, Eigen::Index terms)
{
  const Eigen::Index count = lines.value.rows();
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(count, -1.0, 1.0);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Ones(count, terms);
  for (Eigen::Index power = 1; power < terms; ++power)
  {
    basis.col(power) = basis.col(power - 1).array() * t;
  }
  for (Eigen::Index k = 0; k < lines.value.cols(); ++k)
  {
    const Eigen::MatrixXd weighted = lines.weight.col(k).matrix().asDiagonal() * basis;
    const Eigen::MatrixXd normal = weighted.transpose() * basis;
    const Eigen::VectorXd right = weighted.transpose() * lines.value.col(k).matrix();
    lines.value.col(k) -= (basis * normal.ldlt().solve(right)).array();
  }
}

void cutDefects(Eigen::ArrayXXd& values)
{
  const Eigen::Index cut = values.rows() / DefectPart + 1;
  for (Eigen::Index k = 0; k < values.cols(); ++k)
  {
    const double next =
      orderStatistic(values.col(k).abs(), values.rows() - 1 - std::min(cut, values.rows() - 1));
    values.col(k) = values.col(k).max(-next).min(next);
  }
}

// The mean of each line over all folds but one.
LineValues meansWithout(const std::vector<LineValues>& folds, std::size_t without)
{
  LineValues lines(folds[0].value.rows(), folds[0].value.cols());
  for (std::size_t fold = 0; fold < folds.size(); ++fold)
  {
    if (fold != without)
    {
      lines.value += folds[fold].value;
      lines.weight += folds[fold].weight;
      lines.energy += folds[fold].energy;
      lines.pixels += folds[fold].pixels;
    }
  }
  lines.value /= lines.weight.max(1e-12);
  return lines;
}

// Of a pixel, from what differs within the lines; K.
Eigen::ArrayXd noiseWithin(const LineValues& means)
{
  const Eigen::ArrayXd between = (means.weight * means.value.square()).colwise().sum().transpose();
  const auto lines = static_cast<double>(means.value.rows());
  return ((means.energy - between) / (means.pixels - lines).max(1.0)).max(0.0);
}

// What a line in the dark says is mostly noise: each mean times the part of its variance that is not.
void shrinkToZero(LineValues& means, const Eigen::ArrayXd& noise)
{
  for (Eigen::Index k = 0; k < means.value.cols(); ++k)
  {
    const Eigen::ArrayXd weight = means.weight.col(k);
    const double between = (weight * means.value.col(k).square()).sum();
    const auto measured = static_cast<double>((weight > 0.0).count());
    const double spread =
      std::fmax(between - measured * noise[k], 0.0) / std::fmax(weight.sum(), 1e-300);
    means.value.col(k) *= spread * weight / (spread * weight + noise[k]).max(1e-300);
  }
}
}

FieldProfile findProfile(const FieldData& data, const std::vector<FieldResidual>& residuals,
  bool alongRows, bool keepTrend, const Eigen::ArrayXd& limit)
{
  const auto profiles = [&](bool ofGain)
  {
    const std::vector<LineValues> folds = lineSums(data, residuals, alongRows, ofGain, limit);
    std::vector<Eigen::ArrayXXd> found;
    for (std::size_t without = 0; without <= folds.size(); ++without)
    {
      LineValues lines = meansWithout(folds, without);
      const Eigen::ArrayXd noise = noiseWithin(lines);
      detrend(lines, keepTrend ? 1 : 3);
      shrinkToZero(lines, noise);
      found.push_back(lines.value);
      cutDefects(found.back());
    }
    return found;
  };
  return { profiles(true), profiles(false) };
}

namespace
{
constexpr double FalseAlarm = 1e-3;
constexpr Eigen::Index Oversampling = 6; // of frequencies
constexpr int Refinements = 40;
constexpr Eigen::Index FewestLines = 24;

// Weighted energy that a sine takes away, of each channel.
Eigen::ArrayXd powerAt(const LineValues& profile, double frequency)
{
  Eigen::ArrayXd c(profile.value.rows());
  Eigen::ArrayXd s(c.size());
  const std::complex<double> turn = std::polar(1.0, TwoPi * frequency);
  std::complex<double> now = 1.0;
  for (Eigen::Index line = 0; line < c.size(); ++line, now *= turn)
  {
    c[line] = now.real();
    s[line] = now.imag();
  }
  const auto sums = [](const Eigen::ArrayXd& factor, const Eigen::ArrayXXd& values)
  { return Eigen::ArrayXd((values.matrix().transpose() * factor.matrix()).array()); };
  const Eigen::ArrayXd cc = sums(c.square(), profile.weight);
  const Eigen::ArrayXd cs = sums(c * s, profile.weight);
  const Eigen::ArrayXd ss = sums(s.square(), profile.weight);
  const Eigen::ArrayXXd weighted = profile.weight * profile.value;
  const Eigen::ArrayXd cz = sums(c, weighted);
  const Eigen::ArrayXd sz = sums(s, weighted);
  return (ss * cz * cz - 2.0 * cs * cz * sz + cc * sz * sz) / (cc * ss - cs * cs).max(1e-300);
}
}

void findPeriod(const FieldData& data, const std::vector<FieldResidual>& residuals, bool alongRows,
  FieldStripes& stripes)
{
  stripes.period = stripes.periodError = 0.0;
  LineValues profile =
    meansWithout(lineSums(data, residuals, alongRows, true, Eigen::ArrayXd()), FieldFolds);
  const Eigen::Index lines = profile.value.rows();
  const Eigen::Index K = profile.value.cols();
  if (lines < FewestLines)
  {
    return;
  }
  detrend(profile, 3);
  const double span = static_cast<double>(lines);
  const auto count = static_cast<int>(Oversampling * (0.5 * span - 2.0)) + 1;
  const auto frequencyOf = [&](Eigen::Index i)
  { return (2.0 + static_cast<double>(i) / Oversampling) / span; };
  Eigen::ArrayXXd power(count, K);
  constexpr int Batch = 64;
  data.loop((count + Batch - 1) / Batch,
    [&](int batch)
    {
      for (int i = batch * Batch; i < std::min((batch + 1) * Batch, count); ++i)
      {
        power.row(i) = powerAt(profile, frequencyOf(i)).transpose();
      }
    });
  Eigen::ArrayXd scale(K);
  for (Eigen::Index k = 0; k < K; ++k)
  {
    scale[k] = std::fmax(orderStatistic(power.col(k), count / 2) / std::log(2.0), 1e-300);
  }
  const auto total = [&](double frequency) { return (powerAt(profile, frequency) / scale).sum(); };
  Eigen::Index best = 0;
  const double most = (power.rowwise() / scale.transpose()).rowwise().sum().maxCoeff(&best);
  // The sum of K exponential deviates of mean one exceeds it with this probability.
  if (Eigen::numext::igammac(static_cast<double>(K), most) * span > FalseAlarm)
  {
    return;
  }
  double low = frequencyOf(best) - 1.0 / (Oversampling * span);
  double high = std::fmin(frequencyOf(best) + 1.0 / (Oversampling * span), 0.5);
  for (int i = 0; i < Refinements; ++i)
  {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (total(a) < total(b) ? low : high) = total(a) < total(b) ? a : b;
  }
  const double frequency = 0.5 * (low + high);
  // Cramer-Rao for a sine of this power in white noise: var f = 6 / (power (2 pi span)^2) x 2.
  const double error = std::sqrt(6.0 / std::fmax(total(frequency), 1e-9)) / (TwoPi * span);
  stripes.period = 1.0 / frequency;
  stripes.periodError = error / (frequency * frequency);
}

namespace
{
constexpr double LargestAmplitude = 0.45;

// Sine and cosine of every harmonic.
Eigen::MatrixXd basisOf(Eigen::Index lines, double period)
{
  Eigen::MatrixXd basis(lines, 2 * BandingHarmonics);
  const Eigen::ArrayXd line = Eigen::ArrayXd::LinSpaced(lines, 0.0, static_cast<double>(lines - 1));
  for (Eigen::Index n = 0; n < BandingHarmonics; ++n)
  {
    const Eigen::ArrayXd angle = TwoPi * static_cast<double>(n + 1) / period * line;
    basis.col(2 * n) = angle.sin();
    basis.col(2 * n + 1) = angle.cos();
  }
  return basis;
}

void setSine(BandingSines& sines, Eigen::Index channel, Eigen::Index n, double sine, double cosine)
{
  sines.amplitude(channel, n) = std::fmin(std::hypot(sine, cosine), LargestAmplitude);
  const double start = std::atan2(cosine, sine) / TwoPi;
  sines.start(channel, n) = start - std::floor(start);
}

BandingSines noSines(Eigen::Index channels, Eigen::Index harmonics)
{
  BandingSines sines;
  sines.amplitude.setZero(channels, harmonics);
  sines.start.setZero(channels, harmonics);
  return sines;
}
}

BandingSines nearestSines(const Eigen::ArrayXXd& profile)
{
  const Eigen::Index lines = profile.rows();
  BandingSines sines = noSines(profile.cols(), BandingHarmonics);
  LineValues even(lines, profile.cols());
  even.value = profile;
  even.weight.setOnes();
  // Of all channels, at i / (Oversampling lines) cycles a line.
  Eigen::ArrayXd energy(Oversampling * lines / 2 + 1);
  for (Eigen::Index i = 0; i < energy.size(); ++i)
  {
    energy[i] =
      powerAt(even, static_cast<double>(i) / static_cast<double>(Oversampling * lines)).sum();
  }
  // Two cycles at least; harmonics beyond two pixels a cycle are those of another period.
  Eigen::ArrayXd together = Eigen::ArrayXd::Zero(energy.size());
  for (Eigen::Index i = 2 * Oversampling; i < energy.size(); ++i)
  {
    for (Eigen::Index n = 1; n <= BandingHarmonics && n * i < energy.size(); ++n)
    {
      together[i] += energy[n * i];
    }
  }
  Eigen::Index best = 0;
  const double most = together.maxCoeff(&best);
  // A period is one of twice and three times its length, too.
  for (Eigen::Index n = BandingHarmonics; n > 1; --n)
  {
    const Eigen::Index first = n * best - n;
    const Eigen::Index count = std::min(2 * n + 1, together.size() - first);
    Eigen::Index at = 0;
    if (count > 0 &&
      together.segment(first, count).maxCoeff(&at) > (1.0 - Decision::SmallPart) * most)
    {
      best = first + at;
      break;
    }
  }
  sines.period =
    std::fmax(static_cast<double>(Oversampling * lines) / static_cast<double>(best), 2.0);
  Eigen::MatrixXd basis = basisOf(lines, sines.period);
  Eigen::MatrixXd normal = basis.transpose() * basis;
  normal.diagonal().array() += 1e-6 * static_cast<double>(lines);
  double left = 0.0;
  for (Eigen::Index k = 0; k < profile.cols(); ++k)
  {
    const Eigen::VectorXd values = profile.col(k).matrix();
    const Eigen::VectorXd weight = normal.ldlt().solve(basis.transpose() * values);
    left += (values - basis * weight).squaredNorm();
    for (Eigen::Index n = 0; n < BandingHarmonics; ++n)
    {
      setSine(sines, k, n, weight[2 * n], weight[2 * n + 1]);
    }
  }
  sines.part = 1.0 - left / std::fmax(profile.square().sum(), 1e-30);
  sines.rms = std::sqrt(profile.square().colwise().mean().maxCoeff());
  return sines;
}

namespace
{
// Lines x K.
Eigen::ArrayXXd profileOf(const FieldChoice& choice, const FieldModel& model)
{
  const FieldProfile& profile = *model.stripes(isOfRows(choice)).profile;
  return (isOffset(choice) ? profile.offset : profile.gain).back().rowwise() *
    model[choice.terms.front().parameter].transpose();
}
}

bool isSlow(const FieldChoice& profile, const FieldModel& model)
{
  const Eigen::ArrayXXd values = profileOf(profile, model);
  const Eigen::Index lines = values.rows();
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(lines, 0.5, lines - 0.5) / lines;
  double slow = 0.0;
  for (int halfCycles = 1; halfCycles < 8; ++halfCycles)
  {
    const Eigen::VectorXd wave = (0.5 * TwoPi * halfCycles * place).cos() * std::sqrt(2.0 / lines);
    slow += (wave.transpose() * values.matrix()).squaredNorm();
  }
  return slow > 0.5 * values.square().sum();
}

BandingSines bandingSines(const FieldChoice& choice, const FieldModel& model)
{
  if (isProfile(choice))
  {
    return nearestSines(profileOf(choice, model));
  }
  const FieldStripes& stripes = model.stripes(isOfRows(choice));
  const ImageParameter first = choice.terms.front().parameter;
  const Eigen::Index K = model[first].size();
  BandingSines sines = noSines(K, 1);
  sines.period = stripes.period;
  for (Eigen::Index k = 0; k < K; ++k)
  {
    setSine(sines, k, 0, model.at(first, k), model.at(choice.terms[1].parameter, k));
  }
  return sines;
}

} // namespace msi
