// Threads, the only place that knows TBB.
//
// Every worker runs with denormals flushed to zero, so that a result never depends on which thread computed it.
#pragma once

#include <cstddef>
#include <functional>

namespace lightsieve {

/// Calls `body(i)` for i in [0, n) on up to `n_threads` threads (0: as many as the machine has).
///
/// Items start in rising order. An exception of one item stops the start of further ones and is rethrown here.
void parallel_for(std::size_t n, int n_threads, const std::function<void(std::size_t)>& body);

/// Threads that the machine (or its container) offers.
[[nodiscard]] int hardware_threads();

/// Sets flush-to-zero and denormals-are-zero for the calling thread while it lives; restores the old mode after.
class FlushDenormals {
  public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned saved_;
};

}  // namespace lightsieve
