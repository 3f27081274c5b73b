// A file that appears under its name only when it is complete.
//
// Data go to a temporary name in the same folder; `commit` renames it. If the program fails before, the temporary
// file is removed and an older file of that name stays as it was.
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
    /// Flushes the temporary file to the disk and gives it its final name.
    /// throws  InputError (file-unwritable)
    void commit();

  private:
    std::string path_, target_, temporary_;
    bool committed_ = false;
};

}  // namespace lightsieve
