#include "Kernels/Doubts/MixUps.h"

#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace msi
{

namespace
{
constexpr double MuchBetter = 0.25;    // of the squares left
constexpr double HardlyTogether = 0.5; // squared correlation
constexpr double Outlier = 6.0;        // deviations of the usual one
constexpr double Dead = 0.01;      // variance over that of the others, each over what is simulated
constexpr double Rounding = 1e-9;  // of the squares
constexpr double SamePlace = 1e-3; // squared distance
constexpr std::size_t PairsNamed = 3;
constexpr Eigen::Index FewestCopied = 4; // values that are the same

double leftOf(const std::vector<PairSums>& channels)
{
  return std::accumulate(channels.begin(), channels.end(), 0.0,
    [](double sum, const PairSums& channel) { return sum + channel.left(); });
}

// 1 where what is simulated is flat.
double correlationOf(const PairSums& sums)
{
  return sums.n < 3.0 || sums.isFlat() ? 1.0 : sums.correlation();
}

using Pairs = std::vector<std::pair<Eigen::Index, Eigen::Index>>;

// Empty without pairs.
std::string told(
  std::string text, const Pairs& pairs, const std::vector<std::string>& names, const char* what)
{
  if (pairs.empty())
  {
    return {};
  }
  for (std::size_t p = 0; p < std::min(pairs.size(), PairsNamed); ++p)
  {
    text += (p == 0 ? " " : ", ") + names[static_cast<std::size_t>(pairs[p].first)] + " and " +
      names[static_cast<std::size_t>(pairs[p].second)];
  }
  return text + (pairs.size() > PairsNamed ? " and others" : "") + what;
}

// Each other's best match.
std::string exchanged(const char* text, const Pairs& pairs, const std::vector<std::string>& names)
{
  return told(text, pairs, names, " fit much better when they are exchanged.");
}

// Channels that have the same values where they should not.
std::string copiedChannels(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<std::string>& names)
{
  Pairs pairs;
  for (Eigen::Index a = 0; a < observed.rows(); ++a)
  {
    for (Eigen::Index b = a + 1; b < observed.rows(); ++b)
    {
      const Eigen::ArrayXd apart = observed.row(a) - observed.row(b);
      const bool same = (apart.isNaN() || apart == 0.0).all();
      const auto both = (!apart.isNaN()).count();
      if (same && both >= FewestCopied && !sumsOf(observed.row(a), simulated.row(a)).isFlat() &&
        simulated.row(a) != simulated.row(b))
      {
        pairs.emplace_back(a, b);
      }
    }
  }
  return told("Twice? Channels", pairs, names,
    " have the same values: was the same file or column taken for both?");
}

std::string exchangedChannels(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<std::string>& channels)
{
  const Eigen::Index K = observed.rows();
  Eigen::MatrixXd left(K, K);
  std::vector<Eigen::Index> best(static_cast<std::size_t>(K));
  for (Eigen::Index a = 0; a < K; ++a)
  {
    for (Eigen::Index b = 0; b < K; ++b)
    {
      left(a, b) = sumsOf(observed.row(a), simulated.row(b)).left();
    }
    left.row(a).minCoeff(&best[static_cast<std::size_t>(a)]);
  }
  const auto bestOf = [&best](Eigen::Index a) { return best[static_cast<std::size_t>(a)]; };
  Pairs pairs;
  for (Eigen::Index a = 0; a < K; ++a)
  {
    const Eigen::Index b = bestOf(a);
    if (a < b && bestOf(b) == a && left(a, b) + left(b, a) < MuchBetter * (left(a, a) + left(b, b)))
    {
      pairs.emplace_back(a, b);
    }
  }
  const auto isReversed = [K](const auto& pair) { return pair.first + pair.second == K - 1; };
  return K > 3 && 2 * static_cast<Eigen::Index>(pairs.size()) >= K - 1 &&
      std::all_of(pairs.begin(), pairs.end(), isReversed)
    ? "The channels fit much better in reverse order."
    : exchanged("Channels", pairs, channels);
}

std::string exchangedSamples(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<PairSums>& asTold, const std::vector<std::string>& names)
{
  Eigen::MatrixXd scaled = observed;
  for (Eigen::Index k = 0; k < observed.rows(); ++k)
  {
    scaled.row(k) /= asTold[static_cast<std::size_t>(k)].gain();
  }
  const auto off = [&](Eigen::Index reading, Eigen::Index sample)
  {
    const Eigen::ArrayXd gap = scaled.col(reading) - simulated.col(sample);
    return gap.isFinite().select(gap.square(), 0.0).sum();
  };
  std::vector<double> own;
  for (Eigen::Index i = 0; i < observed.cols(); ++i)
  {
    own.push_back(off(i, i));
  }
  const double typical = orderStatistic(own, static_cast<std::ptrdiff_t>(own.size() / 2));
  const double outlier = Outlier * Outlier * typical;
  std::vector<Eigen::Index> outliers;
  for (Eigen::Index i = 0; i < observed.cols(); ++i)
  {
    if (own[static_cast<std::size_t>(i)] > outlier)
    {
      outliers.push_back(i);
    }
  }
  Pairs pairs;
  std::set<Eigen::Index> taken;
  for (auto first = outliers.begin(); first != outliers.end(); ++first)
  {
    for (auto second = first + 1; second != outliers.end(); ++second)
    {
      const Eigen::Index a = *first;
      const Eigen::Index b = *second;
      const double both =
        std::fmin(own[static_cast<std::size_t>(a)], own[static_cast<std::size_t>(b)]);
      if (taken.count(a) + taken.count(b) == 0 &&
        std::fmax(off(a, b), off(b, a)) < std::fmin(MuchBetter * both, outlier))
      {
        pairs.emplace_back(a, b);
        taken.insert({ a, b });
      }
    }
  }
  return exchanged("Samples", pairs, names);
}

// As mixUp(), without the question.
MixUp betterThanTold(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<Arrangement>& arrangements, const std::vector<std::string>& channels,
  const std::vector<std::string>& columns, bool known)
{
  const bool images = columns.empty();
  const std::vector<PairSums> asTold = sumsOfChannels(observed, simulated);
  const double squares = std::accumulate(asTold.begin(), asTold.end(), 0.0,
    [](double sum, const PairSums& channel) { return sum + channel.realSquares; });
  const double left = leftOf(asTold);
  if (left <= Rounding * squares)
  {
    return {};
  }
  double least = MuchBetter * left;
  std::string found;
  for (const Arrangement& arrangement : arrangements)
  {
    const double other =
      leftOf(sumsOfChannels(observed, simulated(Eigen::all, arrangement.instead)));
    if (other < least)
    {
      least = other;
      found = (images ? "The real image fits" : "The samples fit") + std::string(" much better ") +
        arrangement.what + ".";
    }
  }
  if (found.empty())
  {
    found = exchangedChannels(observed, simulated, channels);
  }
  if (!found.empty())
  {
    return { found, true };
  }
  if (!images)
  {
    found = exchangedSamples(observed, simulated, asTold, columns);
  }
  if (known || !found.empty())
  {
    return { found };
  }
  double together = 0.0;
  for (const PairSums& channel : asTold)
  {
    together += correlationOf(channel) / static_cast<double>(asTold.size());
  }
  found = together >= HardlyTogether ? ""
    : images ? "The real image hardly goes with the simulated one: is it the same scene, in the "
               "same place?"
             : "The readings hardly go with the samples: do they belong to these, in this order?";
  return { found };
}
}

std::vector<Eigen::Index> deadChannels(const std::vector<PairSums>& channels)
{
  Eigen::VectorXd contrast(static_cast<Eigen::Index>(channels.size()));
  std::transform(channels.begin(), channels.end(), contrast.begin(),
    [](const PairSums& sums) { return sums.isFlat() ? 0.0 : sums.ofReal() / sums.ofSimulated(); });
  const double usual = orderStatistic(contrast, contrast.size() / 2);
  std::vector<Eigen::Index> dead;
  for (Eigen::Index k = 0; k < contrast.size(); ++k)
  {
    const PairSums& channel = channels[static_cast<std::size_t>(k)];
    if (!channel.isFlat() && contrast[k] < Dead * usual &&
      (channel.isSteady() || correlationOf(channel) < HardlyTogether))
    {
      dead.push_back(k);
    }
  }
  return dead;
}

std::string deadChannelsNote(const std::vector<Eigen::Index>& dead,
  const std::vector<std::string>& channels, const std::string& consequence)
{
  std::string text;
  for (const Eigen::Index k : dead)
  {
    text += (text.empty() ? "Dead? Channel " : ", ") + channels[static_cast<std::size_t>(k)];
  }
  return text.empty() ? text
                      : text + " does not change with the scene as the others do" + consequence +
      ": is it connected, and nothing before it?";
}

std::vector<Arrangement> turnedPlaces(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y)
{
  const Eigen::ArrayXd mirroredX = x.minCoeff() + x.maxCoeff() - x;
  const Eigen::ArrayXd mirroredY = y.minCoeff() + y.maxCoeff() - y;
  std::vector<Arrangement> all;
  const auto add = [&](const char* what, const Eigen::ArrayXd& toX, const Eigen::ArrayXd& toY)
  {
    Arrangement arrangement{ what, {} };
    std::set<Eigen::Index> reached;
    for (Eigen::Index i = 0; i < x.size(); ++i)
    {
      Eigen::Index nearest = 0;
      const double distance = ((x - toX[i]).square() + (y - toY[i]).square()).minCoeff(&nearest);
      if (distance < SamePlace)
      {
        arrangement.instead.push_back(nearest);
        reached.insert(nearest);
      }
    }
    if (static_cast<Eigen::Index>(reached.size()) == x.size())
    {
      all.push_back(std::move(arrangement));
    }
  };
  add("mirrored left to right", mirroredX, y);
  add("upside down", x, mirroredY);
  add("turned by 180 degrees", mirroredX, mirroredY);
  return all;
}

std::vector<Arrangement> arrangementsOf(
  Eigen::Index S, const Eigen::ArrayXd& x, const Eigen::ArrayXd& y)
{
  std::vector<Arrangement> all{ { "in reverse order", {} },
    { "shifted by one, each taken for the one behind it", {} },
    { "shifted by one, each taken for the one before it", {} } };
  for (Eigen::Index i = 0; i < S; ++i)
  {
    all[0].instead.push_back(S - 1 - i);
    all[1].instead.push_back((i + 1) % S);
    all[2].instead.push_back((i + S - 1) % S);
  }
  if (x.size() > 0)
  {
    const std::vector<Arrangement> turned = turnedPlaces(x, y);
    all.insert(all.end(), turned.begin(), turned.end());
  }
  return all;
}

MixUp mixUp(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<Arrangement>& arrangements, const std::vector<std::string>& channels,
  const std::vector<std::string>& columns, bool together)
{
  const std::string dead =
    deadChannelsNote(deadChannels(sumsOfChannels(observed, simulated)), channels);
  if (!dead.empty())
  {
    return { dead };
  }
  const std::string copied = copiedChannels(observed, simulated, channels);
  if (!copied.empty())
  {
    return { copied, true };
  }
  MixUp found = betterThanTold(observed, simulated, arrangements, channels, columns, together);
  found.question.insert(0, found.question.empty() ? "" : "Mixed up? ");
  return found;
}

} // namespace msi
