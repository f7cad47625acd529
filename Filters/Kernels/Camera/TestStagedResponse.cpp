#include "Kernels/Camera/StagedResponse.h"

#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using msi::CameraEffect;
using msi::CameraSimulatorOptions;
using msi::StagedResponse;
using msi::test::rasterScene;
using msi::test::responseWith;
using msi::test::sevenChannels;

// An effect that acts on tables, its parameters away from neutral by up to a typical step.
CameraEffect drawn(std::mt19937& random)
{
  const auto& library = msi::effectLibrary();
  const auto pick = [&random](std::size_t count)
  { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random); };
  const msi::EffectDefinition* effect = nullptr;
  do
  {
    effect = &library[pick(library.size())];
  } while (effect->stage == msi::EffectStage::Noise || effect->stage == msi::EffectStage::Image);
  const msi::EffectForm& form = effect->forms[pick(effect->forms.size())];
  const std::vector<std::string> media = rasterScene().media();
  CameraEffect result = msi::neutralEffect(effect->name, sevenChannels().channels(), form.name,
    effect->need == msi::EffectNeed::Medium ? media[pick(media.size())] : "");
  const auto parameters = msi::effectParameters(result, sevenChannels().channels());
  for (std::size_t i = 0; i < parameters.size(); ++i)
  {
    const double part = std::uniform_real_distribution<>(-1.0, 1.0)(random);
    result.parameters[i] = std::fmin(
      std::fmax(parameters[i].neutral + part * parameters[i].typical, parameters[i].lower),
      parameters[i].upper);
  }
  return result;
}

bool sameCause(const CameraEffect& a, const CameraEffect& b)
{
  return a.name == b.name && a.medium == b.medium;
}

// Adds, replaces or takes away one effect, or moves one of its parameters a little.
void change(std::vector<CameraEffect>& effects, std::mt19937& random)
{
  const auto kind = std::uniform_int_distribution<>(0, 3)(random);
  if (effects.empty() || kind == 0)
  {
    const CameraEffect fresh = drawn(random);
    const auto same = std::find_if(effects.begin(), effects.end(),
      [&fresh](const CameraEffect& effect) { return sameCause(effect, fresh); });
    if (same == effects.end())
    {
      effects.push_back(fresh);
    }
    else
    {
      *same = fresh;
    }
    return;
  }
  const auto at = std::uniform_int_distribution<std::size_t>(0, effects.size() - 1)(random);
  if (kind == 1)
  {
    effects.erase(effects.begin() + static_cast<std::ptrdiff_t>(at));
    return;
  }
  const auto parameters = msi::effectParameters(effects[at], sevenChannels().channels());
  const auto p = std::uniform_int_distribution<std::size_t>(0, parameters.size() - 1)(random);
  effects[at].parameters[p] =
    std::fmin(effects[at].parameters[p] + 1e-3 * parameters[p].typical, parameters[p].upper);
}

TEST(StagedResponse, OfRelatedEffectsIsTheSimulatorsBitForBit)
{
  std::mt19937 random(5);
  const msi::SampleScene scene = rasterScene();
  std::vector<CameraEffect> effects;
  StagedResponse here(sevenChannels(), scene, effects);
  int changed = 0;
  for (int step = 0; step < 2000; ++step)
  {
    const std::vector<CameraEffect> before = effects;
    change(effects, random);
    const bool white = std::uniform_int_distribution<>(0, 9)(random) == 0;
    StagedResponse there(here, effects, { white });
    ASSERT_EQ(there.response(), responseWith(effects, white)) << "after " << step << " changes";
    changed += there.response() == here.response() ? 0 : 1;
    if (effects.size() > 5)
    {
      effects = before;
    }
    else
    {
      here = std::move(there);
    }
  }
  EXPECT_GT(changed, 1000);
}

TEST(StagedResponse, FromNothingIsTheSimulatorsBitForBit)
{
  std::mt19937 random(6);
  const msi::SampleScene scene = rasterScene();
  for (int step = 0; step < 200; ++step)
  {
    std::vector<CameraEffect> effects;
    change(effects, random);
    change(effects, random);
    EXPECT_EQ(StagedResponse(sevenChannels(), scene, effects).response(), responseWith(effects));
  }
}

TEST(StagedResponse, RejectsWhatTheSimulatorRejects)
{
  const msi::SampleScene scene = rasterScene();
  const StagedResponse here(sevenChannels(), scene, {});
  EXPECT_EQ(msi::test::messageOf(
              [&] {
                StagedResponse(here, { { "dark", "", "", {} } });
              }),
    msi::test::messageOf(
      [&] {
        responseWith({ { "dark", "", "", {} } });
      }));
  EXPECT_NE(msi::test::messageOf([&] { responseWith({ { "dark", "", "", {} } }); }), "");
}
}
