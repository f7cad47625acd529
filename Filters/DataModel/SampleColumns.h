// Spectra in the columns of a vtkTable: one sample a row, one wavelength or channel a column.
//
// A column is named by a letter and a wavelength in nm (or, for camera channels, a number):
//   R400  measured reflectance factor (1 = perfect white)
//   C400  camera response (1 = perfect white); C1, C2, ... where wavelengths are not known
//   E400  estimated reflectance factor
//   U400  standard uncertainty of the estimate (one standard deviation)
// All other columns are metadata (sample, medium, scene, x, y, order, label, ...) and pass through.
#ifndef SampleColumns_h
#define SampleColumns_h

#include "SpectralAxis.h"

#include "Kernels/Estimation/SampleSet.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

class vtkTable;

namespace msi
{

// Of tables whose rows are wavelengths.
inline constexpr const char* WavelengthColumn = "wavelength";
// A camera channel numbered below this is an index, from it on a wavelength in nm.
inline constexpr double FirstWavelength = 100.0;

enum class SampleQuantity : char
{
  Reflectance = 'R',
  Response = 'C',
  Estimate = 'E',
  Uncertainty = 'U'
};

struct SampleSpectra
{
  SpectralAxis axis;
  Eigen::MatrixXd values;           // axis.size() x rows
  std::vector<std::string> columns; // the columns they came from, in the axis' order
};

// The columns of one quantity, ordered by wavelength; empty where the table has none.
// Throws std::invalid_argument for a column that is not numeric or stands twice.
std::optional<SampleSpectra> findSpectra(vtkTable* table, SampleQuantity quantity);

// The same, but a table without such columns is an error that names them and the table.
SampleSpectra requireSpectra(
  vtkTable* table, SampleQuantity quantity, const std::string& nameOfTable);

// Adds (or replaces) one column per component. values: axis.size() x rows.
void setSpectra(vtkTable* table, SampleQuantity quantity, const SpectralAxis& axis,
  const Eigen::Ref<const Eigen::MatrixXd>& values);

// Adds (or replaces) one column of numbers.
void setNumbers(
  vtkTable* table, const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& values);

// A table's reflectance and response together, as the estimation kernels take them.
struct MeasuredSamples
{
  std::string table; // by which name it is called
  SpectralAxis bands;
  SpectralAxis channels;
  SampleSet samples;
  std::vector<std::string> names; // of the samples
  Eigen::ArrayXd x, y;            // columns "x" and "y"; empty without one of them
};
// Throws std::invalid_argument for values that no instrument gives (Kernels/Spectra/PossibleValues.h) and responses that never change;
// values may be not finite.
MeasuredSamples readSamples(vtkTable* table, const std::string& nameOfTable);
// And for those.
MeasuredSamples requireMeasuredSamples(vtkTable* table, const std::string& nameOfTable);

// Throws std::invalid_argument where channels or bands differ, or the responses of one table are counts and those of the other
// relative to white.
void requireAlike(const MeasuredSamples& a, const MeasuredSamples& b);

// What is doubted of those with finite values, as warnings (Kernels/Doubts/SampleDoubts.h). medium: may be null.
std::vector<std::string> doubtsOf(
  const MeasuredSamples& chart, const MeasuredSamples* medium = nullptr);

// The column "sample" as text; without it the rows' numbers, from 1, after some text.
std::vector<std::string> sampleNames(vtkTable* table, const std::string& beforeNumber = "");

// Copies the chosen rows, all columns, in the given order.
void copyRows(vtkTable* from, const std::vector<Eigen::Index>& rows, vtkTable* to);

} // namespace msi

#endif
