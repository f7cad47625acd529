// Unfinished files that killed processes left behind.
#pragma once

#include <string>

namespace msi
{

// The hidden name of the unfinished 'path': .STEM.HOST-PROCESS-NUMBER.part.EXTENSION beside it.
std::string partName(const std::string& path, unsigned number);

// Removes the unfinished files of 'path' whose process, of this host, is no more. Those of other hosts, which may share
// the folder, and of running processes stay. Never fails: what cannot be removed stays.
void removeStaleParts(const std::string& path) noexcept;

} // namespace msi
