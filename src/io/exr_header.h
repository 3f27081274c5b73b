// What all that writes OpenEXR files shares: the header, the stream, values in the file's types, errors.
#pragma once

#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfPixelType.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/error.h"
#include "io/exr_write.h"

namespace lightsieve {

namespace exr = OPENEXR_IMF_NAMESPACE;

/// Largest finite half; greater values are clamped to it.
inline constexpr float kHalfMax = 65504.0F;

[[noreturn]] void refuse_exr(const std::string& path, const std::string& why,
                             const std::string& hint);

/// Runs `body`; what OpenEXR throws becomes an InputError about `path`.
template <class Body>
void guarded_exr(const std::string& path, const Body& body) {
    try {
        body();
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& e) {
        refuse_exr(path, e.what(), "check the free space of the disk and the channels' names");
    }
}

/// A stream that remembers failures: OpenEXR's own file class writes the index of tiles in its destructor, where an
/// error would be lost.
class ExrFileStream final : public exr::OStream {
  public:
    explicit ExrFileStream(const std::string& path)
        : OStream(path.c_str()), file_(std::fopen(path.c_str(), "wb")) {
        if (file_ == nullptr) throw std::runtime_error(std::strerror(errno));
    }
    ~ExrFileStream() override {
        if (file_ != nullptr) std::fclose(file_);
    }
    ExrFileStream(const ExrFileStream&) = delete;
    ExrFileStream& operator=(const ExrFileStream&) = delete;

    void write(const char c[], int n) override {
        if (n <= 0) return;
        if (std::fwrite(c, 1, static_cast<std::size_t>(n), file_) != static_cast<std::size_t>(n))
            fail();
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(ftello(file_)); }
    void seekp(std::uint64_t pos) override {
        if (fseeko(file_, static_cast<off_t>(pos), SEEK_SET) != 0) fail();
    }
    /// Flushes and closes. Throws if any write failed, also one in a destructor of OpenEXR.
    void finish() {
        const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
        if (error_ == 0 && !closed) error_ = errno;
        if (error_ != 0) throw std::runtime_error(std::strerror(error_));
    }

  private:
    [[noreturn]] void fail() {
        if (error_ == 0) error_ = errno;
        throw std::runtime_error(std::strerror(error_));
    }
    std::FILE* file_;
    int error_ = 0;
};

[[nodiscard]] exr::PixelType exr_type(ExrPixelType type);
[[nodiscard]] ExrPixelType pixel_type_of(const exr::Channel& channel);
[[nodiscard]] ExrCompression compression_of(const exr::Header& header);

/// Bytes of one value.
[[nodiscard]] std::size_t exr_value_size(ExrPixelType type);

/// Stores `n` values of one channel, `stride` floats apart, in the file's type.
void store_exr_row(ExrPixelType type, const float* from, std::ptrdiff_t stride, int n, char* to);

/// Adds an attribute, or replaces one of that type. Throws for those that OpenEXR keeps itself.
void add_exr_attribute(exr::Header& header, const std::string& name, const ExrAttribute& value);

/// Everything of a part's header but what only deep files have. Throws what OpenEXR throws.
[[nodiscard]] exr::Header make_exr_header(const ExrWriteSpec& spec, const ExrPart& part);

}  // namespace lightsieve
