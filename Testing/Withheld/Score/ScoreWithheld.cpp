// Scores diagnoses against their keys, sets side by side:
//   ScoreWithheld [--least TABLE] [--picture FILE.svg] [--failures] NAME KEYFILE RESULTFILE [NAME KEYFILE RESULTFILE ...]
// Prints every figure, with --failures every case that went wrong. With a table (set;figure;least) fails where a figure
// is below its least value; --picture: of the first set.
#include "ConfusionPicture.h"
#include "Figures.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <sstream>

namespace
{
using namespace withheld;

struct Column
{
  std::string name;
  std::vector<ScoredCase> cases;
  std::vector<Figure> figures;

  const Figure* find(const std::string& figure) const
  {
    const auto found = std::find_if(
      figures.begin(), figures.end(), [&figure](const Figure& one) { return one.name == figure; });
    return found == figures.end() ? nullptr : &*found;
  }
};

void print(const std::vector<Column>& columns)
{
  std::vector<std::string> names;
  for (const Column& column : columns)
  {
    // A figure that is new here comes after the one before it.
    auto place = names.begin();
    for (const Figure& figure : column.figures)
    {
      const auto found = std::find(names.begin(), names.end(), figure.name);
      place = (found == names.end() ? names.insert(place, figure.name) : found) + 1;
    }
  }
  std::printf("\n%-46s", "figure (cases)");
  for (const Column& column : columns)
  {
    std::printf(" %16s", column.name.c_str());
  }
  std::printf("\n");
  for (const std::string& name : names)
  {
    std::printf("%-46s", name.c_str());
    for (const Column& column : columns)
    {
      const Figure* figure = column.find(name);
      std::ostringstream text;
      text.precision(3);
      if (figure != nullptr)
      {
        text << std::fixed << figure->value << " (" << figure->cases << ')';
      }
      std::printf(" %16s", text.str().c_str());
    }
    std::printf("\n");
  }
  std::printf("%-46s", "seconds: median and slowest");
  for (const Column& column : columns)
  {
    std::vector<double> seconds;
    for (const ScoredCase& one : column.cases)
    {
      seconds.push_back(one.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    std::printf(" %8.2f %7.2f", seconds.empty() ? 0.0 : seconds[seconds.size() / 2],
      seconds.empty() ? 0.0 : seconds.back());
  }
  std::printf("\n");
}

int belowLeast(const std::vector<Column>& columns, const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line))
  {
    throw std::runtime_error(path + ": expected a table set;figure;least; cannot read it");
  }
  int below = 0;
  while (std::getline(file, line))
  {
    const std::size_t first = line.find(';');
    const std::size_t last = line.rfind(';');
    const std::string name = line.substr(first + 1, last - first - 1);
    const double least = std::stod(line.substr(last + 1));
    for (const Column& column : columns)
    {
      const Figure* figure = column.find(name);
      if (column.name == line.substr(0, first) && (figure == nullptr || !(figure->value >= least)))
      {
        std::printf(
          "below its least value %.3g: %s, %s\n", least, column.name.c_str(), name.c_str());
        ++below;
      }
    }
  }
  return below;
}

int score(const std::vector<std::string>& words)
{
  std::string least;
  std::string picture;
  bool failures = false;
  std::vector<Column> columns;
  for (std::size_t w = 0; w < words.size();)
  {
    if (words[w] == "--failures")
    {
      failures = true;
      ++w;
      continue;
    }
    const bool option = words[w] == "--least" || words[w] == "--picture";
    if (w + (option ? 1 : 2) >= words.size())
    {
      throw std::runtime_error(
        "after " + words[w] + ": expected " + (option ? "a file" : "a key file and a result file"));
    }
    if (option)
    {
      (words[w] == "--least" ? least : picture) = words[w + 1];
      w += 2;
      continue;
    }
    Column column{ words[w], readCases(words[w + 1], words[w + 2]), {} };
    column.figures = figuresOf(column.cases);
    columns.push_back(std::move(column));
    w += 3;
  }
  for (const Column& column : columns)
  {
    for (const std::string& line : failures ? failuresOf(column.cases) : std::vector<std::string>{})
    {
      std::cout << column.name << ": " << line << '\n';
    }
  }
  std::cout.flush();
  print(columns);
  if (!picture.empty() && !columns.empty())
  {
    const std::vector<ScoredCase>& cases = columns.front().cases;
    writeConfusionPicture(
      cases, std::to_string(cases.size()) + " withheld cases, those with one effect", picture);
  }
  return least.empty() ? 0 : belowLeast(columns, least);
}
}

int main(int argc, char** argv)
{
  if (argc < 4)
  {
    std::cerr
      << "usage: ScoreWithheld [--least TABLE] [--picture FILE.svg] [--failures] NAME KEYFILE "
         "RESULTFILE ...\n";
    return 2;
  }
  try
  {
    return score({ argv + 1, argv + argc }) == 0 ? 0 : 1;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
