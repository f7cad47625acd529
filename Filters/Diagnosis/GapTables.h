// A capture in tables as the diagnosis takes it.
#ifndef GapTables_h
#define GapTables_h

#include "Kernels/Gap/SimToRealGap.h"

#include <string>
#include <vector>

class vtkTable;

namespace msi
{

struct NamedGapCapture
{
  GapCapture capture;
  std::vector<std::string> sampleNames; // of the samples, in their order
};

// camera: as CameraTable.h says. samples: R400, .., and where known sample, medium, scene, x, y, order. responses: sample
// and C1, .. (one row a reading); null: the responses stand in the samples' own table, one reading a sample.
// Channels belong together by their order.
// Errors: std::invalid_argument naming the table and what is missing or disagrees.
NamedGapCapture gapCaptureOf(vtkTable* camera, vtkTable* samples, vtkTable* responses);

} // namespace msi

#endif
