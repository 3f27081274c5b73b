#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

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

    // A name of our own: two renders into one folder must not meet.
    static std::atomic<unsigned> counter{0};
    const std::string name = "." + target.stem().string() + "." + std::to_string(::getpid()) +
                             "-" + std::to_string(counter++) + ".part" +
                             target.extension().string();
    target_ = target.string();
    temporary_ = (folder / name).string();
    const int fd = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd < 0)
        refuse("cannot write into the folder \"" + folder.string() + "\": " + std::strerror(errno),
               "make the folder writable, or choose another one with -o");
    ::close(fd);
}

AtomicFile::~AtomicFile() {
    if (!committed_ && !temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
    // Without a flush a crash of the machine could leave an empty file under the final name.
    const int fd = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    const bool flushed = fd >= 0 && ::fsync(fd) == 0;
    const int flush_error = errno;
    if (fd >= 0) ::close(fd);
    if (!flushed)
        refuse("cannot write \"" + path_ + "\": " + std::strerror(flush_error), "check the disk");
    if (::rename(temporary_.c_str(), target_.c_str()) != 0)
        refuse("cannot write \"" + path_ + "\": " + std::strerror(errno),
               "check the folder's permissions");
    committed_ = true;
}

}  // namespace lightsieve
