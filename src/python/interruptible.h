// Long work that Ctrl-C can end.
//
// Python runs signal handlers on its main thread only, and only between instructions of its own. So the work gets a
// thread, and the caller's thread waits: it holds the GIL only to look for signals and to report progress, ten times
// a second, so other Python threads run on.
#pragma once

#include <atomic>
#include <functional>

namespace lightsieve::python {

/// Runs `work` on a thread of its own and waits for its end. Call with the GIL held.
///
/// work    must end soon after `stop` is set, if it can
/// stop    set when a signal handler or `poll` raises; the first such exception is thrown when the work has ended
/// poll    called with the GIL held about ten times a second and once at the end; may be empty
/// throws  what `work` threw, else what the handler or `poll` raised
void run_interruptible(const std::function<void()>& work, std::atomic<bool>& stop,
                       const std::function<void()>& poll);

}  // namespace lightsieve::python
