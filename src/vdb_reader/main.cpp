// lightsieve_vdb_reader MEMORY SECONDS FILE [GRID...]: reads grids of an OpenVDB file and writes them to standard output
// as io/volume_stream.h says. The renderer runs it once a file, so that whatever a damaged file does to OpenVDB happens here.
//
// MEMORY   what it may take beyond what it has at the start [bytes]
// SECONDS  processor time that it may use
// exit     0; 1: a line on standard error says what is wrong; 2: called wrongly

#include <malloc.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <span>

#include "vdb_reader/nano_grid.h"
#include "vdb_reader/vdb_file.h"

namespace lightsieve {

namespace {

/// Standard output as it was given; descriptor 1 leads to standard error, so that no library can write between the grids.
class GridStream {
  public:
    GridStream() : out_(::dup(STDOUT_FILENO)) { ::dup2(STDERR_FILENO, STDOUT_FILENO); }

    void write(const void* data, std::size_t size) const {
        const char* at = static_cast<const char*>(data);
        while (size > 0) {
            const ssize_t n = ::write(out_, at, size);
            if (n < 0 && errno == EINTR) continue;
            if (n <= 0) throw std::runtime_error(std::strerror(errno));
            at += n;
            size -= static_cast<std::size_t>(n);
        }
    }

  private:
    int out_;
};

/// Memory that the process has now [bytes].
rlim_t memory_now() {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource resource, rlim_t value) {
    const rlimit both{value, value};
    ::setrlimit(resource, &both);
}

void limit_process(std::uint64_t memory, std::uint64_t seconds) {
    limit(RLIMIT_AS, memory_now() + memory);
    limit(RLIMIT_CPU, std::max<rlim_t>(seconds, 1));
    limit(RLIMIT_CORE, 0);
    // Should the renderer die, nobody waits for the grids; should the machine run out of memory, this goes first.
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::ofstream("/proc/self/oom_score_adj") << 1000;
}

void write_grid(const GridStream& out, VdbGrid&& grid) {
    VolumeStreamGrid head;
    const std::string name = grid.name;
    head.channels = std::holds_alternative<openvdb::FloatGrid::Ptr>(grid.voxels) ? 1 : 3;
    head.name_bytes = name.size();
    head.object_from_index = grid.object_from_index;
    with_nano_grid(std::move(grid), [&](std::span<const std::byte> block) {
        head.grid_bytes = block.size();
        out.write(&head, sizeof head);
        out.write(name.data(), name.size());
        out.write(block.data(), block.size());
    });
}

void serve(const GridStream& out, const std::string& path, std::vector<std::string> names) {
    VdbFile file(path);
    file.check_names(names);
    if (names.empty()) names = file.names_of_numbers();
    out.write(kVolumeStreamMagic.data(), kVolumeStreamMagic.size());
    for (const std::string& name : names)
        write_grid(out, file.read(name));
    const VolumeStreamGrid end;
    out.write(&end, sizeof end);
}

/// Says what is wrong, in one line of bounded length that a terminal can show: damaged files have strange names in them.
int complain(std::string line) {
    constexpr std::size_t kMaxLine = 1000;
    const auto strange = [](char c) { return (c >= 0 && c < ' ' && c != '\t') || c == 127; };
    std::replace_if(line.begin(), line.end(), strange, '?');
    if (line.size() > kMaxLine) line = line.substr(0, kMaxLine) + " ..";
    std::fprintf(stderr, "%s\n", line.c_str());
    return 1;
}

bool read_number(const char* text, std::uint64_t& number) {
    const char* end = text + std::strlen(text);
    return std::from_chars(text, end, number).ptr == end && end != text;
}

/// What the exception in flight says, as a line.
std::string complaint() {
    try {
        throw;
    } catch (const VdbError& error) {
        return error.what();
    } catch (const std::bad_alloc&) {
        return std::string(kVolumeMemory);
    } catch (const std::exception& error) {
        return std::string(kVolumeDamaged) + error.what();
    } catch (...) {
        return std::string(kVolumeDamaged);
    }
}

/// Exceptions that leave a function of a library which promised to throw none: mostly, memory has run out there.
[[noreturn]] void on_terminate() {
    if (!std::current_exception()) std::abort();
    complain(complaint());
    std::_Exit(1);
}

int run(std::span<char*> arguments) {
    std::uint64_t memory = 0, seconds = 0;
    if (arguments.size() < 4 || !read_number(arguments[1], memory) ||
        !read_number(arguments[2], seconds)) {
        std::fprintf(stderr, "usage: %s MEMORY SECONDS FILE [GRID...]\n",
                     std::string(kVolumeReaderName).c_str());
        return 2;
    }
    std::set_terminate(on_terminate);
    // Starts threads for messages, whose stacks should not count.
    openvdb::initialize();
    limit_process(memory, seconds);
    // One thread: others would reserve memory that counts against the limit, and a file is read by one anyway.
    ::mallopt(M_ARENA_MAX, 1);
    try {
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        serve(GridStream(), arguments[3], {arguments.begin() + 4, arguments.end()});
        return 0;
    } catch (...) {
        return complain(complaint());
    }
}

}  // namespace

}  // namespace lightsieve

int main(int argc, char** argv) { return lightsieve::run({argv, static_cast<std::size_t>(argc)}); }
