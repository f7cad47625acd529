#include "Kernels/Numerics/OrderStatistic.h"

#include <Eigen/Core>

#include <gtest/gtest.h>

namespace
{
using msi::orderStatistic;
}

TEST(OrderStatistic, OfAListAndOfAnArray)
{
  const std::vector<double> list{ 4.0, -1.0, 7.0, 4.0, 2.0 };
  EXPECT_EQ(orderStatistic(list, 0), -1.0);
  EXPECT_EQ(orderStatistic(list, 2), 4.0);
  EXPECT_EQ(orderStatistic(list, 3), 4.0);
  EXPECT_EQ(orderStatistic(list, 4), 7.0);
  const Eigen::ArrayXd array = Eigen::Map<const Eigen::ArrayXd>(list.data(), 5);
  EXPECT_EQ(orderStatistic(-array, 0), -7.0);
}

TEST(OrderStatistic, OfAnEvenNumberTheLargerMiddle)
{
  EXPECT_EQ(orderStatistic(std::vector<double>{ 3.0, 1.0, 2.0, 4.0 }, 2), 3.0);
  EXPECT_EQ(orderStatistic(std::vector<double>{ 5.0 }, 0), 5.0);
}
