#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/NormalMatrix.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{

using namespace msi::test;

// The plain product of all rows, for effects that keep to their channel and for one that reaches the neighbours.
TEST(NormalMatrix, IsThePlainProduct)
{
  const msi::GapData data = dataOf(captureWith({}));
  for (const char* name : { "dark_offset", "channel_crosstalk" })
  {
    msi::EffectSet set;
    for (const auto& [effect, form] : { std::pair<const char*, const char*>{ name, "" },
           { "channel_gain", "per_channel" }, { "filter_shift", "per_channel" } })
    {
      msi::EffectChoice choice;
      choice.effect = msi::findEffect(effect);
      choice.form = msi::findForm(*choice.effect, form);
      set.add(choice, data.camera);
    }
    const auto free = set.freeParameters(data.camera);
    const Eigen::MatrixXd columns =
      msi::jacobian(*msi::stagedResponse(data.camera, data.scene, set), set, free);
    std::vector<Eigen::Index> samples(40);
    std::iota(samples.begin(), samples.end(), 20);
    Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(data.channels(), data.samples());
    weight.middleCols(20, 40) = data.weight.middleCols(20, 40);
    const Eigen::Map<const Eigen::VectorXd> flat(weight.data(), weight.size());
    const Eigen::MatrixXd expected = columns.transpose() * flat.asDiagonal() * columns;
    const Eigen::MatrixXd found =
      msi::normalMatrix(columns, data.weight.array(), free, set.reach(), samples);
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.cwiseAbs().maxCoeff())
      << name;
  }
}

}
