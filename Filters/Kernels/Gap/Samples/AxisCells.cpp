#include "Kernels/Gap/Samples/AxisCells.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

namespace msi
{

namespace
{
constexpr std::size_t CellsNamed = 5;

std::string rangeText(const char* what, double low, double high)
{
  std::ostringstream text;
  text.precision(3);
  text << what << ' ' << low << ".." << high;
  return text.str();
}

std::string part(const char* what, double value, double low, double high, int parts)
{
  const double width = (high - low) / parts;
  const double at = width > 0.0 ? std::floor((value - low) / width) : 0.0;
  const double cell = std::fmin(std::fmax(at, 0.0), parts - 1.0);
  return rangeText(what, low + cell * width, low + (cell + 1.0) * width);
}

using CellOf = std::function<std::string(Eigen::Index, Eigen::Index)>;

CellOf sampleCell()
{
  return [](Eigen::Index, Eigen::Index i)
  {
    std::ostringstream name;
    name << "sample " << i + 1;
    return name.str();
  };
}

CellOf cellOf(const GapData& data, const std::string& axis)
{
  const SampleScene& scene = data.scene;
  if (axis == "channel" || axis == "spectral_shape")
  {
    return [&data](Eigen::Index k, Eigen::Index)
    { return data.camera.channels()[static_cast<std::size_t>(k)]; };
  }
  if (axis == "medium" || axis == "scene")
  {
    const bool medium = axis == "medium";
    const std::vector<int>& number = medium ? scene.medium() : scene.scene();
    const std::vector<std::string>& names = medium ? scene.media() : scene.scenes();
    return [&number, &names](Eigen::Index, Eigen::Index i)
    { return names[static_cast<std::size_t>(number[static_cast<std::size_t>(i)])]; };
  }
  if (axis == "position")
  {
    const Eigen::VectorXd& x = scene.samples().x;
    const Eigen::VectorXd& y = scene.samples().y;
    return [&x, &y](Eigen::Index, Eigen::Index i)
    {
      return part("x", x[i], x.minCoeff(), x.maxCoeff(), 3) + ", " +
        part("y", y[i], y.minCoeff(), y.maxCoeff(), 3);
    };
  }
  if (axis == "order")
  {
    const Eigen::VectorXd& order = scene.samples().order;
    return [&order](Eigen::Index, Eigen::Index i)
    { return part("order", order[i], order.minCoeff(), order.maxCoeff(), 5); };
  }
  if (axis == "level")
  {
    double low = 0.0;
    double high = 0.0;
    for (Eigen::Index i = 0; i < data.simulated.size(); ++i)
    {
      if (data.count(i) > 0.0)
      {
        low = std::fmin(low, data.simulated(i));
        high = std::fmax(high, data.simulated(i));
      }
    }
    return [&data, low, high](Eigen::Index k, Eigen::Index i)
    { return part("level", data.simulated(k, i), low, high, 5); };
  }
  return sampleCell();
}
}

std::vector<GapCell> worstCells(
  const GapData& data, const Eigen::MatrixXd& gap, const std::string& axis)
{
  const CellOf cell = cellOf(data, axis);
  const bool perElement = axis == "level" || axis == "channel" || axis == "spectral_shape";
  std::map<std::string, double> energy;
  double total = 0.0;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    if (data.usable[static_cast<std::size_t>(i)] == 0)
    {
      continue;
    }
    double sum = 0.0;
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      const double square = data.count(k, i) > 0.0 ? gap(k, i) * gap(k, i) : 0.0;
      sum += square;
      if (perElement)
      {
        energy[cell(k, i)] += square;
      }
    }
    if (!perElement)
    {
      energy[cell(0, i)] += sum;
    }
    total += sum;
  }
  std::vector<GapCell> cells;
  cells.reserve(energy.size());
  for (const auto& [name, square] : energy)
  {
    cells.push_back({ name, total > 0.0 ? square / total : 0.0 });
  }
  std::stable_sort(cells.begin(), cells.end(),
    [](const GapCell& a, const GapCell& b) { return a.share > b.share; });
  cells.resize(std::min(cells.size(), CellsNamed));
  return cells;
}

} // namespace msi
