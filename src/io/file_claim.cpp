#include "io/file_claim.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace lightsieve {

namespace fs = std::filesystem;

namespace {

/// The claim of a path: beside the file that a write would change, so that two names of one file are one claim.
std::string lock_path_of(const std::string& path) {
    std::error_code failed;
    const fs::path resolved = fs::weakly_canonical(fs::absolute(path), failed);
    const fs::path target = failed ? fs::path(path) : resolved;
    return (target.parent_path() / ("." + target.filename().string() + ".lock")).string();
}

/// Whether the path still names the open file: its holder removes it when it is done.
bool is_still_there(int fd, const std::string& path) {
    struct ::stat open_file{}, named{};
    return ::fstat(fd, &open_file) == 0 && ::stat(path.c_str(), &named) == 0 &&
           open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

/// Who holds it, as the holder wrote it.
std::string holder_of(int fd) {
    std::array<char, 32> text{};
    const ssize_t n = ::pread(fd, text.data(), text.size(), 0);
    return n > 0 ? " (process " + std::string(text.data(), static_cast<std::size_t>(n)) + ")" : "";
}

}  // namespace

FileClaim::FileClaim(const std::string& path) : lock_path_(lock_path_of(path)) {
    for (;;) {
        fd_ = ::open(lock_path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (fd_ < 0) return;  // whoever writes the file says why that is impossible
        if (::flock(fd_, LOCK_EX | LOCK_NB) == 0) {
            if (is_still_there(fd_, lock_path_)) break;
            ::close(fd_);  // its holder was done in between: the next one is ours
            continue;
        }
        const bool held = errno == EWOULDBLOCK;
        const std::string holder = held ? holder_of(fd_) : "";
        ::close(std::exchange(fd_, -1));
        if (!held) return;  // no locks here
        throw InputError({Code::FileInUse,
                          "another render" + holder + " is writing \"" + path + '"',
                          {},
                          "wait until it is done, or choose another name with -o"});
    }
    const std::string pid = std::to_string(::getpid());
    [[maybe_unused]] const bool written =
        ::ftruncate(fd_, 0) == 0 &&
        ::pwrite(fd_, pid.data(), pid.size(), 0) == static_cast<ssize_t>(pid.size());
}

FileClaim::FileClaim(FileClaim&& other) noexcept
    : lock_path_(std::move(other.lock_path_)), fd_(std::exchange(other.fd_, -1)) {}

FileClaim::~FileClaim() {
    if (fd_ < 0) return;
    // While it is still held: a file of this name is then nobody else's.
    if (is_still_there(fd_, lock_path_)) ::unlink(lock_path_.c_str());
    ::close(fd_);
}

}  // namespace lightsieve
