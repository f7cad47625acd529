#include "ImageBlocks.h"

#include "AlgorithmSupport.h"

#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>

namespace msi
{

namespace
{
using SDDP = vtkStreamingDemandDrivenPipeline;

int componentsOf(vtkInformation* input)
{
  constexpr int Unknown = 16;
  auto* scalars = vtkDataObject::GetActiveFieldInformation(
    input, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const bool known = scalars && scalars->Has(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS());
  return known ? std::max(1, scalars->Get(vtkDataObject::FIELD_NUMBER_OF_COMPONENTS())) : Unknown;
}
}

bool ImageBlocks::request(vtkInformationVector** inputs, std::initializer_list<int> ports)
{
  const bool fresh = !GoesOn;
  GoesOn = false;
  if (fresh)
  {
    start(inputs[*ports.begin()]->GetInformationObject(0));
  }
  Extent asked = Block;
  if (isEmpty())
  {
    // One row all the same: what lies upstream may need every rank.
    asked[2] = asked[3] = Whole[3];
  }
  for (const int port : ports)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      auto* info = inputs[port]->GetInformationObject(i);
      info->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
      info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(SDDP::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      info->Set(SDDP::UPDATE_EXTENT(), asked.data(), 6);
    }
  }
  return fresh;
}

void ImageBlocks::start(vtkInformation* input)
{
  input->Get(SDDP::WHOLE_EXTENT(), Whole.data());
  if (LastWanted >= FirstWanted)
  {
    Whole[2] = std::clamp(FirstWanted, Whole[2], Whole[3]);
    Whole[3] = std::clamp(LastWanted, Whole[2], Whole[3]);
  }
  auto* controller = controllerOfTables();
  const long long ranks = controller ? controller->GetNumberOfProcesses() : 1;
  const long long rank = controller ? controller->GetLocalProcessId() : 0;
  const long long height = Whole[3] - Whole[2] + 1;
  // From the top down, as files are read; the first rank has rows wherever there are any.
  const auto before = [&](long long r)
  { return static_cast<int>((height * r + ranks - 1) / ranks); };
  Last = Whole[3] - before(rank);
  First = Whole[3] + 1 - before(rank + 1);
  const long long rowBytes =
    4LL * (Whole[1] - Whole[0] + 1) * (Whole[5] - Whole[4] + 1) * componentsOf(input);
  Rows =
    static_cast<int>(std::clamp(BlockBytes / std::max(1LL, rowBytes), 1LL, std::max(1LL, height)));
  Pass = 0;
  startPass();
}

void ImageBlocks::startPass()
{
  Block = Whole;
  Block[3] = Last;
  Block[2] = std::max(First, Last - Rows + 1);
}

double ImageBlocks::progress() const noexcept
{
  return isEmpty()
    ? 1.0
    : static_cast<double>(Last - Block[2] + 1) / static_cast<double>(Last - First + 1);
}

bool ImageBlocks::next(vtkInformation* request, int passes)
{
  if (!isEmpty() && Block[2] > First)
  {
    Block[3] = Block[2] - 1;
    Block[2] = std::max(First, Block[3] - Rows + 1);
    GoesOn = true;
  }
  else if (Pass + 1 < passes)
  {
    ++Pass;
    startPass();
    GoesOn = true;
  }
  if (!GoesOn)
  {
    stop(request);
    return false;
  }
  request->Set(SDDP::CONTINUE_EXECUTING(), 1);
  return true;
}

void ImageBlocks::stop(vtkInformation* request)
{
  GoesOn = false;
  request->Remove(SDDP::CONTINUE_EXECUTING());
}

vtkSmartPointer<vtkImageData> partOf(vtkImageData* image, const Extent& block)
{
  if (!image || std::equal(block.begin(), block.end(), image->GetExtent()))
  {
    return image;
  }
  // By rows: vtkImageData::Crop copies value by value.
  const int* held = image->GetExtent();
  Extent common{};
  for (std::size_t axis = 0; axis < 6; axis += 2)
  {
    common[axis] = std::max(held[axis], block[axis]);
    common[axis + 1] = std::min(held[axis + 1], block[axis + 1]);
  }
  const vtkIdType width = std::max(0, common[1] - common[0] + 1);
  vtkNew<vtkPointData> points;
  points->CopyAllOn();
  points->CopyAllocate(image->GetPointData(),
    width * std::max(0, common[3] - common[2] + 1) * std::max(0, common[5] - common[4] + 1));
  vtkIdType to = 0;
  for (int z = common[4]; z <= common[5]; ++z)
  {
    for (int y = common[2]; y <= common[3]; ++y, to += width)
    {
      int first[] = { common[0], y, z };
      points->CopyData(image->GetPointData(), to, width, image->ComputePointId(first));
    }
  }
  auto part = vtkSmartPointer<vtkImageData>::New();
  part->ShallowCopy(image);
  part->SetExtent(common.data());
  part->GetPointData()->ShallowCopy(points);
  return part;
}

Extent commonExtent(std::initializer_list<vtkImageData*> images)
{
  Extent common{};
  bool first = true;
  for (auto* image : images)
  {
    if (!image)
    {
      continue;
    }
    const int* held = image->GetExtent();
    for (std::size_t axis = 0; axis < 6; axis += 2)
    {
      common[axis] = first ? held[axis] : std::max(common[axis], held[axis]);
      common[axis + 1] = first ? held[axis + 1] : std::min(common[axis + 1], held[axis + 1]);
    }
    first = false;
  }
  return common;
}

} // namespace msi
