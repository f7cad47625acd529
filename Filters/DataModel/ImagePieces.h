// Images whose pixels are spread over pieces and ranks.
#ifndef ImagePieces_h
#define ImagePieces_h

#include <array>
#include <string>

class vtkImageData;
class vtkInformation;

namespace msi
{

// Two image inputs have the same size. For RequestInformation: a request for pixels that one of them
// does not have is then never made. Throws std::invalid_argument naming both sizes, then 'remedy'.
void requireSameSize(vtkInformation* a, const std::string& nameOfA, vtkInformation* b,
  const std::string& nameOfB, const std::string& remedy);

// An extent as VTK counts it: x, y, z, each first and last index.
using Extent = std::array<int, 6>;

// The pixels of a piece that no other piece has. Neighbouring pieces of an image share a layer of points;
// whatever is counted over all pieces counts such a layer once, in the piece that starts with it.
// 'input' is the information of the input port that the image came through.
Extent ownedExtent(vtkInformation* input, vtkImageData* image);

// The pixels that are asked for of an output: of its piece with its ghosts, or of its extent where it is one piece.
// Empty (first index above last) where the piece has none.
Extent requestedExtent(vtkInformation* output);

// The same without the ghosts.
Extent requestedExtentWithoutGhosts(vtkInformation* output);

// The extent with a margin of pixels in x and y, cut at the whole image.
Extent grown(const Extent& extent, int margin, const Extent& whole);
bool contains(const Extent& outer, const Extent& inner);

// Asks an input for the pixels that are asked for of an output, and a margin around them. For RequestUpdateExtent.
void requestWithMargin(vtkInformation* input, vtkInformation* output, int margin);

} // namespace msi

#endif
