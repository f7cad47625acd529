// How much memory there is, asked before much of it is taken.
#pragma once

#include <cstdint>
#include <string>

namespace msi
{

// Bytes that this process may still take: the least of what the machine has free, what its control group allows and
// what its limit of address space leaves. The largest number where none of them is known.
std::uint64_t availableMemory();

// The text of a size: "57.6 GB", "138 bytes".
std::string memoryText(double bytes);

// Throws std::runtime_error where 'bytes' are more than that: "WHAT needs 57.6 GB of memory and 21 GB are free; REMEDY".
// An allocation that the system grants and cannot keep would end the process without a word. Small sizes are not
// looked at.
void requireMemory(double bytes, const std::string& what, const std::string& remedy);

} // namespace msi
