#include "io/child_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace lightsieve {

namespace {

/// More of standard error is not kept [bytes].
constexpr std::size_t kMaxErrors = std::size_t{1} << 16;
/// A pipe of this size takes fewer turns between the two processes; the system may give less [bytes].
constexpr int kPipeSize = 1 << 20;
/// Longest wait of one poll: far below the range of its argument.
constexpr int kMaxPollMs = 60'000;
/// Between two looks at a child that has closed its streams and goes on.
constexpr std::chrono::milliseconds kReapPause{1};

void close_end(int& fd) {
    if (fd >= 0) ::close(fd);
    fd = -1;
}

/// Both ends of a pipe, closed in whatever else this process starts.
struct Pipe {
    int read_end = -1, write_end = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0)
            throw std::system_error(errno, std::generic_category(), "no pipe");
        read_end = ends[0];
        write_end = ends[1];
    }
    ~Pipe() {
        close_end(read_end);
        close_end(write_end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
};

/// A socket for the child's standard input: writing to a child that has ended is an error there, not a signal. In use only
/// if it was asked for.
struct InputSocket {
    int child_end = -1, our_end = -1;
    explicit InputSocket(ChildProcess::Input input) {
        if (input == ChildProcess::Input::Empty) return;
        std::array<int, 2> ends{};
        if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::system_error(errno, std::generic_category(), "no socket");
        child_end = ends[0];
        our_end = ends[1];
    }
    ~InputSocket() {
        close_end(child_end);
        close_end(our_end);
    }
    InputSocket(const InputSocket&) = delete;
    InputSocket& operator=(const InputSocket&) = delete;
};

/// What posix_spawn is told: streams and signals.
struct SpawnSettings {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    SpawnSettings(int in, int out, int err) {
        posix_spawn_file_actions_init(&files);
        if (in >= 0)
            posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
        else
            posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&files, err, STDERR_FILENO);
        // Python ignores SIGPIPE, and a host may block signals: a child would inherit both.
        sigset_t none, all;
        sigemptyset(&none);
        sigfillset(&all);
        posix_spawnattr_init(&attributes);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &all);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&files);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;
};

/// Never in the past, and not so far away that a clock overflows.
std::chrono::steady_clock::time_point deadline_after(double seconds) {
    constexpr double kLongest = 1e8;
    const double bounded = seconds > 0 ? std::min(seconds, kLongest) : 0;
    return std::chrono::steady_clock::now() +
           std::chrono::duration_cast<std::chrono::steady_clock::duration>(
               std::chrono::duration<double>(bounded));
}

}  // namespace

ChildProcess::ChildProcess(const std::string& program, std::span<const std::string> arguments,
                           double max_seconds, Input input)
    : deadline_(deadline_after(max_seconds)) {
    Pipe out, err;
    InputSocket in(input);
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const SpawnSettings settings(in.child_end, out.write_end, err.write_end);
    const int problem = ::posix_spawn(&pid_, program.c_str(), &settings.files,
                                      &settings.attributes, argv.data(), environ);
    if (problem != 0) throw std::system_error(problem, std::generic_category(), program);
    ::fcntl(out.read_end, F_SETPIPE_SZ, kPipeSize);
    ::fcntl(err.read_end, F_SETFL, O_NONBLOCK);
    out_ = std::exchange(out.read_end, -1);
    err_ = std::exchange(err.read_end, -1);
    in_ = std::exchange(in.our_end, -1);
}

ChildProcess::~ChildProcess() {
    close_end(in_);
    close_end(out_);
    close_end(err_);
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void ChildProcess::set_time(double max_seconds) { deadline_ = deadline_after(max_seconds); }

bool ChildProcess::write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        pollfd fd{in_, POLLOUT, 0};
        const int ready = ::poll(&fd, 1, milliseconds_left());
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0 && milliseconds_left() > 0) continue;
        if (ready <= 0) return false;
        const ssize_t n = ::send(in_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (n <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
    return true;
}

int ChildProcess::milliseconds_left() const {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline_ - std::chrono::steady_clock::now())
            .count();
    return static_cast<int>(std::clamp<decltype(left)>(left, 0, kMaxPollMs));
}

void ChildProcess::read_errors() {
    std::array<char, 4096> bytes{};
    for (;;) {
        const ssize_t n = ::read(err_, bytes.data(), bytes.size());
        if (n < 0 && errno == EINTR) continue;
        if (n < 0 && errno == EAGAIN) return;
        if (n <= 0) return close_end(err_);
        const std::size_t room = kMaxErrors - errors_.size();
        errors_.append(bytes.data(), std::min(static_cast<std::size_t>(n), room));
    }
}

ChildProcess::Read ChildProcess::wait_for_output() {
    for (;;) {
        // A descriptor of -1 is left out.
        std::array<pollfd, 2> fds{{{out_, POLLIN, 0}, {err_, POLLIN, 0}}};
        const int milliseconds = milliseconds_left();
        const int n = ::poll(fds.data(), fds.size(), milliseconds);
        if (n < 0 && errno != EINTR) return Read::Ended;
        if (n <= 0) {
            if (milliseconds_left() == 0) return Read::TimedOut;
            continue;
        }
        if (fds[1].revents != 0) read_errors();
        if (fds[0].revents != 0) return Read::Complete;
        // A child that only complains must not keep us here for ever.
        if (milliseconds == 0) return Read::TimedOut;
    }
}

ChildProcess::Read ChildProcess::read(std::span<std::byte> out) {
    while (!out.empty()) {
        if (out_ < 0) return Read::Ended;
        if (const Read waited = wait_for_output(); waited != Read::Complete) return waited;
        const ssize_t n = ::read(out_, out.data(), out.size());
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            close_end(out_);
            return Read::Ended;
        }
        if (std::chrono::steady_clock::now() > deadline_) return Read::TimedOut;
        out = out.subspan(static_cast<std::size_t>(n));
    }
    return Read::Complete;
}

ChildProcess::Ending ChildProcess::finish() {
    Ending ending;
    std::vector<std::byte> dropped(std::size_t{1} << 16);
    Read last = Read::Complete;
    while (last == Read::Complete)
        last = read(dropped);
    // Standard error may be open still.
    while (err_ >= 0 && milliseconds_left() > 0) {
        pollfd fd{err_, POLLIN, 0};
        if (::poll(&fd, 1, milliseconds_left()) > 0) read_errors();
    }
    int status = 0;
    pid_t done = 0;
    while ((done = ::waitpid(pid_, &status, WNOHANG)) == 0 || (done < 0 && errno == EINTR)) {
        if (milliseconds_left() == 0) {
            ending.timed_out = true;
            return ending;  // the destructor kills it
        }
        std::this_thread::sleep_for(kReapPause);
    }
    pid_ = -1;
    if (done < 0) return ending;  // somebody else has waited for it
    if (WIFEXITED(status)) ending.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) ending.signal = WTERMSIG(status);
    return ending;
}

std::string helper_path(std::string_view name) {
    namespace fs = std::filesystem;
    std::error_code ec;
    // A module knows its own file; of a program only the system knows, for it may have been called by another name.
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&helper_path), &info) != 0) {
        const fs::path module = fs::canonical(info.dli_fname, ec);
        const fs::path beside = module.parent_path() / name;
        if (!ec && fs::exists(beside, ec)) return beside.string();
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", ec);
    return (program.parent_path() / name).string();
}

}  // namespace lightsieve
