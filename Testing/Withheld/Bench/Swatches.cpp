#include "Swatches.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace withheld
{

namespace
{
// Catmull-Rom through equally spaced values; the ends hold.
Curve everyNanometre(const std::vector<double>& values, double first, double step)
{
  Curve curve(Nanometres);
  const int last = static_cast<int>(values.size()) - 1;
  const auto value = [&values, last](int i)
  { return values[static_cast<std::size_t>(std::min(std::max(i, 0), last))]; };
  for (int j = 0; j < Nanometres; ++j)
  {
    const double place =
      std::min(std::max((FirstNanometre + j - first) / step, 0.0), static_cast<double>(last));
    const int i = static_cast<int>(std::floor(place));
    const double t = place - i;
    const double a = value(i - 1);
    const double b = value(i);
    const double c = value(i + 1);
    const double d = value(i + 2);
    curve[static_cast<std::size_t>(j)] =
      b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
  }
  return curve;
}

SwatchBook readBook(const std::string& path, const std::string& name)
{
  SwatchBook book{ name, {} };
  std::ifstream file(path);
  std::string line;
  std::vector<double> wavelengths;
  std::size_t firstColumn = 0;
  while (std::getline(file, line))
  {
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');)
    {
      cells.push_back(cell);
    }
    if (wavelengths.empty())
    {
      for (std::size_t c = 0; c < cells.size(); ++c)
      {
        const bool spectral = cells[c].size() >= 4 && cells[c][0] == 'R' &&
          cells[c].find_first_not_of("0123456789\r", 1) == std::string::npos;
        if (spectral)
        {
          firstColumn = wavelengths.empty() ? c : firstColumn;
          wavelengths.push_back(std::stod(cells[c].substr(1)));
        }
      }
      continue;
    }
    std::vector<double> values;
    for (std::size_t w = 0; w < wavelengths.size() && firstColumn + w < cells.size(); ++w)
    {
      values.push_back(std::stod(cells[firstColumn + w]));
    }
    if (values.size() == wavelengths.size() && values.size() > 1)
    {
      book.reflectance.push_back(
        everyNanometre(values, wavelengths.front(), wavelengths[1] - wavelengths[0]));
    }
  }
  return book;
}
}

SwatchBook drawSwatches(Random& random, const std::string& name, int count)
{
  SwatchBook book{ name, {} };
  const double paper = uniform(random, 0.7, 0.92);
  const double blueLoss = uniform(random, 0.0, 0.5);
  const double deepest = uniform(random, 0.02, 0.06);
  const double sharpness = uniform(random, 0.6, 1.6);
  const int pigments = integer(random, 6, 14);
  struct Pigment
  {
    double edge, width, band, bandWidth;
    bool rising, hasBand;
  };
  std::vector<Pigment> palette;
  for (int p = 0; p < pigments; ++p)
  {
    palette.push_back({ uniform(random, 400.0, 720.0), uniform(random, 12.0, 45.0) / sharpness,
      uniform(random, 400.0, 700.0), uniform(random, 25.0, 70.0) / sharpness, chance(random, 0.6),
      chance(random, 0.6) });
  }
  for (int i = 0; i < count; ++i)
  {
    const double neutral = chance(random, 0.12) ? 1.0 : 0.0;
    const int mixed = integer(random, 1, 3);
    std::vector<std::pair<const Pigment*, double>> mix;
    for (int m = 0; m < mixed; ++m)
    {
      mix.emplace_back(&palette[static_cast<std::size_t>(integer(random, 0, pigments - 1))],
        std::exp(uniform(random, -1.5, 1.3)));
    }
    const double black = std::exp(uniform(random, -4.5, 0.5));
    Curve curve(Nanometres);
    for (int j = 0; j < Nanometres; ++j)
    {
      const double nm = FirstNanometre + j;
      const double ground = paper * (1.0 - blueLoss * std::exp(-(nm - 380.0) / 40.0));
      double absorbed = std::pow(1.0 - ground, 2) / (2.0 * ground) + 0.3 * black;
      for (const auto& [pigment, amount] : mix)
      {
        const double z = (nm - pigment->edge) / pigment->width;
        const double edge = 1.0 / (1.0 + std::exp(pigment->rising ? z : -z));
        const double band = pigment->hasBand
          ? std::exp(-std::pow((nm - pigment->band) / pigment->bandWidth, 2))
          : 0.0;
        absorbed += (1.0 - neutral) * amount * (edge + band);
      }
      const double body = 1.0 + absorbed - std::sqrt(absorbed * absorbed + 2.0 * absorbed);
      curve[static_cast<std::size_t>(j)] = deepest + (1.0 - deepest) * body;
    }
    book.reflectance.push_back(std::move(curve));
  }
  return book;
}

const std::vector<SwatchBook>& realSwatches()
{
  static const std::vector<SwatchBook> books = []
  {
    std::vector<SwatchBook> found;
    const char* folder = std::getenv("MULTISPECTRAL_DATA");
    if (folder != nullptr)
    {
      for (const char* name : { "reflectances/colorchecker-sg", "reflectances/clothes",
             "reflectances/paint-chips", "reflectances/ces99", "hkpolyu/paper", "hkpolyu/cotton" })
      {
        const std::string text = name;
        SwatchBook book =
          readBook(std::string(folder) + "/" + name + ".csv", text.substr(text.find('/') + 1));
        if (!book.reflectance.empty())
        {
          found.push_back(std::move(book));
        }
      }
    }
    return found;
  }();
  return books;
}

} // namespace withheld
