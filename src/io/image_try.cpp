#include "io/image_try.h"

#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <system_error>
#include <utility>

#include "io/child_process.h"

namespace lightsieve {

namespace {

namespace fs = std::filesystem;

/// A picture on a slow disk may take longer than its processor time [s].
constexpr double kAnswerSeconds = 4.0 * kTrySeconds;

/// The running program and what it said before.
class ImageTrier {
  public:
    explicit ImageTrier(std::string program) : program_(std::move(program)) {}
    ~ImageTrier() { forget_foreign(); }
    ImageTrier(const ImageTrier&) = delete;
    ImageTrier& operator=(const ImageTrier&) = delete;

    bool try_file(const std::string& path, std::string& problem) {
        const std::lock_guard lock(mutex_);
        const Version version = version_of(path);
        if (const auto it = survived_.find(path); it != survived_.end() && it->second == version)
            return true;
        if (!judge(path, problem)) return false;
        survived_[path] = version;
        return true;
    }

  private:
    using Version = std::pair<fs::file_time_type, std::uintmax_t>;
    static Version version_of(const std::string& path) {
        std::error_code ec;
        const auto time = fs::last_write_time(path, ec);
        return {time, fs::file_size(path, ec)};
    }

    /// The program belongs to the process that started it: a fork of ours must not talk to it, nor end it.
    void forget_foreign() {
        if (child_ && owner_ != ::getpid()) static_cast<void>(child_.release());
    }

    bool start() {
        forget_foreign();
        if (child_) return true;
        if (cannot_start_) return false;
        try {
            child_ = std::make_unique<ChildProcess>(program_, std::span<const std::string>{},
                                                    kAnswerSeconds, ChildProcess::Input::Pipe);
            owner_ = ::getpid();
        } catch (const std::system_error&) {
            cannot_start_ = true;
        }
        return child_ != nullptr;
    }

    bool judge(const std::string& path, std::string& problem) {
        if (!start()) return true;
        child_->set_time(kAnswerSeconds);
        std::array<std::byte, kTrialBytes> answer{};
        // A name with its final zero: the program reads up to that.
        const bool asked = child_->write(std::as_bytes(std::span(path.c_str(), path.size() + 1)));
        const auto read = asked ? child_->read(answer) : ChildProcess::Read::Ended;
        if (read != ChildProcess::Read::Complete) {
            // The program that only forks has ended or hangs: no file should be able to do that.
            child_.reset();
            cannot_start_ = read == ChildProcess::Read::Ended;
            if (read == ChildProcess::Read::Ended) return true;
            problem = "reading it takes too long";
            return false;
        }
        return accept(static_cast<ImageTrial>(answer[0]), static_cast<int>(answer[1]), problem);
    }

    static bool accept(ImageTrial trial, int signal, std::string& problem) {
        switch (trial) {
            case ImageTrial::Survived: return true;
            case ImageTrial::TooSlow: problem = "reading it takes too long"; return false;
            case ImageTrial::Memory: problem = "reading it takes too much memory"; return false;
            case ImageTrial::Crashed: break;
        }
        problem = "it is damaged in a way that crashes its reader (" +
                  std::string(::strsignal(signal)) + ")";
        return false;
    }

    std::string program_;
    std::mutex mutex_;
    std::unique_ptr<ChildProcess> child_;
    pid_t owner_ = 0;
    bool cannot_start_ = false;
    std::map<std::string, Version> survived_;
};

}  // namespace

bool try_image(const std::string& path, std::string& problem) {
    static ImageTrier trier(helper_path(kImageReaderName));
    return trier.try_file(path, problem);
}

bool try_image_with(const std::string& program, const std::string& path, std::string& problem) {
    return ImageTrier(program).try_file(path, problem);
}

}  // namespace lightsieve
