// Sample tables between the file formats and VTK.
#ifndef SampleTableConversion_h
#define SampleTableConversion_h

#include "Formats/SampleTable.h"

class vtkTable;

namespace msi
{

// Metadata columns first (numbers where every cell is one), then R400.., C400.. .
void toVTK(const SampleTable& samples, vtkTable* table);

// The way back. Estimates (E400, ..) and uncertainties (U400, ..) become metadata columns.
// Throws std::invalid_argument where a spectral column is not numeric.
SampleTable fromVTK(vtkTable* table);

} // namespace msi

#endif
