#include "core/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <xmmintrin.h>
#include <atomic>

namespace lightsieve {
namespace {
constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
}

FlushDenormals::FlushDenormals() : saved_(_mm_getcsr()) {
    _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
}
FlushDenormals::~FlushDenormals() { _mm_setcsr(saved_); }

int hardware_threads() { return tbb::info::default_concurrency(); }

void parallel_for(std::size_t n, int n_threads, const std::function<void(std::size_t)>& body) {
    const int workers = n_threads > 0 ? n_threads : hardware_threads();
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        const FlushDenormals flush;
        for (std::size_t i = next.fetch_add(1); i < n; i = next.fetch_add(1)) {
            try {
                body(i);
            } catch (...) {
                next.store(n);
                throw;
            }
        }
    };
    if (workers == 1 || n <= 1) return work();
    // The arena alone cannot start more threads than cores were found; the control allows it (--threads 8 on 2 cores).
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(workers));
    tbb::task_arena arena(workers);
    arena.execute([&] {
        tbb::task_group group;
        for (int i = 1; i < workers; ++i)
            group.run(work);
        group.run_and_wait(work);
    });
}

}  // namespace lightsieve
