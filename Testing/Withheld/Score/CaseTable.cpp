#include "CaseTable.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace withheld
{

namespace
{
using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, char separator)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    parts.push_back(part);
  }
  return parts;
}

// std::stod refuses numbers too small for their exponent.
double toNumber(const std::string& text)
{
  return std::strtod(text.c_str(), nullptr);
}

std::vector<Row> readRows(const std::string& path)
{
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line))
  {
    throw std::runtime_error(path + ": expected a table with a header; cannot read it");
  }
  const std::vector<std::string> header = split(line, ',');
  std::vector<Row> rows;
  while (std::getline(file, line))
  {
    const std::vector<std::string> cells = split(line, ',');
    Row row;
    for (std::size_t c = 0; c < header.size(); ++c)
    {
      row[header[c]] = c < cells.size() ? cells[c] : std::string();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

double number(const Row& row, const std::string& column)
{
  const std::string& cell = row.at(column);
  return cell.empty() ? 0.0 : toNumber(cell);
}

std::vector<NamedCause> causesOf(const std::string& cell)
{
  std::vector<NamedCause> causes;
  for (const std::string& part : split(cell, ';'))
  {
    const std::vector<std::string> fields = split(part, ':');
    causes.push_back({ fields.at(0), toNumber(fields.at(1)), split(fields.at(2), '|'),
      fields.size() > 3 ? fields[3] : std::string() });
  }
  return causes;
}
}

std::vector<ScoredCase> readCases(const std::string& keyFile, const std::string& resultFile)
{
  std::map<std::string, Row> results;
  for (Row& row : readRows(resultFile))
  {
    const std::string name = row.at("case");
    results.emplace(name, std::move(row));
  }
  std::vector<ScoredCase> cases;
  for (const Row& key : readRows(keyFile))
  {
    ScoredCase one;
    one.name = key.at("case");
    const auto found = results.find(one.name);
    if (found == results.end())
    {
      throw std::runtime_error(resultFile + ": expected a row for " + one.name + "; it has none");
    }
    one.set = key.at("set");
    one.planted = split(key.at("effects"), ';');
    one.kinds = split(key.at("kinds"), ';');
    one.axes = split(key.at("axes"), ';');
    one.gapRms = number(key, "gap_rms");
    one.bestShrink = number(key, "best_shrink");
    one.without = key.at("without");
    one.twin = key.at("twin");
    const Row& result = found->second;
    one.verdict = result.at("verdict");
    one.axis = result.at("axis");
    one.causes = causesOf(result.at("causes"));
    one.shrink = number(result, "shrink");
    one.unexplained = number(result, "unexplained");
    for (const std::string& part : split(result.at("probabilities"), ';'))
    {
      const std::size_t colon = part.find(':');
      one.probabilities[part.substr(0, colon)] = toNumber(part.substr(colon + 1));
    }
    one.seconds = number(result, "seconds");
    cases.push_back(std::move(one));
  }
  return cases;
}

} // namespace withheld
