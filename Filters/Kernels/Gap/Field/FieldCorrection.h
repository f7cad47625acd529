// The simulated image with the effects that were found.
#pragma once

#include "Kernels/Camera/Imaging/ChannelRegistration.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"
#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace msi
{

// Memory of a thread.
struct CorrectionWorkspace
{
  PixelBuffer signal, scratch, tail;
  std::vector<double> light, others; // of one pixel
};

// Runs the model on the simulated image window by window, with the operators of ImageSimulator and in its order.
// NaN where the simulated image has NaN. The calls may run on several threads at once.
class FieldCorrection
{
public:
  FieldCorrection(const FieldPair& pair, const FieldModel& model);

  // corrected: K values for each pixel of the window.
  void operator()(
    const ImageWindow& window, float* corrected, CorrectionWorkspace& workspace) const;

private:
  FieldPair Pair;
  FieldModel Model;
  Eigen::ArrayXd Glare;
  std::vector<float> Filled;
  std::optional<ChannelRegistration> Registration;
  std::optional<SymmetricKernel> Blur;
  std::vector<std::array<double, TailPasses>> Tail; // weights of the passes, of each channel
  int Passes = 0;                                   // that have a weight
};

} // namespace msi
