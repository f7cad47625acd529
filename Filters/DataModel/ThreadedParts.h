// Work that is split into parts and spread over the SMP threads.
#ifndef ThreadedParts_h
#define ThreadedParts_h

#include "vtkType.h"

#include <functional>

class vtkAlgorithm;

namespace msi
{

// Calls work(part) once for every part in [0, parts). Each SMP thread takes the next part as soon as it has done
// one, so that none waits for another before the last. Where the work throws, no new part is started, and the
// exception of the first of the parts that failed goes to the caller, whatever the number of threads.
void forParts(vtkIdType parts, const std::function<void(vtkIdType)>& work);

// The same with the algorithm's progress, from 'progress' to 1, and the chance to abort: both are for the calling
// thread. Throws std::runtime_error when aborted.
void forParts(vtkAlgorithm* algorithm, vtkIdType parts, const std::function<void(vtkIdType)>& work,
  double progress = 0.0);

} // namespace msi

#endif
