#include "io/volume_reader.h"

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <system_error>
#include <type_traits>

#include "core/error.h"
#include "io/child_process.h"

namespace lightsieve {

namespace {

using Read = ChildProcess::Read;

/// What the reader may take beyond twice the grids: OpenVDB's tree and NanoVDB's are there together [bytes].
constexpr std::size_t kReaderSlack = std::size_t{64} << 20;
/// Names of grids in one message.
constexpr std::size_t kMaxNamesShown = 12;

[[noreturn]] void fail(Code code, std::string message, std::string hint) {
    throw InputError(Error{code, std::move(message), {}, std::move(hint), {}, Severity::Error});
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

void check_file(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code ec;
    if (!fs::exists(path, ec))
        fail(Code::FileNotFound, "there is no file " + in_quotes(path),
             "check the name and the folder");
    // A pipe or a device could keep the reader waiting.
    if (!fs::is_regular_file(path, ec))
        fail(Code::FileUnreadable, in_quotes(path) + " is not a file",
             "give the name of an OpenVDB file");
    if (!std::ifstream(path))
        fail(Code::FileUnreadable, in_quotes(path) + " cannot be read",
             "check the file's permissions");
}

/// A size as people read it.
std::string size_text(std::size_t bytes) {
    const double mib = static_cast<double>(bytes) / (1 << 20);
    const auto rounded = [](double x) { return std::to_string(std::llround(std::max(x, 1.0))); };
    return mib < 1024 ? rounded(mib) + " MiB" : rounded(mib / 1024) + " GiB";
}

[[noreturn]] void too_large(const std::string& path, const VolumeLimits& limits) {
    fail(Code::LimitVolume,
         in_quotes(path) + " needs more than " + size_text(limits.max_bytes) + " of memory",
         "name only the grids that are needed, or write it with fewer voxels");
}

[[noreturn]] void too_slow(const std::string& path, const VolumeLimits& limits) {
    fail(Code::LimitVolume,
         "reading " + in_quotes(path) + " took longer than " +
             std::to_string(std::llround(limits.max_seconds)) + " s",
         "name only the grids that are needed; if it is small, the file is damaged: write it "
         "again");
}

[[noreturn]] void reader_failed(const std::string& what, const std::string& hint) {
    fail(Code::VolumeReader, what, hint);
}

constexpr const char* kInstallHint =
    "install Lightsieve again: the program belongs beside its module";

std::vector<std::string_view> fields(std::string_view line) {
    std::vector<std::string_view> out;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find('\t', begin), line.size());
        out.push_back(line.substr(begin, end - begin));
        begin = end + 1;
    }
    return out;
}

[[noreturn]] void grid_missing(const std::string& path,
                               const std::vector<std::string_view>& names) {
    std::string hint = names.size() == 1 ? "the file holds no grids" : "it has";
    for (std::size_t i = 1; i < std::min(names.size(), kMaxNamesShown + 1); ++i)
        hint += (i == 1 ? " " : ", ") + in_quotes(names[i]);
    if (names.size() > kMaxNamesShown + 1)
        hint += " and " + std::to_string(names.size() - kMaxNamesShown - 1) + " more";
    fail(Code::UnknownGrid, in_quotes(path) + " has no grid " + in_quotes(names[0]), hint);
}

/// Raises what the reader said on standard error, if it said something that it should.
void raise_complaint(const std::string& path, std::string_view text, const VolumeLimits& limits) {
    const auto detail_of = [text](std::string_view kind) -> std::optional<std::string_view> {
        const std::size_t at = text.find(kind);
        if (at == std::string_view::npos) return std::nullopt;
        const std::string_view rest = text.substr(at + kind.size());
        return rest.substr(0, rest.find('\n'));
    };
    if (const auto detail = detail_of(kVolumeGridMissing)) grid_missing(path, fields(*detail));
    if (const auto detail = detail_of(kVolumeGridUnusable)) {
        const std::vector<std::string_view> parts = fields(*detail);
        fail(Code::VolumeGrid,
             "grid " + in_quotes(parts.front()) + " of " + in_quotes(path) +
                 " cannot be used: " + std::string(parts.back()),
             "leave it out, or write it as floats or vectors with a linear transform");
    }
    if (detail_of(kVolumeMemory)) too_large(path, limits);
    if (const auto detail = detail_of(kVolumeDamaged))
        fail(Code::FileFormat,
             in_quotes(path) + " cannot be read as an OpenVDB file: " + std::string(*detail),
             "write the file again, or check how it was copied");
}

/// Raises what the end of the reader says; returns if there is nothing wrong with it.
void raise_ending(const std::string& path, const ChildProcess::Ending& ending,
                  std::string_view errors, const VolumeLimits& limits) {
    if (ending.timed_out || ending.signal == SIGXCPU) too_slow(path, limits);
    if (ending.signal != 0)
        reader_failed("the reader of OpenVDB files was stopped at " + in_quotes(path) +
                          " by signal " + std::to_string(ending.signal) + " (" +
                          ::strsignal(ending.signal) + ")",
                      ending.signal == SIGKILL
                          ? "memory may have run out: name only the grids that are needed"
                          : "the file is probably damaged: write it again");
    if (ending.exit_code == 0) return;
    raise_complaint(path, errors, limits);
    if (ending.exit_code > 0)
        reader_failed("the reader of OpenVDB files ended at " + in_quotes(path) + " with code " +
                          std::to_string(ending.exit_code),
                      kInstallHint);
}

/// The pieces of the stream, each checked before memory is taken for it.
class GridReader {
  public:
    GridReader(ChildProcess& child, const std::string& path, const VolumeLimits& limits)
        : child_(child), path_(path), limits_(limits) {}

    std::vector<RawVolumeGrid> read_all() {
        std::vector<RawVolumeGrid> grids;
        if (read<std::remove_const_t<decltype(kVolumeStreamMagic)>>() != kVolumeStreamMagic)
            nonsense();
        for (;;) {
            const auto head = read<VolumeStreamGrid>();
            if (head.channels == 0) break;
            if ((head.channels != 1 && head.channels != 3) ||
                head.name_bytes > kMaxVolumeNameBytes)
                nonsense();
            grids.push_back(read_grid(head));
        }
        end();
        return grids;
    }

  private:
    template <class T>
    T read() {
        T value{};
        read(std::as_writable_bytes(std::span(&value, 1)));
        return value;
    }
    void read(std::span<std::byte> out) {
        const Read done = child_.read(out);
        if (done == Read::TimedOut) too_slow(path_, limits_);
        if (done == Read::Ended) {
            end();
            nonsense();
        }
    }
    RawVolumeGrid read_grid(const VolumeStreamGrid& head) {
        if (head.grid_bytes > limits_.max_bytes - taken_) too_large(path_, limits_);
        taken_ += head.grid_bytes;
        RawVolumeGrid grid;
        grid.n_channels = static_cast<int>(head.channels);
        grid.object_from_index = head.object_from_index;
        grid.name.resize(head.name_bytes);
        read(std::as_writable_bytes(std::span(grid.name)));
        grid.block = VolumeBlock(head.grid_bytes);
        read(grid.block.bytes());
        return grid;
    }
    void end() { raise_ending(path_, child_.finish(), child_.errors(), limits_); }
    [[noreturn]] void nonsense() const {
        reader_failed(
            "the reader of OpenVDB files gave no complete answer about " + in_quotes(path_),
            kInstallHint);
    }

    ChildProcess& child_;
    const std::string& path_;
    const VolumeLimits& limits_;
    std::size_t taken_ = 0;
};

std::vector<std::string> reader_arguments(const std::string& path,
                                          std::span<const std::string> names,
                                          const VolumeLimits& limits) {
    const double seconds = std::clamp(std::ceil(limits.max_seconds), 1.0, 1e8);
    std::vector<std::string> arguments{std::to_string(2 * limits.max_bytes + kReaderSlack),
                                       std::to_string(static_cast<long long>(seconds)), path};
    for (const std::string& name : names)
        if (std::find(arguments.begin() + 3, arguments.end(), name) == arguments.end())
            arguments.push_back(name);
    return arguments;
}

}  // namespace

VolumeBlock::VolumeBlock(std::size_t size)
    : bytes_(
          static_cast<std::byte*>(::operator new(size, std::align_val_t{kVolumeGridAlignment}))),
      size_(size) {}

void VolumeBlock::Delete::operator()(std::byte* bytes) const {
    ::operator delete(bytes, std::align_val_t{kVolumeGridAlignment});
}

std::string volume_reader_path() { return helper_path(kVolumeReaderName); }

std::vector<RawVolumeGrid> run_volume_reader(const std::string& reader, const std::string& path,
                                             std::span<const std::string> names,
                                             const VolumeLimits& limits) {
    check_file(path);
    try {
        ChildProcess child(reader, reader_arguments(path, names, limits), limits.max_seconds);
        return GridReader(child, path, limits).read_all();
    } catch (const std::bad_alloc&) {
        too_large(path, limits);
    } catch (const std::system_error& error) {
        reader_failed("the program that reads OpenVDB files, " + in_quotes(reader) +
                          ", cannot be started: " + error.code().message(),
                      kInstallHint);
    }
}

}  // namespace lightsieve
