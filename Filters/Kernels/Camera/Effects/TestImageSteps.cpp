#include "Kernels/Camera/ImageTerm.h"
#include "Kernels/Numerics/Angle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace
{
struct Answer
{
  double signal;
  double slope;
  std::vector<double> by;
};

// A pixel off the middle, with light from everywhere.
Answer answerOf(const msi::ImageStep& step, const std::vector<double>& numbers, double signal)
{
  const std::array<double, msi::TailPasses> surround{ 0.5, 0.45, 0.4, 0.42, 0.38, 0.35 };
  std::array<double, msi::TailPasses> weights{};
  if (step.tail != nullptr)
  {
    step.tail(numbers.data(), weights.data());
  }
  const double previous = 0.3;
  const double next = 0.7;
  msi::ImagePixel pixel;
  pixel.x = 0.6;
  pixel.y = -0.4;
  pixel.surround = surround.data();
  pixel.tailWeights = weights.data();
  pixel.mean = 0.33;
  pixel.elsewhere = 0.8;
  pixel.channel = 0.4;
  pixel.self = 0.55;
  pixel.previous = &previous;
  pixel.next = &next;
  pixel.row = { 0.3, -0.7, 0.02, 0.03 };
  pixel.column = { -0.4, 0.8, -0.05, 0.01 };
  Answer answer{ signal, 0.0, std::vector<double>(step.width(), 0.0) };
  answer.slope = step.apply(numbers.data(), pixel, answer.signal, answer.by.data());
  return answer;
}

double derivativeBy(const msi::ImageStep& step, const std::vector<double>& numbers, std::size_t n)
{
  const Answer answer = answerOf(step, numbers, 0.55);
  std::vector<double> parts(step.width(), 0.0);
  if (step.change == nullptr)
  {
    parts[n] = 1.0;
  }
  else
  {
    step.change(static_cast<int>(n), numbers.data(), numbers.data(), parts.data());
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    sum += parts[i] * answer.by[i];
  }
  return sum;
}

// Away from neutral by a few hundredths, every number by another.
std::vector<double> someNumbers(const msi::ImageStep& step)
{
  std::vector<double> numbers;
  for (const msi::ImageNumber& number : step.numbers)
  {
    const double more = 0.03 + 0.01 * static_cast<double>(numbers.size());
    // A level of clipping near the signal.
    numbers.push_back(number.pull == msi::ImagePull::Found ? 0.57 : number.neutral + more);
  }
  return numbers;
}
}

// Against central differences. The weights of the tail are single precision.
TEST(ImageSteps, DerivativesAreThoseOfTheAnswer)
{
  constexpr double Step = 1e-5;
  for (const msi::PlacedStep& placed : msi::imageSteps())
  {
    const msi::ImageStep& step = *placed.step;
    if (step.stage == msi::ImageStage::Scene)
    {
      continue; // the scene comes moved and blurred
    }
    const std::vector<double> numbers = someNumbers(step);
    for (std::size_t n = 0; n < numbers.size(); ++n)
    {
      std::vector<double> above = numbers;
      std::vector<double> below = numbers;
      above[n] += Step;
      below[n] -= Step;
      const double expected =
        (answerOf(step, above, 0.55).signal - answerOf(step, below, 0.55).signal) / (2.0 * Step);
      EXPECT_NEAR(derivativeBy(step, numbers, n), expected, 1e-4 * std::fabs(expected) + 2e-6)
        << "stage " << static_cast<int>(step.stage) << ", number " << n;
    }
    const double slope =
      (answerOf(step, numbers, 0.55 + Step).signal - answerOf(step, numbers, 0.55 - Step).signal) /
      (2.0 * Step);
    EXPECT_NEAR(answerOf(step, numbers, 0.55).slope, slope, 1e-6) << static_cast<int>(step.stage);
  }
}

TEST(ImageSteps, NeutralChangesNothing)
{
  for (const msi::PlacedStep& placed : msi::imageSteps())
  {
    std::vector<double> numbers;
    for (const msi::ImageNumber& number : placed.step->numbers)
    {
      numbers.push_back(number.neutral);
    }
    EXPECT_EQ(answerOf(*placed.step, numbers, 0.55).signal, 0.55)
      << static_cast<int>(placed.step->stage);
  }
}

// About another center and along a slope that is to be, where there is none yet.
TEST(ImageSteps, WhatHasNoEffectYetStartsElsewhere)
{
  const std::size_t falloff = msi::imageParameter("vignetting", "falloff");
  const msi::PlacedStep& lens = msi::stepOf(falloff);
  const std::vector<double> neutral(lens.step->numbers.size(), 0.0);
  std::vector<double> about = neutral;
  about[msi::imageParameter("vignetting", "center_x") - lens.number] = 0.2;
  about[msi::imageParameter("vignetting", "center_y") - lens.number] = -0.1;
  std::vector<double> parts(lens.step->width(), 0.0);
  lens.step->change(
    static_cast<int>(falloff - lens.number), neutral.data(), about.data(), parts.data());
  const Answer answer = answerOf(*lens.step, neutral, 0.55);
  double sum = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    sum += parts[i] * answer.by[i];
  }
  EXPECT_NEAR(sum, -0.55 * (0.4 * 0.4 + 0.3 * 0.3), 1e-12);

  const std::size_t square = msi::imageParameter("illumination_gradient", "square");
  const msi::PlacedStep& slope = msi::stepOf(square);
  const std::vector<double> flat(slope.step->numbers.size(), 0.0);
  std::vector<double> turned = flat;
  turned[msi::imageParameter("illumination_gradient", "turn") - slope.number] =
    std::atan2(0.8, 0.6) / msi::Degree;
  parts.assign(slope.step->width(), 0.0);
  slope.step->change(
    static_cast<int>(square - slope.number), flat.data(), turned.data(), parts.data());
  const Answer shaded = answerOf(*slope.step, flat, 0.55);
  sum = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    sum += parts[i] * shaded.by[i];
  }
  EXPECT_NEAR(sum, 0.55 * std::pow(0.6 * 0.6 - 0.8 * 0.4, 2), 1e-12);
}
