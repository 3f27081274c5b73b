#include "render/checkpoint.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/bytes.h"
#include "core/error.h"
#include "core/fingerprint.h"
#include "io/atomic_file.h"

namespace lightsieve {
namespace {

constexpr std::uint64_t kMagic = 0x33544b434556534cU;  // "LSVECKT3" on little-endian machines
constexpr std::uint32_t kRecord = 0x44524352U;
/// Longer than any header and any bucket's film [bytes]: what claims to be larger is damage.
constexpr std::uint64_t kLargestRecord = std::uint64_t{1} << 36U;

struct RecordHead {
    std::uint32_t magic, bucket, pass, padding;
    std::uint64_t size, checksum;
};

std::uint64_t checksum_of(const RecordHead& head, std::span<const std::byte> state) {
    Fingerprint sum;
    sum.add(head.bucket);
    sum.add(head.pass);
    sum.add(state);
    return sum.value();
}

/// Reads at a place, all or nothing.
bool read_at(int file, std::uint64_t at, void* out, std::size_t size) {
    auto* to = static_cast<char*>(out);
    while (size > 0) {
        const ::ssize_t n = ::pread(file, to, size, static_cast<::off_t>(at));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        to += n;
        at += static_cast<std::uint64_t>(n);
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

bool write_at(int file, std::uint64_t at, const void* data, std::size_t size) {
    const auto* from = static_cast<const char*>(data);
    while (size > 0) {
        const ::ssize_t n = ::pwrite(file, from, size, static_cast<::off_t>(at));
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        from += n;
        at += static_cast<std::uint64_t>(n);
        size -= static_cast<std::size_t>(n);
    }
    return true;
}

void put_text(ByteWriter& out, const std::string& text) {
    out.put(std::vector<char>(text.begin(), text.end()));
}

/// Texts of any length; the reader knows how many bytes there are.
bool get_text(ByteReader& in, std::string& text) {
    std::uint64_t n = 0;
    ByteReader ahead = in;
    if (!ahead.get(n) || n > kLargestRecord) return false;
    std::vector<char> chars;
    if (!in.get(chars, static_cast<std::size_t>(n))) return false;
    text.assign(chars.begin(), chars.end());
    return true;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why,
                         std::vector<Note> notes = {}) {
    throw InputError(Error{Code::CheckpointOther,
                           "cannot go on with the checkpoint \"" + path + "\": " + why,
                           {},
                           "render without --resume to start anew",
                           std::move(notes),
                           Severity::Error});
}

/// A value for a message: long ones are cut.
std::string shown(const std::string& value) {
    constexpr std::size_t kMost = 80;
    return '"' + (value.size() > kMost ? value.substr(0, kMost) + "..." : value) + '"';
}

}  // namespace

Checkpoint::Checkpoint(CheckpointSettings settings, RenderIdentity identity, int samples)
    : settings_(std::move(settings)),
      identity_(std::move(identity)),
      samples_(samples),
      synced_(Clock::now()) {
    if (active() && settings_.resume) read(samples);
}

Checkpoint::~Checkpoint() {
    if (file_ >= 0) ::close(file_);
}

std::vector<std::byte> Checkpoint::header_bytes() const {
    ByteWriter out;
    out.put(samples_);
    out.put(static_cast<std::uint64_t>(identity_.size()));
    for (const auto& [what, how] : identity_) {
        put_text(out, what);
        put_text(out, how);
    }
    const std::vector<std::byte> body = out.take();
    Fingerprint sum;
    sum.add(body);
    ByteWriter all;
    all.put(kMagic);
    all.put(static_cast<std::uint64_t>(body.size()));
    all.put(sum.value());
    std::vector<std::byte> bytes = all.take();
    bytes.insert(bytes.end(), body.begin(), body.end());
    return bytes;
}

void Checkpoint::check_header(ByteReader& header, int samples) const {
    std::int32_t before = 0;
    std::uint64_t n = 0;
    std::map<std::string, std::string> found;
    bool good = header.get(before) && header.get(n);
    for (std::uint64_t i = 0; good && i < n; ++i) {
        std::string what, how;
        good = get_text(header, what) && get_text(header, how);
        found[what] = how;
    }
    if (!good || !header.done()) refuse(settings_.path, "it is damaged");
    std::vector<Note> notes;
    for (const auto& [what, how] : identity_)
        if (found[what] != how)
            notes.push_back({what + ": then " + shown(found[what]) + ", now " + shown(how), {}});
    if (!notes.empty()) refuse(settings_.path, "it is of another render", std::move(notes));
    if (before > samples)
        refuse(settings_.path, "it has up to " + std::to_string(before) +
                                   " samples a pixel, more than the " + std::to_string(samples) +
                                   " that are asked for");
}

/// Finds the records. Where one is damaged the file ends for us: what follows is overwritten.
void Checkpoint::read(int samples) {
    file_ = ::open(settings_.path.c_str(), O_RDWR | O_CLOEXEC);
    if (file_ < 0) {
        if (errno == ENOENT) return;  // nothing to resume: from the beginning
        refuse(settings_.path, std::strerror(errno));
    }
    struct {
        std::uint64_t magic, size, checksum;
    } head{};
    if (!read_at(file_, 0, &head, sizeof(head)) || head.magic != kMagic)
        refuse(settings_.path, "it is no checkpoint");
    struct ::stat status{};
    if (::fstat(file_, &status) != 0) refuse(settings_.path, std::strerror(errno));
    const auto file_size = static_cast<std::uint64_t>(status.st_size);
    if (head.size > file_size) refuse(settings_.path, "it is damaged");
    std::vector<std::byte> body(static_cast<std::size_t>(head.size));
    Fingerprint sum;
    const bool whole = read_at(file_, sizeof(head), body.data(), body.size());
    sum.add(body);
    if (!whole || sum.value() != head.checksum) refuse(settings_.path, "it is damaged");
    ByteReader header(body);
    check_header(header, samples);
    size_ = sizeof(head) + head.size;

    std::vector<std::byte> state;
    for (RecordHead record{}; read_at(file_, size_, &record, sizeof(record));) {
        const std::uint64_t start = size_ + sizeof(record);
        if (record.magic != kRecord || record.size > file_size - start) break;
        state.resize(static_cast<std::size_t>(record.size));
        if (!read_at(file_, start, state.data(), state.size()) ||
            checksum_of(record, state) != record.checksum)
            break;
        places_[{record.bucket, record.pass}] = {start, record.size};
        size_ = start + record.size;
    }
    continues_ = true;
}

std::optional<std::vector<std::byte>> Checkpoint::load(std::uint32_t bucket, std::uint32_t pass) {
    const std::lock_guard lock(mutex_);
    const auto found = places_.find({bucket, pass});
    if (found == places_.end()) return std::nullopt;
    std::vector<std::byte> state(static_cast<std::size_t>(found->second.size));
    if (!read_at(file_, found->second.start, state.data(), state.size())) return std::nullopt;
    return state;
}

bool Checkpoint::due(Clock::time_point last) const {
    return active() && settings_.minutes > 0 &&
           Clock::now() - last >= std::chrono::duration<double, std::ratio<60>>(settings_.minutes);
}

void Checkpoint::save(std::uint32_t bucket, std::uint32_t pass, std::vector<std::byte> state) {
    if (!active()) return;
    const std::lock_guard lock(mutex_);
    const Key key{bucket, pass};
    const auto same = [&](const Record& r) { return r.key == key; };
    if (const auto old = std::ranges::find_if(pending_, same); old != pending_.end()) {
        pending_bytes_ -= old->state.size();
        pending_.erase(old);
    }
    pending_bytes_ += state.size();
    pending_.push_back({key, std::move(state)});
    const bool is_time = due(synced_);
    if (is_time || pending_bytes_ > kMostPending) write_pending(is_time);
}

void Checkpoint::flush() {
    const std::lock_guard lock(mutex_);
    if (!active()) return;
    write_pending(true);
    // Somebody may have removed the file, with its folder perhaps: what is open has its data still.
    if (!continues_ || ::access(settings_.path.c_str(), F_OK) == 0 || errno != ENOENT) return;
    if (!copy_open_file(file_, settings_.path)) note_problem(std::strerror(errno));
}

void Checkpoint::finish() {
    if (!active()) return;
    if (settings_.keep) return flush();
    const std::lock_guard lock(mutex_);
    pending_.clear();
    if (!continues_) return;  // what lies there is not ours
    std::error_code ignored;
    std::filesystem::remove(settings_.path, ignored);
    std::filesystem::remove(settings_.path + ".part", ignored);  // of a render that was killed
}

/// Opens the file, with its header. A file of another render is replaced only when there is something to put in its place.
bool Checkpoint::open_for_writing() {
    if (continues_) return true;
    if (file_ >= 0) ::close(file_);
    const std::string temporary = settings_.path + ".part";
    file_ = ::open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (file_ < 0) return false;
    const std::vector<std::byte> header = header_bytes();
    if (!write_at(file_, 0, header.data(), header.size()) || ::fsync(file_) != 0 ||
        ::rename(temporary.c_str(), settings_.path.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        errno = error;
        return false;
    }
    size_ = header.size();
    return continues_ = true;
}

/// After everything that is good so far; a part that could not be finished is cut off again.
bool Checkpoint::append(const std::vector<std::byte>& bytes) {
    if (write_at(file_, size_, bytes.data(), bytes.size())) {
        size_ += bytes.size();
        return true;
    }
    const int error = errno;
    [[maybe_unused]] const int cut = ::ftruncate(file_, static_cast<::off_t>(size_));
    errno = error;
    return false;
}

/// Whether the pictures still fit on the disk when what waits is written.
bool Checkpoint::leaves_room() const {
    if (pending_.empty() || settings_.keep_free == 0) return true;
    std::error_code unknown;
    const std::filesystem::path folder = std::filesystem::path(settings_.path).parent_path();
    const std::filesystem::space_info space =
        std::filesystem::space(folder.empty() ? "." : folder, unknown);
    return unknown || space.available >= pending_bytes_ + settings_.keep_free;
}

void Checkpoint::note_problem(const char* why) {
    problem_ = "the checkpoint \"" + settings_.path + "\" could not be written: " + why;
}

void Checkpoint::write_pending(bool sync) {
    if (sync) synced_ = Clock::now();
    const auto failed = [&](const char* why) {
        note_problem(why);
        // Memory is for rendering: what could not be written is rendered again after a resume.
        pending_.clear();
        pending_bytes_ = 0;
    };
    if (pending_.empty() && !continues_) return;
    if (!leaves_room()) return failed("the disk has no more room than the pictures need");
    if (!open_for_writing()) return failed(std::strerror(errno));
    for (const Record& record : pending_) {
        RecordHead head{kRecord, record.key.first, record.key.second, 0, record.state.size(), 0};
        head.checksum = checksum_of(head, record.state);
        ByteWriter out;
        out.put(head);
        std::vector<std::byte> bytes = out.take();
        bytes.insert(bytes.end(), record.state.begin(), record.state.end());
        const std::uint64_t start = size_ + sizeof(head);
        if (!append(bytes)) return failed(std::strerror(errno));
        places_[record.key] = {start, record.state.size()};
    }
    if (sync && ::fsync(file_) != 0) return failed(std::strerror(errno));
    pending_.clear();
    pending_bytes_ = 0;
}

}  // namespace lightsieve
