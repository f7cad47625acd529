#include "ImagePieces.h"

#include "Support/vtk/ErrorText.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace
{
using namespace msi;
using SDDP = vtkStreamingDemandDrivenPipeline;

void setWhole(vtkInformation* info, int width, int height, int depth = 1)
{
  const int whole[] = { 0, width - 1, 0, height - 1, 0, depth - 1 };
  info->Set(SDDP::WHOLE_EXTENT(), whole, 6);
}

// How often each pixel is owned, over all pieces; every piece holds the whole image.
std::vector<int> owners(int width, int height, int pieces)
{
  std::vector<int> count(static_cast<std::size_t>(width * height), 0);
  for (int piece = 0; piece < pieces; ++piece)
  {
    vtkNew<vtkInformation> info;
    setWhole(info, width, height);
    info->Set(SDDP::UPDATE_PIECE_NUMBER(), piece);
    info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), pieces);
    vtkNew<vtkImageData> image;
    image->SetDimensions(width, height, 1);
    const auto owned = ownedExtent(info, image);
    for (int y = owned[2]; y <= owned[3]; ++y)
    {
      for (int x = owned[0]; x <= owned[1]; ++x)
      {
        ++count[static_cast<std::size_t>(y * width + x)];
      }
    }
  }
  return count;
}

TEST(ImagePieces, OwnEveryPixelOnce)
{
  for (const int pieces : { 1, 2, 3, 4, 7, 16 })
  {
    for (const auto& [width, height] :
      { std::pair(6, 4), std::pair(13, 5), std::pair(3, 40), std::pair(1, 9) })
    {
      const auto count = owners(width, height, pieces);
      EXPECT_TRUE(std::all_of(count.begin(), count.end(), [](int times) { return times == 1; }))
        << width << " x " << height << " in " << pieces << " pieces";
    }
  }
}

TEST(ImagePieces, OwnNothingWherePixelsAreFewerThanPieces)
{
  const auto count = owners(2, 1, 5);
  EXPECT_EQ(count[0], 1);
  EXPECT_EQ(count[1], 1);
}

TEST(ImagePieces, OwnNoMoreThanTheyHold)
{
  vtkNew<vtkInformation> info;
  setWhole(info, 10, 10);
  info->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  info->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  vtkNew<vtkImageData> image;
  image->SetExtent(2, 5, 3, 9, 0, 0);
  EXPECT_EQ(ownedExtent(info, image), (Extent{ 2, 5, 3, 9, 0, 0 }));
}

std::string sizeError(vtkInformation* a, vtkInformation* b)
{
  return msi::testing::argumentError(
    [&] { requireSameSize(a, "the white image", b, "the raw image", "crop one"); });
}

TEST(ImagePieces, NameSizesThatDiffer)
{
  vtkNew<vtkInformation> a;
  vtkNew<vtkInformation> b;
  setWhole(a, 4, 3);
  setWhole(b, 4, 3);
  EXPECT_EQ(sizeError(a, b), "");
  setWhole(b, 3, 4);
  EXPECT_EQ(
    sizeError(a, b), "the white image has 4 x 3 pixels, but the raw image has 3 x 4; crop one");
  setWhole(b, 4, 3, 2);
  EXPECT_EQ(
    sizeError(a, b), "the white image has 4 x 3 pixels, but the raw image has 4 x 3 x 2; crop one");
}

TEST(ImagePieces, HaveNoSizeWhereNothingIsConnected)
{
  vtkNew<vtkInformation> image;
  setWhole(image, 4, 3);
  vtkNew<vtkInformation> table;
  EXPECT_EQ(sizeError(nullptr, image), "");
  EXPECT_EQ(sizeError(image, table), "");
}
}
