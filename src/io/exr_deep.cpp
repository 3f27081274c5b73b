#include "io/exr_deep.h"

#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfDeepTiledOutputFile.h>
#include <ImfPartType.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/exr_header.h"

namespace lightsieve {

namespace {

/// A channel's values in the file's type, and where each pixel's begin.
struct StoredChannel {
    std::vector<char> bytes;
    std::vector<char*> pixels;
};

StoredChannel stored(const ExrChannel& channel, const std::vector<float>& values,
                     const std::vector<std::uint32_t>& counts) {
    const std::size_t size = channel.type == ExrPixelType::Half ? sizeof(half) : sizeof(float);
    StoredChannel out;
    out.bytes.resize(std::max<std::size_t>(values.size(), 1) * size);
    for (std::size_t i = 0; i < values.size(); ++i) {
        char* const to = out.bytes.data() + i * size;
        if (channel.type == ExrPixelType::Half) {
            const float v = values[i];
            const half h(std::isfinite(v) ? std::clamp(v, -kHalfMax, kHalfMax) : v);
            std::memcpy(to, &h, size);
        } else {
            std::memcpy(to, &values[i], size);
        }
    }
    std::size_t at = 0;
    for (const std::uint32_t n : counts) {
        out.pixels.push_back(out.bytes.data() + at * size);
        at += n;
    }
    return out;
}

/// What a slice's base must be so that OpenEXR finds the data window's first pixel at `first`.
char* base_of(void* first, const ExrWriteSpec& spec, std::size_t pixel_size) {
    const std::ptrdiff_t before =
        static_cast<std::ptrdiff_t>(spec.data_y) * spec.data_width + spec.data_x;
    return reinterpret_cast<char*>(reinterpret_cast<std::uintptr_t>(first) -
                                   static_cast<std::uintptr_t>(before) * pixel_size);
}

void write_pixels(exr::OStream& stream, exr::Header header, const ExrWriteSpec& spec,
                  const exr::DeepFrameBuffer& buffer) {
    header.setType(spec.tiled ? exr::DEEPTILE : exr::DEEPSCANLINE);
    header.lineOrder() = exr::INCREASING_Y;
    if (spec.tiled) {
        exr::DeepTiledOutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    } else {
        exr::DeepScanLineOutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(spec.data_height);
    }
}

}  // namespace

void write_deep_exr(const std::string& path, const ExrWriteSpec& spec, const DeepPixels& pixels) {
    LIGHTSIEVE_ASSERT(spec.parts.size() == 1, std::to_string(spec.parts.size()) + " parts");
    const std::vector<ExrChannel>& channels = spec.parts[0].channels;
    LIGHTSIEVE_ASSERT(channels.size() == pixels.channels.size(),
                      std::to_string(pixels.channels.size()) + " channels of values");
    AtomicFile file(path);
    guarded_exr(path, [&] {
        std::vector<std::uint32_t> counts = pixels.counts;
        std::vector<StoredChannel> all;
        for (std::size_t c = 0; c < channels.size(); ++c)
            all.push_back(stored(channels[c], pixels.channels[c], counts));
        exr::DeepFrameBuffer buffer;
        const auto row = static_cast<std::size_t>(spec.data_width);
        buffer.insertSampleCountSlice(
            exr::Slice(exr::UINT, base_of(counts.data(), spec, sizeof(std::uint32_t)),
                       sizeof(std::uint32_t), sizeof(std::uint32_t) * row));
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const std::size_t size =
                channels[c].type == ExrPixelType::Half ? sizeof(half) : sizeof(float);
            buffer.insert(channels[c].name,
                          exr::DeepSlice(exr_type(channels[c].type),
                                         base_of(all[c].pixels.data(), spec, sizeof(char*)),
                                         sizeof(char*), sizeof(char*) * row, size));
        }
        ExrFileStream stream(file.temporary());
        write_pixels(stream, make_exr_header(spec, spec.parts[0]), spec, buffer);
        stream.finish();
    });
    file.commit();
}

}  // namespace lightsieve
