#include "SampleSpread.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

namespace msi
{

namespace
{
template <typename T>
std::vector<T> chosenOf(const std::vector<T>& values, const std::vector<Eigen::Index>& rows)
{
  std::vector<T> result;
  if (!values.empty())
  {
    for (const auto row : rows)
    {
      result.push_back(values[static_cast<std::size_t>(row)]);
    }
  }
  return result;
}

Eigen::VectorXd chosenOf(const Eigen::VectorXd& values, const std::vector<Eigen::Index>& rows)
{
  return values.size() > 0 ? Eigen::VectorXd(values(rows)) : Eigen::VectorXd();
}

std::vector<char> usableSamples(const GapCapture& capture)
{
  const auto samples = static_cast<std::size_t>(capture.samples.reflectance.cols());
  std::vector<char> usable(samples, 0);
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    const auto sample = static_cast<std::size_t>(capture.sampleOf[static_cast<std::size_t>(j)]);
    if (capture.readings.col(j).array().isFinite().any())
    {
      usable[sample] = 1;
    }
  }
  for (std::size_t i = 0; i < samples; ++i)
  {
    if (!capture.samples.reflectance.col(static_cast<Eigen::Index>(i)).allFinite())
    {
      usable[i] = 0;
    }
  }
  return usable;
}
}

std::vector<Eigen::Index> spreadSamples(const GapCapture& capture, Eigen::Index most)
{
  const SceneSamples& samples = capture.samples;
  const auto usable = usableSamples(capture);
  std::map<std::pair<std::string, std::string>, std::vector<Eigen::Index>> groups;
  for (std::size_t i = 0; i < usable.size(); ++i)
  {
    if (usable[i] != 0)
    {
      groups[{ samples.medium.empty() ? std::string() : samples.medium[i],
               samples.scene.empty() ? std::string() : samples.scene[i] }]
        .push_back(static_cast<Eigen::Index>(i));
    }
  }
  const Eigen::RowVectorXd level = samples.reflectance.colwise().mean();
  // One list, group after group and in each by level; every so manieth of it is taken.
  std::vector<Eigen::Index> all;
  std::vector<std::size_t> begins;
  for (auto& [name, group] : groups)
  {
    std::stable_sort(group.begin(), group.end(),
      [&level](Eigen::Index a, Eigen::Index b) { return level[a] < level[b]; });
    begins.push_back(all.size());
    all.insert(all.end(), group.begin(), group.end());
  }
  const auto count = static_cast<std::size_t>(most);
  if (all.size() <= count)
  {
    std::sort(all.begin(), all.end());
    return all;
  }
  std::vector<char> taken(all.size(), 0);
  std::size_t chosen = 0;
  const auto take = [&](std::size_t at)
  {
    chosen += taken[at] == 0 ? 1 : 0;
    taken[at] = 1;
  };
  if (begins.size() <= count)
  {
    for (std::size_t g = 0; g < begins.size(); ++g)
    {
      const std::size_t end = g + 1 < begins.size() ? begins[g + 1] : all.size();
      take(begins[g] + (end - begins[g]) / 2);
    }
  }
  const std::size_t rest = count - chosen;
  for (std::size_t i = 0; i < rest; ++i)
  {
    std::size_t at = (2 * i + 1) * all.size() / (2 * rest);
    while (taken[at] != 0)
    {
      at = (at + 1) % all.size();
    }
    take(at);
  }
  std::vector<Eigen::Index> result;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (taken[i] != 0)
    {
      result.push_back(all[i]);
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

GapCapture capturedSubset(const GapCapture& from, const std::vector<Eigen::Index>& samples)
{
  std::vector<int> place(static_cast<std::size_t>(from.samples.reflectance.cols()), -1);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    place[static_cast<std::size_t>(samples[i])] = static_cast<int>(i);
  }
  std::vector<Eigen::Index> readings;
  std::vector<int> sampleOf;
  for (std::size_t j = 0; j < from.sampleOf.size(); ++j)
  {
    const int sample = place[static_cast<std::size_t>(from.sampleOf[j])];
    if (sample >= 0)
    {
      readings.push_back(static_cast<Eigen::Index>(j));
      sampleOf.push_back(sample);
    }
  }
  SceneSamples scene{ from.samples.reflectance(Eigen::all, samples),
    chosenOf(from.samples.medium, samples), chosenOf(from.samples.scene, samples),
    chosenOf(from.samples.x, samples), chosenOf(from.samples.y, samples),
    chosenOf(from.samples.order, samples) };
  return { from.camera, from.wavelengths, std::move(scene), from.readings(Eigen::all, readings),
    std::move(sampleOf), from.noise, chosenOf(from.names, samples) };
}

} // namespace msi
