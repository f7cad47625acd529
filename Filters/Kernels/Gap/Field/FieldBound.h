// What a solution of the normal equations is held to.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"

#include <vector>

namespace msi
{

// A term with the value that is wanted (prior or hold), channel by channel.
struct FieldFitter::Bound
{
  ImageTerm term;
  Eigen::ArrayXd wanted;
  std::vector<char> held;
};

} // namespace msi
