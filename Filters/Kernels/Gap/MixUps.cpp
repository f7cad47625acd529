#include "Kernels/Gap/MixUps.h"

#include "Kernels/Camera/SampleScene.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace msi
{

namespace
{
constexpr double MuchBetter = 0.25;    // of the squares left
constexpr double HardlyTogether = 0.5; // squared correlation
constexpr double Flat = 0.05;          // deviation of what is simulated over its mean
constexpr double SamePlace = 1e-3;     // squared, of half the field
constexpr std::size_t PairsNamed = 3;

using Row = Eigen::ArrayXd;

// Sums over the elements that both have.
struct RowSums
{
  RowSums(const Row& observed, const Row& simulated)
  {
    for (Eigen::Index i = 0; i < observed.size(); ++i)
    {
      const double o = observed[i];
      const double u = simulated[i];
      if (std::isfinite(o) && std::isfinite(u))
      {
        n += 1.0;
        so += o;
        su += u;
        oo += o * o;
        ou += o * u;
        uu += u * u;
      }
    }
  }
  double gain() const { return uu > 0.0 ? ou / uu : 0.0; }
  double left() const { return oo - gain() * ou; }
  double correlation() const // squared; 1 where what is simulated is flat
  {
    const double spread = uu - su * su / n;
    const double both = ou - so * su / n;
    return n < 3.0 || spread <= Flat * Flat * uu
      ? 1.0
      : both * std::fabs(both) / (spread * std::fmax(oo - so * so / n, 1e-300));
  }
  double n = 0.0, so = 0.0, su = 0.0, oo = 0.0, ou = 0.0, uu = 0.0;
};

double leftBy(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated)
{
  double left = 0.0;
  for (Eigen::Index k = 0; k < observed.rows(); ++k)
  {
    left += RowSums(observed.row(k), simulated.row(k)).left();
  }
  return left;
}

// Two that are each other's best match.
using Pairs = std::vector<std::pair<Eigen::Index, Eigen::Index>>;

std::string exchanged(const char* what, const Pairs& pairs, const std::vector<std::string>& names)
{
  std::string text = what;
  for (std::size_t p = 0; p < std::min(pairs.size(), PairsNamed); ++p)
  {
    text += (p == 0 ? " " : ", ") + names[static_cast<std::size_t>(pairs[p].first)] + " and " +
      names[static_cast<std::size_t>(pairs[p].second)];
  }
  return text + (pairs.size() > PairsNamed ? " and others" : "") +
    " fit much better when they are exchanged.";
}

void lookAtChannels(std::vector<std::string>& found, const Eigen::MatrixXd& observed,
  const Eigen::MatrixXd& simulated, const std::vector<std::string>& channels)
{
  const Eigen::Index K = observed.rows();
  Eigen::MatrixXd left(K, K);
  std::vector<Eigen::Index> best(static_cast<std::size_t>(K));
  for (Eigen::Index a = 0; a < K; ++a)
  {
    for (Eigen::Index b = 0; b < K; ++b)
    {
      left(a, b) = RowSums(observed.row(a), simulated.row(b)).left();
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
  if (K > 3 && 2 * static_cast<Eigen::Index>(pairs.size()) >= K - 1 &&
    std::all_of(pairs.begin(), pairs.end(), isReversed))
  {
    found.emplace_back("Mixed up? The channels fit much better in reverse order.");
  }
  else if (!pairs.empty())
  {
    found.push_back(exchanged("Mixed up? Channels", pairs, channels));
  }
}

void lookAtColumns(std::vector<std::string>& found, const Eigen::MatrixXd& observed,
  const Eigen::MatrixXd& simulated, const std::vector<std::string>& columns)
{
  Eigen::MatrixXd scaled = observed;
  for (Eigen::Index k = 0; k < observed.rows(); ++k)
  {
    scaled.row(k) /= RowSums(observed.row(k), simulated.row(k)).gain();
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
  const double outlier = std::pow(Decision::OutlierDeviations, 2) * typical;
  Pairs pairs;
  std::set<Eigen::Index> taken;
  for (Eigen::Index a = 0; a < observed.cols(); ++a)
  {
    for (Eigen::Index b = a + 1; b < observed.cols(); ++b)
    {
      const double asTold =
        std::fmin(own[static_cast<std::size_t>(a)], own[static_cast<std::size_t>(b)]);
      if (asTold > outlier && taken.count(a) + taken.count(b) == 0 &&
        std::fmax(off(a, b), off(b, a)) < std::fmin(MuchBetter * asTold, outlier))
      {
        pairs.emplace_back(a, b);
        taken.insert({ a, b });
      }
    }
  }
  if (!pairs.empty())
  {
    found.push_back(exchanged("Mixed up? Samples", pairs, columns));
  }
}
}

std::vector<Arrangement> arrangementsOf(const SampleScene& scene)
{
  const Eigen::Index S = scene.size();
  std::vector<Arrangement> all{ { "in reverse order", {} },
    { "shifted by one, each taken for the one behind it", {} },
    { "shifted by one, each taken for the one before it", {} } };
  for (Eigen::Index i = 0; i < S; ++i)
  {
    all[0].instead.push_back(S - 1 - i);
    all[1].instead.push_back((i + 1) % S);
    all[2].instead.push_back((i + S - 1) % S);
  }
  if (!scene.hasPositions())
  {
    return all;
  }
  const Eigen::ArrayXd x = scene.fieldX();
  const Eigen::ArrayXd y = scene.fieldY();
  const auto mirrored = [](const Eigen::ArrayXd& v) -> Eigen::ArrayXd
  { return v.minCoeff() + v.maxCoeff() - v; };
  const auto add = [&](const char* what, const Eigen::ArrayXd& toX, const Eigen::ArrayXd& toY)
  {
    Arrangement arrangement{ what, {} };
    std::set<Eigen::Index> reached;
    for (Eigen::Index i = 0; i < S; ++i)
    {
      Eigen::Index nearest = 0;
      const double distance = ((x - toX[i]).square() + (y - toY[i]).square()).minCoeff(&nearest);
      if (distance < SamePlace)
      {
        arrangement.instead.push_back(nearest);
        reached.insert(nearest);
      }
    }
    if (static_cast<Eigen::Index>(reached.size()) == S)
    {
      all.push_back(std::move(arrangement));
    }
  };
  add("mirrored left to right", mirrored(x), y);
  add("upside down", x, mirrored(y));
  add("turned by 180 degrees", mirrored(x), mirrored(y));
  return all;
}

std::vector<Arrangement> arrangementsOf(Eigen::Index width, Eigen::Index height)
{
  std::vector<Arrangement> all{ { "mirrored left to right", {} }, { "upside down", {} },
    { "turned by 180 degrees", {} } };
  for (Eigen::Index y = 0; y < height; ++y)
  {
    for (Eigen::Index x = 0; x < width; ++x)
    {
      all[0].instead.push_back(y * width + width - 1 - x);
      all[1].instead.push_back((height - 1 - y) * width + x);
      all[2].instead.push_back((height - 1 - y) * width + width - 1 - x);
    }
  }
  return all;
}

std::vector<std::string> mixUps(const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated,
  const std::vector<Arrangement>& arrangements, const std::vector<std::string>& channels,
  const std::vector<std::string>& columns)
{
  std::vector<std::string> found;
  double least = MuchBetter * leftBy(observed, simulated);
  for (const Arrangement& arrangement : arrangements)
  {
    const double left = leftBy(observed, simulated(Eigen::all, arrangement.instead));
    if (left < least)
    {
      least = left;
      found = { (columns.empty() ? "Mixed up? The real image fits much better "
                                 : "Mixed up? The samples fit much better ") +
        arrangement.what + "." };
    }
  }
  if (!found.empty())
  {
    return found;
  }
  lookAtChannels(found, observed, simulated, channels);
  double together = 0.0;
  for (Eigen::Index k = 0; k < observed.rows(); ++k)
  {
    together += RowSums(observed.row(k), simulated.row(k)).correlation() /
      static_cast<double>(observed.rows());
  }
  if (found.empty() && together < HardlyTogether)
  {
    found.emplace_back(columns.empty()
        ? "Mixed up? The real image hardly goes with the simulated one: is it the same scene, in "
          "the "
          "same place?"
        : "Mixed up? The readings hardly go with the samples: do they belong to these, in this "
          "order?");
  }
  else if (found.empty() && !columns.empty())
  {
    lookAtColumns(found, observed, simulated, columns);
  }
  return found;
}

} // namespace msi
