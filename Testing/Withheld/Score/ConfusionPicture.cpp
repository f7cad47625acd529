#include "ConfusionPicture.h"

#include "Figures.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>

namespace withheld
{

namespace
{
constexpr double Cell = 26.0;
constexpr double Margin = 190.0;
constexpr double Head = 60.0;
constexpr const char* Nothing = "nothing";
constexpr const char* Unknown = "unknown";

std::string rowOf(const ScoredCase& one)
{
  if (one.planted.empty())
  {
    return Nothing;
  }
  return one.set == "stranger" || one.set == "removed" ? Unknown : one.planted.front();
}

std::string columnOf(const ScoredCase& one)
{
  if (one.causes.empty() || one.causes.front().share < AccusedShare)
  {
    const bool none = one.causes.empty() && one.verdict == "no gap";
    const bool unknown = one.causes.empty() || rowOf(one) == Unknown;
    if (none || unknown)
    {
      return none ? Nothing : Unknown;
    }
  }
  return one.causes.front().effect;
}
}

void writeConfusionPicture(
  const std::vector<ScoredCase>& cases, const std::string& title, const std::string& path)
{
  std::vector<std::string> names;
  std::map<std::pair<std::string, std::string>, int> count;
  std::map<std::string, int> rowSum;
  const auto know = [&names](const std::string& name)
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  };
  for (const ScoredCase& one : cases)
  {
    if (one.planted.size() < 2)
    {
      ++count[{ rowOf(one), columnOf(one) }];
      ++rowSum[rowOf(one)];
      if (rowOf(one) != Nothing && rowOf(one) != Unknown)
      {
        know(rowOf(one));
      }
    }
  }
  for (const auto& [pair, number] : count)
  {
    if (pair.second != Nothing && pair.second != Unknown)
    {
      know(pair.second);
    }
  }
  know(Nothing);
  know(Unknown);

  const double side = Cell * static_cast<double>(names.size());
  std::ofstream svg(path);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << Margin + side + 70.0
      << "\" height=\"" << Head + side + Margin
      << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"" << Margin
      << "\" y=\"24\" font-size=\"15\">" << title << "</text>\n<text x=\"" << Margin
      << "\" y=\"44\">rows: planted; columns: first cause of the diagnosis</text>\n";
  for (std::size_t r = 0; r < names.size(); ++r)
  {
    const double y = Head + Cell * static_cast<double>(r);
    svg << "<text text-anchor=\"end\" x=\"" << Margin - 8.0 << "\" y=\"" << y + 17.0 << "\">"
        << names[r] << "</text>\n";
    for (std::size_t c = 0; c < names.size(); ++c)
    {
      const double x = Margin + Cell * static_cast<double>(c);
      const auto found = count.find({ names[r], names[c] });
      const int number = found == count.end() ? 0 : found->second;
      const double part = number == 0 ? 0.0 : static_cast<double>(number) / rowSum[names[r]];
      const int light = 255 - static_cast<int>(std::lround(200.0 * part));
      const int other = number == 0 ? 248 : light;
      svg << "<rect x=\"" << x << "\" y=\"" << y << "\" width=\"" << Cell - 1.0 << "\" height=\""
          << Cell - 1.0 << "\" fill=\"rgb(" << (r == c ? other : (number == 0 ? 248 : 255)) << ','
          << other << ',' << (r == c && number > 0 ? 255 : other) << ")\"/>\n";
      if (number > 0)
      {
        svg << "<text text-anchor=\"middle\" x=\"" << x + 0.5 * Cell << "\" y=\"" << y + 17.0
            << "\" fill=\"" << (part > 0.6 ? "white" : "black") << "\">" << number << "</text>\n";
      }
    }
  }
  for (std::size_t c = 0; c < names.size(); ++c)
  {
    const double x = Margin + Cell * (static_cast<double>(c) + 0.4);
    svg << "<text transform=\"translate(" << x << ',' << Head + side + 12.0 << ") rotate(60)\">"
        << names[c] << "</text>\n";
  }
  svg << "</svg>\n";
  if (!svg.flush())
  {
    throw std::runtime_error("cannot write " + path);
  }
}

} // namespace withheld
