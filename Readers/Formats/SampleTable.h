// Measured samples: who they are, their reflectance, and what a camera answered.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// A column that is neither reflectance nor response: sample, medium, scene, x, y, order, label, or
// any other. The text of the file is kept as it is.
struct MetadataColumn
{
  std::string name;
  std::vector<std::string> text; // one per sample

  // One per sample, NaN for an empty cell; empty when any cell is no number or all cells are empty.
  std::vector<double> numbers() const;
};

// One sample a column of the matrices. Either of reflectance and responses may be absent (0 x 0).
struct SampleTable
{
  std::vector<MetadataColumn> metadata; // in the order of the file

  std::optional<WavelengthGrid> wavelengths; // N values, where there is reflectance
  Eigen::MatrixXd reflectance;               // N x L, reflectance factor (1 = perfect white)

  std::vector<std::string> channelNames;            // K names
  std::optional<WavelengthGrid> channelWavelengths; // K values, where the names tell them
  Eigen::MatrixXd responses;                        // K x L (1 = perfect white)

  // What was recognized and done, for the user to see: "reflectance was in percent: divided by 100".
  std::vector<std::string> notes;

  Eigen::Index sampleCount() const noexcept;
  bool hasReflectance() const noexcept { return reflectance.size() > 0; }
  bool hasResponses() const noexcept { return responses.size() > 0; }

  // The metadata column of that name (upper and lower case alike), or null.
  const MetadataColumn* findMetadata(const std::string& name) const;
  // The column "sample", or "1", "2", ... where the file names no samples.
  std::vector<std::string> sampleNames() const;
};

enum class ReflectanceUnit
{
  Recognize, // percent when more than half of the samples exceed 2 somewhere; see Formats.md
  Factor,    // 1 = perfect white
  Percent    // 100 = perfect white
};

struct SampleTableOptions
{
  ReflectanceUnit unit = ReflectanceUnit::Recognize;
  // For matrices without a header (text or MAT): the wavelengths of the reflectance. They decide
  // which way the matrix lies. Not given: 400..700 nm in steps of 10.
  std::optional<WavelengthGrid> wavelengths;
  // For matrices without a header: the file with the responses of the same samples, if any.
  std::string responseFile;
  // For MAT files: the names of the variables. Not given: found by their shapes.
  std::string reflectanceVariable;
  std::string responseVariable;
};

// Reads a sample table. The format is found from the content, not from the name: CSV (comma, semicolon
// with decimal comma, tab or blanks), CGATS, CxF3, MAT, or matrices without a header.
//
// Columns named R400, 400, 400nm, SPEC_400, SPECTRAL_NM400, SPECTRAL_NM_400, nm400, R_400.5 (upper and
// lower case alike, any order) are reflectance, sorted by wavelength. C and a number is a camera
// response: a wavelength when every such number is 200 or more, else an index.
// Errors: FormatError naming file, line and column.
SampleTable readSampleTable(const std::string& path, const SampleTableOptions& options = {});

// Writes CSV that readSampleTable gives back to the last bit (shortest decimals that round-trip).
// The file is complete or absent.
// Errors: FormatError; std::invalid_argument when the parts of the table disagree in sample count.
void writeSampleTableCsv(const std::string& path, const SampleTable& table);

// Writes CGATS.17 with SAMPLE_ID, the metadata and SPECTRAL_NM fields, reflectance as a factor.
// Responses become C fields. The file is complete or absent. Errors as for CSV.
void writeSampleTableCgats(const std::string& path, const SampleTable& table);

} // namespace msi
