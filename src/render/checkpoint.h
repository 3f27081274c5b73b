// What a render has done so far, in a file beside the picture: a render that was ended goes on from there.
//
// The file starts with what the render is of, then has one record after another: the film of a bucket. A record is added
// when a bucket is done, and every few minutes for those that are not; the last one of a bucket counts. Records are only
// ever added and have checksums: whatever ends the program, even in the middle of writing, all earlier ones are good.
// Sums are kept as they are, so that the picture is the same bits as if nothing had happened, also with more samples.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.h"

namespace lightsieve {

/// What must be the same for a render to go on: what it is ("the scene"), and how it was.
using RenderIdentity = std::vector<std::pair<std::string, std::string>>;

struct CheckpointSettings {
    std::string path;    ///< of the file; empty: no checkpoints
    double minutes = 0;  ///< between two writes; 0: only when the render is ended
    bool resume = false;
    bool keep = false;  ///< also when the render is done: for a later one with more samples
    /// Of the disk, for pictures [bytes]: what would not leave as much is not saved.
    std::uint64_t keep_free = 0;
};

class Checkpoint {
  public:
    /// Reads what there is to resume; what is damaged at the end of the file is left out.
    ///
    /// samples  a pixel that this render takes: a file of a render that took more is refused
    /// throws   InputError (checkpoint-other) with every difference, if the file is of another render or no checkpoint
    Checkpoint(CheckpointSettings settings, RenderIdentity identity, int samples);
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    /// As much of what is done waits in memory at most, beside the state of one bucket [bytes].
    static constexpr std::size_t kMostPending = std::size_t{64} << 20;

    [[nodiscard]] bool active() const { return !settings_.path.empty(); }
    /// The last state of a bucket in a pass; nothing if there is none.
    [[nodiscard]] std::optional<std::vector<std::byte>> load(std::uint32_t bucket,
                                                             std::uint32_t pass);

    using Clock = std::chrono::steady_clock;
    /// Whether a bucket whose state was saved then should be saved again.
    [[nodiscard]] bool due(Clock::time_point last) const;
    /// Takes the state of a bucket. Writes when it is time. From any thread.
    void save(std::uint32_t bucket, std::uint32_t pass, std::vector<std::byte> state);
    /// Writes what was saved and not written: the render was ended.
    void flush();
    /// The render is done: removes the file, or writes the rest if it is to be kept.
    void finish();
    /// Why a write failed, so that something will have to be rendered again; empty if none did.
    [[nodiscard]] const std::string& problem() const { return problem_; }

  private:
    using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< bucket, pass
    struct Place {
        std::uint64_t start, size;
    };
    struct Record {
        Key key;
        std::vector<std::byte> state;
    };
    void read(int samples);
    void check_header(class ByteReader& header, int samples) const;
    /// sync  down to the disk: against more than the end of this program
    void write_pending(bool sync);
    void note_problem(const char* why);
    [[nodiscard]] bool append(const std::vector<std::byte>& bytes);
    [[nodiscard]] bool leaves_room() const;
    [[nodiscard]] bool open_for_writing();
    [[nodiscard]] std::vector<std::byte> header_bytes() const;

    CheckpointSettings settings_;
    RenderIdentity identity_;
    int samples_;
    std::mutex mutex_;
    int file_ = -1;
    std::uint64_t size_ = 0;  ///< of the good part of the file
    bool continues_ = false;  ///< the file holds this render already
    std::map<Key, Place> places_;
    std::vector<Record> pending_;
    std::size_t pending_bytes_ = 0;
    Clock::time_point synced_;
    std::string problem_;
};

}  // namespace lightsieve
