// Says that a file is being written, so that a second render which is to write it can be told before its first ray.
//
// The claim is an advisory lock (flock) on a small file beside it, `.NAME.lock`. A lock ends with the process that holds it,
// however that ends; what a killed one leaves is that file, which the next claim takes over. Where a file system knows no
// locks nothing is claimed: two renders then end as before, and the later one's file stays.
#pragma once

#include <string>

namespace lightsieve {

class FileClaim {
  public:
    /// path  of the file that will be written; it need not exist, nor need its folder
    /// throws  InputError (file-in-use): another process, or somebody else in this one, holds a claim on it
    explicit FileClaim(const std::string& path);
    ~FileClaim();
    FileClaim(FileClaim&& other) noexcept;
    FileClaim& operator=(FileClaim&&) = delete;
    FileClaim(const FileClaim&) = delete;
    FileClaim& operator=(const FileClaim&) = delete;

  private:
    std::string lock_path_;
    int fd_ = -1;
};

}  // namespace lightsieve
