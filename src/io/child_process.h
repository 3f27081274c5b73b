// A program run as a child, whose standard output is read piece by piece, with a limit on time.
//
// Safe in a process with threads and inside Python: posix_spawn, not fork; pipes that no other child inherits; signals as a
// fresh program has them. The child is killed, and always waited for, when the object goes.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <sys/types.h>

namespace lightsieve {

class ChildProcess {
  public:
    /// What the child finds on its standard input.
    enum class Input : unsigned char { Empty, Pipe };
    /// Starts `program` (a path) with `arguments`.
    ///
    /// max_seconds  wall-clock time after which reads and the wait for its end give up [s]
    /// throws       std::system_error: cannot be started
    ChildProcess(const std::string& program, std::span<const std::string> arguments,
                 double max_seconds, Input input = Input::Empty);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// From now on this much wall-clock time is left [s].
    void set_time(double max_seconds);

    /// Writes all of `bytes` to a child with Input::Pipe. False: it has ended, or takes nothing until its time is up.
    [[nodiscard]] bool write(std::span<const std::byte> bytes);

    enum class Read : unsigned char { Complete, Ended, TimedOut };
    /// Fills all of `out` from standard output. Ended: there was less.
    [[nodiscard]] Read read(std::span<std::byte> out);

    /// How it ended.
    struct Ending {
        bool timed_out = false;
        int exit_code = -1;  ///< -1: by a signal, or unknown
        int signal = 0;      ///< 0: not by a signal
    };
    /// Reads what is left of both streams, drops it, and waits. Nothing can be read afterwards.
    [[nodiscard]] Ending finish();

    /// The beginning of what it said on standard error so far; complete after `finish`.
    [[nodiscard]] const std::string& errors() const { return errors_; }

  private:
    /// Waits until standard output has something; keeps standard error from filling up meanwhile.
    [[nodiscard]] Read wait_for_output();
    void read_errors();
    [[nodiscard]] int milliseconds_left() const;

    pid_t pid_ = -1;
    int in_ = -1, out_ = -1, err_ = -1;  ///< our ends of the pipes; -1: closed
    std::chrono::steady_clock::time_point deadline_;
    std::string errors_;
};

/// Where a program of ours is that runs as a child: beside the module or program that this code is in.
[[nodiscard]] std::string helper_path(std::string_view name);

}  // namespace lightsieve
