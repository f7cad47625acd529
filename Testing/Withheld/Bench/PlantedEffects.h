// Effects to plant in a virtual bench, each as its physics has it.
#pragma once

#include "VirtualBench.h"

#include <functional>
#include <string>
#include <vector>

namespace withheld
{

// Makes `bench` err; `size` scales the effect, 0 is none. Everything random is fixed when it is made, so that the
// same effect can be tried at several sizes.
struct PlantedEffect
{
  std::string name; // as in the project's effect library; "" for one that it does not have
  std::string kind; // what was planted, in words
  std::vector<std::string> axes; // acceptable first axes of `where`
  int medium = -1;
  bool rebalance = false; // the white was taken with the effect in place
  std::function<void(Bench&, double size)> apply;
};

const std::vector<std::string>& plantableNames();
const std::vector<std::string>& strangerNames(); // kinds that no library has

// media: how many the scene has; medium effects take one of them.
PlantedEffect plant(const std::string& name, Random& random, const Bench& bench, int media,
  const std::vector<Patch>& patches);
PlantedEffect plantStranger(
  const std::string& kind, Random& random, const Bench& bench, const std::vector<Patch>& patches);

} // namespace withheld
