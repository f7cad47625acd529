// A camera as a vtkTable that a spreadsheet view shows and a CSV file keeps.
//
//   wavelength | C1 | C2 | ...     one row a wavelength (nm, uniform): responsivity, light x filter x detector x step
//
// Field data: Dark (one number a channel), Noise (read, shot; may go on with fixed pattern gain and offset and the
// quantisation step), Effects (the effect list as JSON text), WhiteAfterEffects (0 or 1), WhiteLevel (counts of the
// perfect white). All may be missing.
#ifndef CameraTable_h
#define CameraTable_h

#include "SpectralAxis.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"

#include <optional>
#include <string>

class vtkDataObject;
class vtkTable;

namespace msi
{

struct CameraTable
{
  CameraModel camera;
  std::optional<CameraNoise> noise = std::nullopt;
  std::string effects = {}; // JSON text; empty: none
  bool whiteAfterEffects = false;
  double whiteLevel =
    1.0; // counts of the perfect white; the curves are relative to white whatever it is
};

inline constexpr const char* WhiteLevelArray =
  "WhiteLevel"; // field data, also of simulated responses

// Replaces all columns and field data of the table.
void write(const CameraTable& camera, vtkTable* table);

// Puts the white level into the field data; one of 1 is the default and stays unsaid.
void setWhiteLevel(vtkDataObject* data, double whiteLevel);

// Every column beside `wavelength` is a channel. Rows may come in any order.
// Throws std::invalid_argument naming the column or field array that is missing or does not fit.
CameraTable readCamera(vtkTable* table, const std::string& nameOfTable);

// The channels as columns of a sample table or components of an image: by wavelength where every channel is named by
// one ("C400", "400", "400nm", increasing), else C1, C2, ...
SpectralAxis channelsOf(const CameraModel& camera);

} // namespace msi

#endif
