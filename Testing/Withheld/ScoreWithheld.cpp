// Scores a diagnosis against the key: ScoreWithheld KEYFILE RESULTFILE [PICTURE.svg] [LOWEST]
// Prints every figure beside its bar and every case that went wrong. With LOWEST (a table figure;lowest) fails where
// a figure is below its lowest value.
#include "ConfusionPicture.h"
#include "Figures.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>

namespace
{
using namespace withheld;

int belowLowest(const std::vector<Figure>& figures, const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line))
  {
    std::cerr << path << ": expected a table figure;lowest; cannot read it\n";
    return 1;
  }
  int below = 0;
  while (std::getline(file, line))
  {
    const std::size_t end = line.rfind(';');
    const std::string name = line.substr(0, end);
    const double lowest = std::stod(line.substr(end + 1));
    const auto figure = std::find_if(
      figures.begin(), figures.end(), [&name](const Figure& one) { return one.name == name; });
    if (figure == figures.end() || !(figure->value >= lowest))
    {
      std::cerr << "below its lowest value " << lowest << ": " << name << '\n';
      ++below;
    }
  }
  return below;
}

int score(int argc, char** argv)
{
  const std::vector<ScoredCase> cases = readCases(argv[1], argv[2]);
  for (const std::string& line : failuresOf(cases))
  {
    std::cout << line << '\n';
  }
  const std::vector<Figure> figures = figuresOf(cases);
  std::printf("\n%-48s %7s %6s %6s\n", "figure", "value", "bar", "cases");
  for (const Figure& figure : figures)
  {
    std::printf("%-48s %7.3f ", figure.name.c_str(), figure.value);
    if (figure.bar > 0.0)
    {
      std::printf(
        "%6.2f %6d %s\n", figure.bar, figure.cases, figure.value >= figure.bar ? "" : "missed");
    }
    else
    {
      std::printf("%6s %6d\n", "", figure.cases);
    }
  }
  double slowest = 0.0;
  for (const ScoredCase& one : cases)
  {
    slowest = std::max(slowest, one.seconds);
  }
  std::printf("slowest case %.1f s\n", slowest);
  if (argc > 3)
  {
    writeConfusionPicture(
      cases, std::to_string(cases.size()) + " withheld cases, those with one effect", argv[3]);
  }
  return argc > 4 ? belowLowest(figures, argv[4]) : 0;
}
}

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: ScoreWithheld KEYFILE RESULTFILE [PICTURE.svg] [LOWEST]\n";
    return 2;
  }
  try
  {
    return score(argc, argv) == 0 ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
