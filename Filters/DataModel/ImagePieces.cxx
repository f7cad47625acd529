#include "ImagePieces.h"

#include "vtkExtentTranslator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
using SDDP = vtkStreamingDemandDrivenPipeline;

Extent wholeExtent(vtkInformation* input)
{
  Extent whole{};
  input->Get(SDDP::WHOLE_EXTENT(), whole.data());
  return whole;
}

std::string sizeText(const Extent& extent)
{
  std::ostringstream text;
  text << extent[1] - extent[0] + 1 << " x " << extent[3] - extent[2] + 1;
  if (extent[5] != extent[4])
  {
    text << " x " << extent[5] - extent[4] + 1;
  }
  return text.str();
}

constexpr Extent NoPixels = { 0, -1, 0, -1, 0, -1 };

bool isEmpty(const Extent& extent)
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

// As the executive splits an image.
Extent extentOfPiece(vtkInformation* information, int ghosts)
{
  Extent whole = wholeExtent(information);
  Extent extent = whole;
  const int mode = information->Has(vtkExtentTranslator::UPDATE_SPLIT_MODE())
    ? information->Get(vtkExtentTranslator::UPDATE_SPLIT_MODE())
    : static_cast<int>(vtkExtentTranslator::BLOCK_MODE);
  vtkNew<vtkExtentTranslator> translator;
  const int any = translator->PieceToExtentThreadSafe(information->Get(SDDP::UPDATE_PIECE_NUMBER()),
    information->Get(SDDP::UPDATE_NUMBER_OF_PIECES()), ghosts, whole.data(), extent.data(), mode,
    0);
  return any ? extent : NoPixels;
}

Extent requested(vtkInformation* output, int ghosts)
{
  if (output->Get(SDDP::UPDATE_NUMBER_OF_PIECES()) > 1)
  {
    return extentOfPiece(output, ghosts);
  }
  if (!output->Has(SDDP::UPDATE_EXTENT()))
  {
    return wholeExtent(output);
  }
  Extent extent{};
  output->Get(SDDP::UPDATE_EXTENT(), extent.data());
  return isEmpty(extent) ? NoPixels : extent;
}
}

void requireSameSize(vtkInformation* a, const std::string& nameOfA, vtkInformation* b,
  const std::string& nameOfB, const std::string& remedy)
{
  if (!a || !b || !a->Has(SDDP::WHOLE_EXTENT()) || !b->Has(SDDP::WHOLE_EXTENT()))
  {
    return;
  }
  const std::string sizes[] = { sizeText(wholeExtent(a)), sizeText(wholeExtent(b)) };
  if (sizes[0] != sizes[1])
  {
    throw std::invalid_argument(nameOfA + " has " + sizes[0] + " pixels, but " + nameOfB + " has " +
      sizes[1] + "; " + remedy);
  }
}

Extent ownedExtent(vtkInformation* input, vtkImageData* image)
{
  const Extent whole = wholeExtent(input);
  Extent owned = whole;
  if (input->Get(SDDP::UPDATE_NUMBER_OF_PIECES()) > 1)
  {
    owned = extentOfPiece(input, 0);
    if (isEmpty(owned))
    {
      return owned;
    }
  }
  const int* held = image->GetExtent();
  for (std::size_t axis = 0; axis < 6; axis += 2)
  {
    if (owned[axis + 1] < whole[axis + 1])
    {
      --owned[axis + 1];
    }
    owned[axis] = std::max(owned[axis], held[axis]);
    owned[axis + 1] = std::min(owned[axis + 1], held[axis + 1]);
  }
  return owned;
}

Extent requestedExtent(vtkInformation* output)
{
  return requested(output, output->Get(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS()));
}

Extent requestedExtentWithoutGhosts(vtkInformation* output)
{
  return requested(output, 0);
}

Extent grown(const Extent& extent, int margin, const Extent& whole)
{
  Extent larger = extent;
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    larger[2 * axis] = std::max(whole[2 * axis], extent[2 * axis] - margin);
    larger[2 * axis + 1] = std::min(whole[2 * axis + 1], extent[2 * axis + 1] + margin);
  }
  return larger;
}

bool contains(const Extent& outer, const Extent& inner)
{
  return outer[0] <= inner[0] && outer[1] >= inner[1] && outer[2] <= inner[2] &&
    outer[3] >= inner[3];
}

void requestWithMargin(vtkInformation* input, vtkInformation* output, int margin)
{
  if (output->Get(SDDP::UPDATE_NUMBER_OF_PIECES()) > 1)
  {
    // The source cuts its piece itself; ghosts are the margin.
    input->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(),
      output->Get(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS()) + margin);
    return;
  }
  const Extent extent = grown(requestedExtent(output), margin, wholeExtent(input));
  input->Set(SDDP::UPDATE_EXTENT(), extent.data(), 6);
}

} // namespace msi
