#include "io/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

#include "core/error.h"

namespace lightsieve {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& hint) {
    throw InputError(Error{Code::FileUnwritable, message, {}, hint, {}, Severity::Error});
}

/// The file that a write to `path` would change: links are followed, so that a link stays one.
fs::path final_target(const std::string& path) {
    std::error_code ec;
    const fs::path resolved = fs::weakly_canonical(fs::absolute(path), ec);
    return ec ? fs::absolute(path) : resolved;
}

/// Whether a name is ".STEM.<process>-<number>.part.EXTENSION": a temporary file for `target`.
bool is_temporary_of(const fs::path& target, const std::string& name) {
    const std::string head = "." + target.stem().string() + ".",
                      tail = ".part" + target.extension().string();
    if (name.size() <= head.size() + tail.size() || !name.starts_with(head) ||
        !name.ends_with(tail))
        return false;
    const std::string middle = name.substr(head.size(), name.size() - head.size() - tail.size());
    return middle.find_first_not_of("0123456789-") == std::string::npos;
}

/// Removes what writers of the file left that were killed: those that live hold a lock on theirs.
void remove_leftovers(const fs::path& target) {
    std::error_code failed;
    for (auto it = fs::directory_iterator(target.parent_path(), failed);
         !failed && it != fs::directory_iterator(); it.increment(failed)) {
        if (!is_temporary_of(target, it->path().filename().string())) continue;
        const int fd = ::open(it->path().c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
        if (fd < 0) continue;
        if (::flock(fd, LOCK_EX | LOCK_NB) == 0) ::unlink(it->path().c_str());
        ::close(fd);
    }
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
    std::error_code ec;
    if (path.empty()) refuse("no file name is given", "set the driver's \"filename\"");
    const fs::path target = final_target(path);
    const fs::path folder = target.parent_path();
    if (!fs::is_directory(folder, ec))
        refuse("cannot write \"" + path + "\": there is no folder \"" + folder.string() + "\"",
               "create the folder, or choose another one with -o");
    const fs::file_status status = fs::status(target, ec);
    if (fs::is_directory(status))
        refuse("cannot write \"" + path + "\": it is a folder", "give the name of a file");
    // A device would be replaced by a file.
    if (fs::exists(status) && !fs::is_regular_file(status))
        refuse("cannot write \"" + path + "\": it is not an ordinary file",
               "give the name of an ordinary file");
    if (fs::exists(status) && ::access(target.c_str(), W_OK) != 0)
        refuse("cannot write \"" + path + "\": " + std::strerror(errno),
               "make the file writable, or choose another name with -o");

    remove_leftovers(target);
    // A name of our own: two renders into one folder must not meet.
    static std::atomic<unsigned> counter{0};
    const std::string name = "." + target.stem().string() + "." + std::to_string(::getpid()) +
                             "-" + std::to_string(counter++) + ".part" +
                             target.extension().string();
    target_ = target.string();
    temporary_ = (folder / name).string();
    fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ < 0)
        refuse("cannot write into the folder \"" + folder.string() + "\": " + std::strerror(errno),
               "make the folder writable, or choose another one with -o");
    (void)::flock(fd_, LOCK_SH | LOCK_NB);
}

AtomicFile::~AtomicFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!committed_ && !temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    // Without a flush a crash of the machine could leave an empty file under the final name.
    const bool removed = ::access(temporary_.c_str(), F_OK) != 0 && errno == ENOENT;
    if (!(removed ? copy_open_file(fd_, temporary_) : ::fsync(fd_) == 0))
        refuse("cannot write \"" + path_ + "\": " + std::strerror(errno), "check the disk");
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        refuse("cannot write \"" + path_ + "\": " + std::strerror(errno),
               "check the folder's permissions");
    committed_ = true;
}

bool copy_open_file(int fd, const std::string& path) {
    const int out = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (out < 0) return false;
    std::vector<char> part(std::size_t{1} << 20);
    bool good = true;
    ssize_t n = 0;
    for (::off_t at = 0; good && (n = ::pread(fd, part.data(), part.size(), at)) > 0; at += n)
        for (ssize_t done = 0, put = 0; good && done < n; done += put) {
            put = ::write(out, part.data() + done, static_cast<std::size_t>(n - done));
            good = put > 0;
        }
    good = good && n == 0 && ::fsync(out) == 0;
    const int error = errno;
    ::close(out);
    if (!good) ::unlink(path.c_str());
    errno = error;
    return good;
}

}  // namespace lightsieve
