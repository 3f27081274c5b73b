// A file that appears under its name only when it is complete.
//
// Data go to a temporary name in the same folder; `commit` renames it. If the program fails before, the temporary
// file is removed and an older file of that name stays as it was. What a killed program left is removed by the next writer of
// that file: those that live hold a lock (flock) on theirs.
#pragma once

#include <string>

namespace lightsieve {

class AtomicFile {
  public:
    /// Creates the temporary file, empty.
    /// throws  InputError (file-unwritable): no such folder, no permission, the name is a folder or a device
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Where to write. Has the extension of the final name.
    [[nodiscard]] const std::string& temporary() const { return temporary_; }
    [[nodiscard]] const std::string& path() const { return path_; }
    /// Flushes the temporary file to the disk and gives it its final name. If somebody removed the temporary file meanwhile, with
    /// its folder perhaps, its data are written again; the folder must be there.
    /// throws  InputError (file-unwritable)
    void commit();

  private:
    std::string path_, target_, temporary_;
    int fd_ = -1;  ///< the temporary file: its data stay as long as this is open
    bool committed_ = false;
};

/// Writes the data of an open file to a new one, and down to the disk. False with errno set.
[[nodiscard]] bool copy_open_file(int fd, const std::string& path);

}  // namespace lightsieve
