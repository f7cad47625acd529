#include "Kernels/Sampling/ChartLayout.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
bool isLetter(char c)
{
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool isDigit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

// Letters before numbers of one length, as spreadsheets count: A, .., Z, AA.
std::optional<std::pair<std::pair<std::size_t, std::string>, int>> cellOf(const std::string& name)
{
  constexpr std::ptrdiff_t MostLetters = 2;
  constexpr std::ptrdiff_t MostDigits = 3;
  const auto split = std::find_if_not(name.begin(), name.end(), isLetter);
  const auto letters = split - name.begin();
  const auto digits = name.end() - split;
  if (letters < 1 || letters > MostLetters || digits < 1 || digits > MostDigits ||
    !std::all_of(split, name.end(), isDigit))
  {
    return std::nullopt;
  }
  std::string text(name.begin(), split);
  std::transform(text.begin(), text.end(), text.begin(),
    [](char c) { return static_cast<char>(std::toupper(static_cast<unsigned char>(c))); });
  return { { { text.size(), text }, std::stoi(std::string(split, name.end())) } };
}

template <typename Key>
std::map<Key, int> places(const std::set<Key>& keys)
{
  std::map<Key, int> result;
  int place = 0;
  for (const auto& key : keys)
  {
    result[key] = place++;
  }
  return result;
}
}

std::vector<int> patchNumbers(const std::vector<std::string>& names, int columns, int rows)
{
  const auto patches = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  if (columns < 1 || rows < 1 || names.size() != patches)
  {
    throw std::invalid_argument("the reference lists " + std::to_string(names.size()) +
      " samples; a chart of " + std::to_string(columns) + " x " + std::to_string(rows) +
      " patches has " + std::to_string(patches));
  }
  std::vector<int> numbers(names.size());
  std::iota(numbers.begin(), numbers.end(), 1);
  std::set<std::pair<std::size_t, std::string>> letters;
  std::set<int> digits;
  for (const auto& name : names)
  {
    const auto cell = cellOf(name);
    if (!cell)
    {
      return numbers;
    }
    letters.insert(cell->first);
    digits.insert(cell->second);
  }
  const auto width = static_cast<std::size_t>(columns);
  const auto height = static_cast<std::size_t>(rows);
  const bool lettersAreColumns = letters.size() == width && digits.size() == height;
  const bool lettersAreRows = letters.size() == height && digits.size() == width;
  if (!lettersAreColumns && !lettersAreRows)
  {
    return numbers;
  }
  const auto letterPlace = places(letters);
  const auto digitPlace = places(digits);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto cell = cellOf(names[i]);
    const int letter = letterPlace.at(cell->first);
    const int digit = digitPlace.at(cell->second);
    numbers[i] = lettersAreColumns ? 1 + letter + columns * digit : 1 + digit + columns * letter;
  }
  return std::set<int>(numbers.begin(), numbers.end()).size() == numbers.size()
    ? numbers
    : patchNumbers(std::vector<std::string>(patches), columns, rows);
}

} // namespace msi
