// How much memory there is to be had, asked before something large is taken.
//
// Linux hands out more than it has and ends the program when it is used, so `new` does not fail in time. Where the
// system says nothing, everything seems to be there.
#pragma once

#include <cstddef>
#include <string>

namespace lightsieve {

/// What can be taken now without driving other things out [bytes]: free memory and caches of files, within the limits of the
/// control group that the process is in. The largest number if it is not known.
///
/// root  for tests: a folder that stands for the system's /
[[nodiscard]] std::size_t available_memory(const std::string& root = "");

/// What the process holds now, and the most that it ever held [bytes]; 0 if it is not known.
[[nodiscard]] std::size_t resident_memory(const std::string& root = "");
[[nodiscard]] std::size_t peak_memory(const std::string& root = "");

}  // namespace lightsieve
