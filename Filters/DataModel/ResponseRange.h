// Whether an image's responses are such as the samples had that a transform was fitted on.
#ifndef ResponseRange_h
#define ResponseRange_h

#include "SpectralAxis.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkInformation;
class vtkMultiProcessController;
class vtkTable;

namespace msi
{

// Per channel: the least and the largest response of the samples. It travels with the transform as field data; a
// transform from a file has none.
using ResponseRange = Eigen::ArrayX2d;
void writeResponseRange(vtkTable* transform, const std::vector<Eigen::MatrixXd>& responses);
std::optional<ResponseRange> readResponseRange(vtkTable* transform, Eigen::Index channels);

// What is wrong with the responses of a whole image, with the numbers; empty texts where nothing is.
struct ResponseJudgement
{
  std::string error;   // no estimate of it means anything
  std::string warning; // the estimates are doubtful
  // Share of the pixels with responses outside of the range by more than a tenth of it; below 0 where it is not known.
  double outside = -1.0;
  // Share of the pixels with a response that is not finite.
  double missing = 0.0;
};

// Looks at about 65536 pixels, evenly spread over the whole image: the same ones for any number of ranks. input: the
// information of the input port that the image came through. controller: of the ranks that have the other pieces, null
// where this one has the image whole; then collective, with the same judgement on every rank. responses is null where the
// rank's piece is empty. trusted: responses that look like raw counts are a warning, no error.
ResponseJudgement judgeResponses(vtkInformation* input, vtkImageData* image,
  vtkDataArray* responses, const SpectralAxis& channels, const std::optional<ResponseRange>& range,
  bool trusted, vtkMultiProcessController* controller);

// How far a pixel's responses lie outside of the range: the largest excess of a channel, in units of that channel's range.
// 0 within the range, NaN where a response is NaN.
double excessOverRange(
  const Eigen::Ref<const Eigen::ArrayXd>& responses, const ResponseRange& range) noexcept;

// True where the image is not a piece of a larger one: what is true of all its pixels is true of the image.
bool isWhole(vtkInformation* information, vtkImageData* image);

} // namespace msi

#endif
