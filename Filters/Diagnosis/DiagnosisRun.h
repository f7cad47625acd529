// One diagnosis beside the pipeline's thread, which shows progress and can be stopped.
#ifndef DiagnosisRun_h
#define DiagnosisRun_h

#include "Kernels/Gap/Field/FieldGap.h"
#include "Kernels/Gap/SimToRealGap.h"

class vtkAlgorithm;

namespace msi
{

// Runs diagnoseGap (or diagnoseField) with the SMP threads. Progress events come from the calling thread alone, because observers may
// be Python's. options.progress, parallelFor and exclusive are set here.
// Errors: those of the diagnosis; std::runtime_error when the algorithm was asked to stop.
GapReport runDiagnosis(vtkAlgorithm* algorithm, const GapCapture& capture, GapOptions options);
FieldGap runDiagnosis(vtkAlgorithm* algorithm, const FieldPair& pair, GapOptions options);

} // namespace msi

#endif
