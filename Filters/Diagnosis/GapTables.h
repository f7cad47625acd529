// A capture in tables as the diagnosis takes it.
#ifndef GapTables_h
#define GapTables_h

#include "Kernels/Gap/SimToRealGap.h"

class vtkTable;

namespace msi
{

// camera: as CameraTable.h says. samples: R400, .., and where known sample, medium, scene, x, y, order. responses: sample
// and C1, .. (one row a reading); null: the responses stand in the samples' own table, one reading a sample.
// Channels belong together by their order.
// Errors: std::invalid_argument naming the table and what is missing or disagrees.
GapCapture gapCaptureOf(vtkTable* camera, vtkTable* samples, vtkTable* responses);

} // namespace msi

#endif
