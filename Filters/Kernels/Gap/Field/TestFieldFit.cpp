#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/Field/TestFieldReport.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace
{
using namespace msi;
using namespace msi::test;

const FieldChoice& choiceOf(
  const std::vector<FieldChoice>& choices, const std::string& effect, std::size_t terms)
{
  for (const FieldChoice& choice : choices)
  {
    if (choice.effect->name == effect && choice.terms.size() == terms)
    {
      return choice;
    }
  }
  throw std::out_of_range(effect);
}
}

// A falloff about a center of its own and a gradient that bends are nearly the same: linear steps lead far away.
TEST(FieldFit, TheEnergyToldIsThatOfTheModelReached)
{
  const FieldLoop loop = [](int count, const std::function<void(int)>& body)
  {
    for (int i = 0; i < count; ++i)
    {
      body(i);
    }
  };
  const std::vector<FieldChoice> choices = fieldChoices({});
  const FieldSet set{ &choiceOf(choices, "vignetting", 3),
    &choiceOf(choices, "illumination_gradient", 3) };
  for (std::uint64_t seed = 61; seed < 65; ++seed)
  {
    const TestScene scene(seed);
    const TestPair pair = changed(scene, seed,
      [&](double u, int, int x, int y, double)
      { return u * (1.0 + 0.05 * scene.fieldX(x) - 0.03 * scene.fieldY(y)); });
    const FieldPair images = pair.pair();
    const FieldData data = prepareFieldData(images, seed, loop);
    FieldModel start(data.channels());
    const FieldWeights weights = fieldWeights(fieldStatistics(data, start, nullptr, loop));
    start[imageParameter("vignetting", "falloff")].setConstant(-0.2);
    start[imageParameter("vignetting", "center_x")].setConstant(0.9);
    start[imageParameter("vignetting", "center_y")].setConstant(-0.6);
    const FieldHypothesis found = refitted(data, weights, set, start, loop);
    const double reached =
      FieldFitter(data, fieldStatistics(data, found.fit.next, &weights, loop)).energy();
    EXPECT_LT(reached, 1.02 * found.fit.energy) << "seed " << seed;
    EXPECT_LT(FieldFitter(data, *found.statistics).energy(), 1.02 * found.fit.energy)
      << "seed " << seed;
  }
}
