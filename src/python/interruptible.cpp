#include "python/interruptible.h"

#include <nanobind/nanobind.h>

#include <chrono>
#include <exception>
#include <future>

namespace nb = nanobind;

namespace lightsieve::python {
namespace {
/// Often enough for a smooth progress bar and a prompt Ctrl-C, rare enough to cost nothing.
constexpr std::chrono::milliseconds kPollInterval{100};
}  // namespace

void run_interruptible(const std::function<void()>& work, std::atomic<bool>& stop,
                       const std::function<void()>& poll) {
    std::future<void> done = std::async(std::launch::async, work);
    std::exception_ptr raised;
    const auto look = [&] {
        try {
            if (PyErr_CheckSignals() != 0) throw nb::python_error();
            if (poll && !raised) poll();
        } catch (nb::python_error&) {
            // Keep the first; further Ctrl-C while the work winds down changes nothing.
            if (!raised) raised = std::current_exception();
            stop = true;
        }
    };
    for (bool running = true; running;) {
        {
            const nb::gil_scoped_release others_run;
            running = done.wait_for(kPollInterval) != std::future_status::ready;
        }
        look();
    }
    done.get();
    if (raised) std::rethrow_exception(raised);
}

}  // namespace lightsieve::python
