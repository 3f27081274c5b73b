// How much memory there is to be had, asked before something large is taken; and giving back what was.
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

/// Gives the system back what was freed. A C library with a heap a thread keeps it otherwise, and a process that renders
/// for days grows although nothing is lost. Takes milliseconds: for the end of a scene, not of a bucket.
void release_freed_memory();

}  // namespace lightsieve
