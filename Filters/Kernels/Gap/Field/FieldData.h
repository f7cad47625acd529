// An image pair made ready for fitting: blocks of usable pixels, the tail of their surround, folds.
#pragma once

#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace msi
{

// The simulated image without gaps: gaps take the values at both sides in their row. Empty where there
// are none.
std::vector<float> filledScene(const FieldPair& pair);

// The simulated image in 64 x 64 cells: what each adds to the mean of the scene and the place of its light, cells x K.
// A smooth factor of the field may be taken at that place.
struct SceneCells
{
  SceneCells() = default;
  explicit SceneCells(const FieldPair& pair);
  // The mean over the scene of the simulated signal behind gradient and vignetting, K.
  Eigen::ArrayXd mean(const FieldModel& model) const;

private:
  Eigen::ArrayXXd Part, X, Y;
};

inline constexpr int FieldFolds = 5;

// Runs body(0) .. body(count - 1), in any order, on threads of the caller's.
using FieldLoop = std::function<void(int count, const std::function<void(int)>& body)>;

// From the middle of the image to that of a window, in pixels.
inline Eigen::Vector2d middleOf(const FieldPair& pair, const ImageWindow& window)
{
  return { pair.offX(window.x + 0.5 * (window.width - 1)),
    pair.offY(window.y + 0.5 * (window.height - 1)) };
}

struct FieldBlock
{
  ImageWindow window;
  int fold = -1; // 0 .. FieldFolds - 1; -1: a test block that takes no part in choosing and fitting
  int group = 0; // dealBlocks
  std::vector<float> real; // pixel after pixel; NaN: not usable
  // Of each value the passes 1 .. TailPasses of the broad tail (ScatterTail).
  std::vector<double> tail;

  ImagePlace place(int pixel) const noexcept
  {
    return { window.x + pixel % window.width, window.y + pixel / window.width };
  }
};

struct FieldData
{
  FieldPair pair;            // withoutFrame()
  std::vector<float> filled; // filledScene()
  Eigen::ArrayXd unit;       // of the real image's channels, K; FieldBlock::real is divided by it
  std::vector<FieldBlock> blocks;
  std::vector<ImageWindow> leftOut; // blocks, and single pixels of others
  std::vector<Eigen::Index> dead;   // channels, without usable values
  double usablePart = 0.0;          // of the image's pixels
  double defectPart = 0.0;          // of the blocks' values: leaveOutDefects()
  SceneCells cells;
  FieldLoop loop;

  Eigen::Index channels() const noexcept { return pair.channels.size(); }
  // The simulated image without gaps.
  const float* scene() const noexcept { return filled.empty() ? pair.simulated : filled.data(); }
  // Runs body() for the number of every block.
  void forBlocks(const std::function<void(int)>& body) const
  {
    loop(static_cast<int>(blocks.size()), body);
  }
};

// Every pixel that is finite in both images, whose neighbours to two pixels are finite in the simulated one and
// that lies a little inside the image. At most 208 blocks (from 9 channels on fewer, down to 104) of 16 x 16 pixels, drawn at
// random; small images give blocks of 8 or 4 pixels, and from 24 channels on there are none larger than 8.
// Two thirds are for training, in FieldFolds folds, whole groups (dealBlocks) in one of them.
// The tail needs the surround: images of more than 2 million pixels are looked at in nine windows of at most
// 512 x 512 pixels, spread over the field, so that the cost is bounded.
// Errors: std::invalid_argument for an empty image, no channel, or too few usable pixels.
// Holds pointers to the images of the pair.
FieldData prepareFieldData(const FieldPair& pair, std::uint64_t seed, FieldLoop loop);

// Draws at most `most` blocks and deals them to folds and test, whole groups at a time: what errs in one block (a material whose
// color is simulated wrongly) errs in its neighbours, too, and may not vouch for itself.
// A group is a label or, without labels or where a label covers much, one of about 96 cells of the image.
void dealBlocks(
  const FieldPair& pair, std::vector<FieldBlock>& blocks, std::size_t most, std::uint64_t seed);

// Sums of the blocks' numbers over groups: of the training blocks, or of the test blocks.
Eigen::ArrayXd groupSums(const FieldData& data, const Eigen::VectorXd& ofBlock, bool training);

} // namespace msi
