// What goes wrong in the second generator, each as a way to err of a given size.
#pragma once

#include "SecondScene.h"

namespace withheld::second
{

struct Fault
{
  std::string kind;
  bool rewhitened = false; // the white was taken with the fault in place
  std::function<void(World&, double size)> apply;
};

const std::vector<std::string>& faultNames();    // as in the project's effect library
const std::vector<std::string>& strangerNames(); // what no library has

Fault drawFault(const std::string& name, Random& random, const World& world, const Scene& scene);
Fault drawStranger(const std::string& name, Random& random, const Scene& scene);

} // namespace withheld::second
