// Files on disk, gzip or plain. The only place of the scene layer that knows zlib.
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "scene/ass_read.h"

namespace lightsieve {
namespace {

/// Bytes read at once.
constexpr unsigned kChunk = 1U << 20U;

struct GzClose {
    void operator()(gzFile_s* file) const { gzclose(file); }
};

}  // namespace

std::optional<std::string> read_text_file(const std::string& path, Diagnostics& diagnostics,
                                          std::size_t max_bytes) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        diagnostics.error(Code::FileNotFound, "file \"" + path + "\" does not exist");
        return std::nullopt;
    }
    if (std::filesystem::is_directory(status)) {
        diagnostics.error(Code::FileUnreadable, "\"" + path + "\" is a folder");
        return std::nullopt;
    }
    const std::unique_ptr<gzFile_s, GzClose> file(gzopen(path.c_str(), "rb"));
    if (!file) {
        diagnostics.error(Code::FileUnreadable,
                          "file \"" + path + "\" cannot be read: " + std::strerror(errno));
        return std::nullopt;
    }
    gzbuffer(file.get(), kChunk / 4);
    // Plain files: one allocation of the right size. Compressed ones grow with what is really there.
    std::string text;
    if (gzdirect(file.get()) == 1) {
        const std::uintmax_t size = std::filesystem::file_size(path, error);
        if (!error && size <= max_bytes) text.reserve(static_cast<std::size_t>(size) + kChunk);
    }
    for (;;) {
        const std::size_t before = text.size();
        text.resize(before + kChunk);
        const int n = gzread(file.get(), text.data() + before, kChunk);
        text.resize(before + static_cast<std::size_t>(std::max(n, 0)));
        if (text.size() > max_bytes) {
            diagnostics.error(Code::LimitFileSize, "file \"" + path + "\" is too large", {},
                              "at most " + std::to_string(max_bytes) +
                                  " bytes after decompression (kMaxSceneBytes)");
            return std::nullopt;
        }
        if (n <= 0) break;
    }
    // A gzip file that ends too early reads to its end without an error but says so here.
    int code = Z_OK;
    const char* message = gzerror(file.get(), &code);
    if (code != Z_OK && code != Z_STREAM_END) {
        diagnostics.error(Code::FileFormat,
                          "file \"" + path + "\" cannot be decompressed: " + std::string(message),
                          {}, "the file is damaged or cut off");
        return std::nullopt;
    }
    return text;
}

}  // namespace lightsieve
