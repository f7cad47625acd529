// Colors in SIMD vectors: loads, stores and a cube root, for the block kernels. Included once for
// each instruction set by Highway's foreach_target.h.
//
// All arithmetic is in double, by additions, multiplications, divisions and square roots alone, each
// of which IEEE 754 rounds in one way: every instruction set gives the same bytes. So no MulAdd here.
#if defined(MULTISPECTRAL_COLOR_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MULTISPECTRAL_COLOR_VECTORS_INL_H
#undef MULTISPECTRAL_COLOR_VECTORS_INL_H
#else
#define MULTISPECTRAL_COLOR_VECTORS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Floats = hn::Rebind<float, Doubles>;
using Vector = hn::Vec<Doubles>;
using Mask = hn::Mask<Doubles>;

constexpr std::size_t MostLanes = hn::MaxLanes(Doubles());

inline Vector set(double value)
{
  return hn::Set(Doubles(), value);
}

inline Vector square(Vector x)
{
  return hn::Mul(x, x);
}

// Coefficients from the highest power down.
template <std::size_t Count>
inline Vector polynomial(Vector x, const std::array<double, Count>& coefficients)
{
  Vector result = set(coefficients[0]);
  for (std::size_t i = 1; i < Count; ++i)
  {
    result = hn::Add(hn::Mul(result, x), set(coefficients[i]));
  }
  return result;
}

// One color a lane.
struct Colors
{
  Vector first;
  Vector second;
  Vector third;
};

inline Colors loadColors(const double* from)
{
  Colors colors;
  hn::LoadInterleaved3(Doubles(), from, colors.first, colors.second, colors.third);
  return colors;
}

inline Colors loadColors(const float* from)
{
  hn::Vec<Floats> first;
  hn::Vec<Floats> second;
  hn::Vec<Floats> third;
  hn::LoadInterleaved3(Floats(), from, first, second, third);
  return { hn::PromoteTo(Doubles(), first), hn::PromoteTo(Doubles(), second),
    hn::PromoteTo(Doubles(), third) };
}

inline void storeColors(const Colors& colors, double* to)
{
  hn::StoreInterleaved3(colors.first, colors.second, colors.third, Doubles(), to);
}

inline void storeColors(const Colors& colors, float* to)
{
  hn::StoreInterleaved3(hn::DemoteTo(Floats(), colors.first), hn::DemoteTo(Floats(), colors.second),
    hn::DemoteTo(Floats(), colors.third), Floats(), to);
}

inline void storeValues(Vector values, double* to)
{
  hn::StoreU(values, Doubles(), to);
}

inline void storeValues(Vector values, float* to)
{
  hn::StoreU(hn::DemoteTo(Floats(), values), Floats(), to);
}

// One step of Halley's method towards the cube root; the error is cubed.
template <typename AnyVector>
inline AnyVector refineCubeRoot(AnyVector root, AnyVector of)
{
  const AnyVector cube = hn::Mul(hn::Mul(root, root), root);
  const AnyVector up = hn::Add(cube, hn::Add(of, of));
  const AnyVector down = hn::Add(hn::Add(cube, cube), of);
  return hn::Mul(root, hn::Div(up, down));
}

// The cube root of x within 1e-30..1e30 to two units in the last place; of anything else, anything.
// A guess from the exponent, off by 4 %, two steps in float and one in double.
inline Vector cubeRoot(Vector x)
{
  const Floats floats;
  const hn::RebindToSigned<Floats> integers;
  const auto coarse = hn::DemoteTo(floats, x);
  const auto exponent = hn::ConvertTo(floats, hn::BitCast(integers, coarse));
  const auto third =
    hn::Add(hn::Mul(exponent, hn::Set(floats, 1.0F / 3.0F)), hn::Set(floats, 709958130.0F));
  auto root = hn::BitCast(floats, hn::ConvertTo(integers, third));
  root = refineCubeRoot(root, coarse);
  root = refineCubeRoot(root, coarse);
  return refineCubeRoot(hn::PromoteTo(Doubles(), root), x);
}

// Runs kernel(in, out) on groups of MostLanes colors; the last group is padded.
template <typename Scalar, typename Kernel>
inline void forEachGroup(const Scalar* in, Scalar* out, std::size_t count, Kernel& kernel)
{
  const std::size_t lanes = hn::Lanes(Doubles());
  std::size_t first = 0;
  for (; first + lanes <= count; first += lanes)
  {
    storeColors(kernel(loadColors(in + 3 * first), lanes), out + 3 * first);
  }
  if (first < count)
  {
    std::array<Scalar, 3 * MostLanes> group{};
    const std::size_t rest = count - first;
    std::copy_n(in + 3 * first, 3 * rest, group.begin());
    storeColors(kernel(loadColors(group.data()), rest), group.data());
    std::copy_n(group.begin(), 3 * rest, out + 3 * first);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#endif
