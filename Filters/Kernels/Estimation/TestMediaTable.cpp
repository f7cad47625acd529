#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/MethodComparison.h"

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>

namespace
{

struct Expected
{
  double mean;
  double standardError; // of the mean over 20 draws
};

struct MediaCase
{
  std::string calibration;
  std::string target;
  int channels;
  double transferLimit;
  std::map<std::string, Expected> expected;
};

void PrintTo(const MediaCase& media, std::ostream* out)
{
  *out << media.calibration << " to " << media.target << ", " << media.channels << " channels";
}

constexpr double Rounding = 0.00005; // of the table's last digit

std::optional<msi::SampleSet> realMedium(const std::string& medium, int channels)
{
  auto samples = msi::test::realSamples("hkpolyu/" + medium + ".csv");
  if (samples && channels == 9)
  {
    const std::vector<Eigen::Index> nine{ 0, 2, 4, 6, 8, 10, 12, 14, 15 };
    samples->response = Eigen::MatrixXd(samples->response(nine, Eigen::all));
  }
  return samples;
}

// Real measurements on two media, published with Sensors 2023, 23(2), 689; the expected means come
// from a separate NumPy program with random draws of its own.
class MediaTable : public testing::TestWithParam<MediaCase>
{
};

TEST_P(MediaTable, AgreesWithTheSeparateProgram)
{
  const MediaCase& media = GetParam();
  const auto calibration = realMedium(media.calibration, media.channels);
  const auto target = realMedium(media.target, media.channels);
  if (!calibration)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  msi::ComparisonOptions options;
  options.methods.clear();
  for (const auto& [method, expected] : media.expected)
  {
    options.methods.push_back(method);
  }
  const msi::MethodComparison comparison(*calibration, *target, options);
  constexpr int draws = 40;
  std::vector<double> means(options.methods.size(), 0.0);
  for (int draw = 0; draw < draws; ++draw)
  {
    const auto result = comparison.run(static_cast<std::uint64_t>(draw));
    for (std::size_t m = 0; m < means.size(); ++m)
    {
      means[m] += result.estimates[m].rms.mean() / draws;
    }
  }
  for (std::size_t m = 0; m < means.size(); ++m)
  {
    const Expected& expected = media.expected.at(options.methods[m]);
    const double tolerance = options.methods[m] == "direct"
      ? 0.01 * expected.mean
      : 3.0 * expected.standardError + Rounding;
    EXPECT_NEAR(means[m], expected.mean, tolerance) << options.methods[m];
    RecordProperty(options.methods[m], std::to_string(means[m]));
  }
}

// The project's own method on the same data: better than those of the source in the same draws, and
// with 16 channels better than calibrating on 100 samples of the medium itself (0.0054 on cotton, by a
// separate NumPy program); its intervals of 90 % hold about what they promise.
TEST_P(MediaTable, TransferIsBetterThanAllOfThem)
{
  const MediaCase& media = GetParam();
  const auto calibration = realMedium(media.calibration, media.channels);
  const auto target = realMedium(media.target, media.channels);
  if (!calibration)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  msi::ComparisonOptions options;
  options.methods = { "direct", "pinv", "pooled", "r-model", "banded", "transfer" };
  const msi::MethodComparison comparison(*calibration, *target, options);
  constexpr int draws = 8;
  std::map<std::string, double> means;
  double inside = 0.0;
  for (int draw = 0; draw < draws; ++draw)
  {
    const auto result = comparison.run(static_cast<std::uint64_t>(draw));
    for (const msi::MethodEstimate& estimate : result.estimates)
    {
      means[estimate.method] += estimate.rms.mean() / draws;
    }
    const msi::MethodEstimate& transfer = result.estimates.back();
    const Eigen::MatrixXd measured = target->subset(result.heldOut).reflectance;
    const Eigen::ArrayXXd z =
      (transfer.reflectance - measured).array() / transfer.standardDeviation.array();
    inside += (z.abs() < 1.6449).cast<double>().mean() / draws;
  }
  const double transfer = means.at("transfer");
  for (const auto& [method, mean] : means)
  {
    if (method != "transfer")
    {
      EXPECT_LT(transfer, 0.85 * mean) << method;
    }
  }
  EXPECT_LT(transfer, media.transferLimit);
  // .90 +- .03 and two standard errors of the mean over 8 draws, which scatter by .055.
  EXPECT_GT(inside, 0.83);
  EXPECT_LT(inside, 0.97);
  RecordProperty("transfer", std::to_string(transfer));
  RecordProperty("coverage", std::to_string(inside));
}

INSTANTIATE_TEST_SUITE_P(Real, MediaTable,
  testing::Values(MediaCase{ "paper", "cotton", 16, 0.0054,
                    { { "direct", { 0.0086, 0.0 } }, { "pinv", { 0.069, 0.026 } },
                      { "pooled", { 0.0069, 0.0001 } }, { "r-model", { 0.0084, 0.0003 } },
                      { "banded", { 0.0082, 0.0005 } } } },
    MediaCase{ "paper", "cotton", 9, 0.0077,
      { { "direct", { 0.0119, 0.0 } }, { "pinv", { 0.0139, 0.0009 } },
        { "pooled", { 0.0102, 0.0001 } }, { "r-model", { 0.0103, 0.0003 } },
        { "banded", { 0.0093, 0.0002 } } } },
    MediaCase{ "cotton", "paper", 16, 0.0054,
      { { "direct", { 0.0096, 0.0 } }, { "pinv", { 0.054, 0.015 } },
        { "pooled", { 0.0072, 0.0001 } }, { "r-model", { 0.0087, 0.0003 } },
        { "banded", { 0.0085, 0.0004 } } } },
    MediaCase{ "cotton", "paper", 9, 0.0090,
      { { "direct", { 0.0147, 0.0 } }, { "pinv", { 0.0197, 0.0012 } },
        { "pooled", { 0.0131, 0.0001 } }, { "r-model", { 0.0124, 0.0002 } },
        { "banded", { 0.0116, 0.0001 } } } }),
  [](const auto& media)
  {
    return media.param.calibration + "To" + media.param.target +
      std::to_string(media.param.channels);
  });

}
