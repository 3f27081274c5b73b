// lightsieve_image_reader: tries pictures for the renderer (io/image_try.h). Paths arrive on standard input, each with a zero
// byte at its end; for each a process of its own reads the picture, and standard output says in two bytes how that ended.

#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "io/image_open.h"
#include "io/image_try.h"

namespace lightsieve {

namespace {

/// How the process that reads a picture says that memory was not enough.
constexpr int kOutOfMemory = 3;
/// Rows that are read at the top and at the bottom of a large picture without tiles.
constexpr int kEndRows = 64;

void limit(__rlimit_resource resource, rlim_t value) {
    const rlimit both{value, value};
    ::setrlimit(resource, &both);
}

/// Memory that the process has now [bytes].
rlim_t memory_now() {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void limit_process() {
    limit(RLIMIT_AS, memory_now() + kTryMemory);
    limit(RLIMIT_CPU, kTrySeconds);
    limit(RLIMIT_CORE, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::ofstream("/proc/self/oom_score_adj") << 1000;
}

/// Rows [begin, end) of a level, as the texture cache asks for them. False if they cannot be read.
bool read_rows(OIIO::ImageInput& input, int level, int begin, int end, OIIO::TypeDesc format) {
    const OIIO::ImageSpec spec = input.spec_dimensions(0, level);
    std::vector<std::byte> rows(static_cast<std::size_t>(spec.width) *
                                static_cast<std::size_t>(end - begin) *
                                static_cast<std::size_t>(spec.nchannels) * format.size());
    if (spec.tile_width > 0)
        return input.read_tiles(0, level, spec.x, spec.x + spec.width, begin, end, spec.z,
                                spec.z + std::max(spec.depth, 1), 0, spec.nchannels, format,
                                rows.data());
    return input.read_scanlines(0, level, begin, end, spec.z, 0, spec.nchannels, format,
                                rows.data());
}

bool try_level(OIIO::ImageInput& input, int level) {
    const OIIO::ImageSpec spec = input.spec_dimensions(0, level);
    const bool mixed = !spec.channelformats.empty();
    const OIIO::TypeDesc format = mixed ? OIIO::TypeFloat : spec.format;
    const int step = spec.tile_width > 0 ? std::max(spec.tile_height, 1) : kEndRows;
    const int top = spec.y, bottom = spec.y + spec.height;
    const std::size_t row = static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.nchannels) * format.size();
    if (row * static_cast<std::size_t>(spec.height) > kWholeTryBytes)
        return read_rows(input, level, top, std::min(top + step, bottom), format) &&
               read_rows(input, level, top + (spec.height - 1) / step * step, bottom, format);
    for (int y = top; y < bottom; y += step)
        if (!read_rows(input, level, y, std::min(y + step, bottom), format)) return false;
    return true;
}

/// Reads the picture as the renderer would. What the library objects to is no concern here: the renderer will hear it, too.
void read_picture(const std::string& path) {
    std::string problem;
    const std::unique_ptr<OIIO::ImageInput> input = open_image(path, problem);
    if (!input || input->spec().deep || input->spec().depth > 1) return;
    for (int level = 0; input->seek_subimage(0, level); ++level)
        if (!try_level(*input, level)) return;
}

[[noreturn]] void read_and_exit(const std::string& path) {
    limit_process();
    try {
        read_picture(path);
    } catch (const std::bad_alloc&) {
        ::_exit(kOutOfMemory);
    } catch (const std::exception&) {
        // The renderer catches it as well.
    }
    ::_exit(0);
}

ImageTrial judge(int status) {
    if (WIFSIGNALED(status))
        return WTERMSIG(status) == SIGXCPU ? ImageTrial::TooSlow : ImageTrial::Crashed;
    return WEXITSTATUS(status) == kOutOfMemory ? ImageTrial::Memory : ImageTrial::Survived;
}

std::array<char, kTrialBytes> answer_for(const std::string& path) {
    const pid_t child = ::fork();
    if (child == 0) read_and_exit(path);
    int status = 0;
    // No process to be had: the renderer reads the picture untried.
    if (child < 0) return {static_cast<char>(ImageTrial::Survived), 0};
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return {static_cast<char>(judge(status)), static_cast<char>(signal)};
}

int serve() {
    // What libraries print must not come between the answers.
    const int out = ::dup(STDOUT_FILENO);
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    for (std::string path; std::getline(std::cin, path, '\0');) {
        const std::array<char, kTrialBytes> answer = answer_for(path);
        if (::write(out, answer.data(), answer.size()) != static_cast<ssize_t>(answer.size()))
            return 1;
    }
    return 0;
}

}  // namespace

}  // namespace lightsieve

int main() { return lightsieve::serve(); }
