// Shares of players in what they achieve together.
#pragma once

#include <cstddef>
#include <vector>

namespace msi
{

// Shapley values: value[subset] is what the players in the bits of `subset` achieve; 2^players values, of which
// value[0] is what none achieves. The values of all players sum to value[all] - value[0].
// Source: L. S. Shapley, "A value for n-person games", 1953, doi:10.1515/9781400881970-018.
std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players);

} // namespace msi
