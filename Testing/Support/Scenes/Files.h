// Plain writers for the generated data: CSV, one-channel TIFF, grey PNG.
#pragma once

#include "Kernels/Scenes/PatchLayout.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace msi::scenes
{

// A sample table: text columns first, then blocks of numbers (one row of `values` a column of the file).
struct TextColumn
{
  std::string name;
  std::vector<std::string> cells;
};
struct NumberColumns
{
  std::vector<std::string> names;
  Eigen::MatrixXd values; // columns of the file x samples
  int digits;             // after the point
};
void writeTable(const std::filesystem::path& file, const std::vector<TextColumn>& text,
  const std::vector<NumberColumns>& numbers);

// "R400", "R410", ... for a prefix "R".
std::vector<std::string> wavelengthNames(const std::string& prefix, const WavelengthGrid& grid);

using CountImage = Eigen::Array<std::uint16_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
void writeTiff(const std::filesystem::path& file, const CountImage& image);
void writePng(const std::filesystem::path& file, const LabelImage& image);

} // namespace msi::scenes
