// Fewer samples of a large capture, so that a diagnosis takes minutes and not hours.
#ifndef SampleSpread_h
#define SampleSpread_h

#include "GapTables.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// At most 'most' of the samples that have a reflectance and a reading, increasing: in each medium of each scene, in
// proportion to its size, evenly spread over the samples sorted by their mean reflectance. At least one of each group
// as long as there are no more groups than 'most'. The same for the same capture.
std::vector<Eigen::Index> spreadSamples(const GapCapture& capture, Eigen::Index most);

// The capture with these samples and their readings alone.
GapCapture capturedSubset(const GapCapture& from, const std::vector<Eigen::Index>& samples);

} // namespace msi

#endif
