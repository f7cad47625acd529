// For tests: a comma-separated table with one header line.
#pragma once

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

struct TestTable
{
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;

  explicit TestTable(const std::string& path)
  {
    std::ifstream file(path);
    if (!file)
    {
      throw std::runtime_error("cannot read " + path);
    }
    std::string line;
    std::getline(file, line);
    header = split(line);
    while (std::getline(file, line))
    {
      rows.push_back(split(line));
    }
  }

  double number(std::size_t row, const std::string& column) const
  {
    return std::stod(text(row, column));
  }

  const std::string& text(std::size_t row, const std::string& column) const
  {
    const auto found = std::find(header.begin(), header.end(), column);
    return rows.at(row).at(static_cast<std::size_t>(found - header.begin()));
  }

private:
  static std::vector<std::string> split(const std::string& line)
  {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
    {
      cells.push_back(cell);
    }
    return cells;
  }
};
