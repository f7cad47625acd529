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
  Extent whole = wholeExtent(input);
  Extent owned = whole;
  const int pieces = input->Get(SDDP::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    // As the executive splits it, without ghosts.
    const int mode = input->Has(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      ? input->Get(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      : static_cast<int>(vtkExtentTranslator::BLOCK_MODE);
    vtkNew<vtkExtentTranslator> translator;
    if (!translator->PieceToExtentThreadSafe(
          input->Get(SDDP::UPDATE_PIECE_NUMBER()), pieces, 0, whole.data(), owned.data(), mode, 0))
    {
      return { 0, -1, 0, -1, 0, -1 };
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

} // namespace msi
