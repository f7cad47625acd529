// Where the image of each channel lies beside that of a reference channel, found from the image itself.
#pragma once

#include "Kernels/Camera/Imaging/ChannelRegistration.h"
#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

enum class DisplacementModel
{
  Shift,     // right and down
  Similarity // also magnification and rotation
};

// The image of a channel is that of the reference, turned, magnified and moved as ChannelRegistration says.
struct ChannelDisplacement
{
  double right = 0.0;         // pixels
  double down = 0.0;          // pixels, towards higher rows
  double magnification = 0.0; // relative growth
  double rotation = 0.0;      // degrees, from right to down
  // Of the four, in their units; zero for the reference, infinite where the image does not tell.
  Eigen::Array4d standardError = Eigen::Array4d::Zero();
  // Share of the reference's variance within windows that an affine function of the channel explains.
  double agreement = 1.0;
};

// Finds the displacements that let the channel explain the reference best: in each window of 12 x 12 pixels the
// reference is an affine function of the channel, with coefficients of its own, so that contrasts may differ
// from window to window and be reversed. Least squares over all windows, weighted by what each leaves unexplained; coarse to fine.
//
// Source: Gauss-Newton steps of the displacement with the affine coefficients eliminated (Kaufman, BIT 15 (1975) 49,
//         doi:10.1007/BF01932995), on a pyramid of binomial filters (Burt and Adelson, 1983,
//         doi:10.1109/TCOM.1983.1095851). The local affine relation is that of local cross-correlation.
// Errors: standard errors from the scatter of the windows' contributions (White, Econometrica 48 (1980) 817).
// Range:  up to about a twelfth of the smallest side of the tiles, at most 12 pixels.
// NaN:    windows that hold one do not take part.
// Cost:   some 400 ns a pixel of the tiles and channel.
class DisplacementSearch
{
public:
  static constexpr int LeastTileSide = 32; // pixels

  // Tiles are rectangles of the image of that extent, all with the same channels. Throws std::invalid_argument where
  // there is none, or where one is smaller than LeastTileSide.
  DisplacementSearch(
    const std::vector<PixelBuffer>& tiles, const ImageExtent& extent, DisplacementModel model);

  // Channels counted from 0.
  ChannelDisplacement operator()(int reference, int channel) const;

private:
  const std::vector<PixelBuffer>& Tiles;
  ImageExtent Extent;
  DisplacementModel Model;
};

// Of a channel beside a reference, where a third channel lies between: `first` of that beside the reference, `second` of the
// channel beside it. Errors add as squares, the agreement is the lower one.
ChannelDisplacement composed(const ChannelDisplacement& first, const ChannelDisplacement& second);

// How much a channel, counted from 0, varies within windows, relative to its mean: the one that varies most is a good
// reference.
double structureOf(const std::vector<PixelBuffer>& tiles, int channel);

// At most tilesPerSide^2 squares spread evenly over an image; one tile, the whole image, where they would cover it.
std::vector<ImageWindow> displacementTiles(const ImageExtent& extent);

// Moves every channel back to where the reference is.
ChannelRegistration undoing(
  const std::vector<ChannelDisplacement>& displacements, const ImageExtent& extent);

// The registered pixels of a channel that are read from within the image, not from its repeated edge.
class ShownPixels
{
public:
  ShownPixels(const ChannelDisplacement& displacement, const ImageExtent& extent) noexcept;
  bool contain(int x, int y) const noexcept;

private:
  ImageExtent Extent;
  double MiddleX, MiddleY;
  double Right, Down;
  double Cosine, Sine; // times the magnification
};

} // namespace msi
