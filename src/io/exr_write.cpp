#include "io/exr_write.h"

#include <ImfFrameBuffer.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfTiledOutputPart.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/exr_header.h"

namespace lightsieve {

namespace {

using IMATH_NAMESPACE::V2i;

constexpr int kMaxTileSize = 4096;

void check_spec(const std::string& path, const ExrWriteSpec& spec) {
    const bool sized =
        spec.width > 0 && spec.height > 0 && spec.data_width > 0 && spec.data_height > 0;
    if (!sized) refuse_exr(path, "the picture is empty", "choose a larger resolution or region");
    if (spec.tile_size < 1 || spec.tile_size > kMaxTileSize)
        refuse_exr(path, "tiles of " + std::to_string(spec.tile_size) + " pixels",
                   "choose a bucket_size from 1 to " + std::to_string(kMaxTileSize));
    std::set<std::string> names;
    for (const ExrPart& part : spec.parts) {
        if (part.channels.empty())
            refuse_exr(path, "a part has no channels", "give the driver an output");
        if (!names.insert(part.name).second)
            refuse_exr(path, "two parts are named \"" + part.name + "\"",
                       "give one of the outputs a layer name");
    }
    if (spec.parts.empty())
        refuse_exr(path, "there is nothing to write", "give the driver an output");
}

/// A tile, or a band of rows: the unit in which OpenEXR takes pixels.
struct Block {
    int x = 0, y = 0, width = 0, height = 0;  ///< in the data window
    std::size_t n_missing = 0;                ///< pixels that have not come yet
    std::vector<char> bytes;                  ///< channel after channel
    [[nodiscard]] std::size_t n_pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

struct Rect {
    int x0, y0, x1, y1;  ///< x1, y1 are outside
};

}  // namespace

struct ExrWriter::State {
    State(const std::string& path, ExrWriteSpec s) : spec(std::move(s)), file(path) {
        block_width = spec.tiled ? spec.tile_size : spec.data_width;
        block_height = spec.tile_size;
        n_across = (spec.data_width + block_width - 1) / block_width;
        n_down = (spec.data_height + block_height - 1) / block_height;
        written.assign(static_cast<std::size_t>(n_across) * static_cast<std::size_t>(n_down),
                       false);
        for (const ExrPart& part : spec.parts) {
            for (const ExrChannel& channel : part.channels) {
                types.push_back(channel.type);
                pixel_offset.push_back(bytes_per_pixel);
                bytes_per_pixel += exr_value_size(channel.type);
            }
        }
    }

    [[nodiscard]] Block make_block(int index) const {
        Block block;
        block.x = index % n_across * block_width;
        block.y = index / n_across * block_height;
        block.width = std::min(block_width, spec.data_width - block.x);
        block.height = std::min(block_height, spec.data_height - block.y);
        block.n_missing = block.n_pixels();
        block.bytes.resize(block.n_pixels() * bytes_per_pixel);
        return block;
    }

    /// Copies the part of `rect` (data window) that lies in a block. `origin_*`: where `planes` begin.
    void fill(Block& block, const Rect& rect, int origin_x, int origin_y,
              std::span<const ExrPlane> planes) const {
        const Rect part{std::max(rect.x0, block.x), std::max(rect.y0, block.y),
                        std::min(rect.x1, block.x + block.width),
                        std::min(rect.y1, block.y + block.height)};
        const int n = part.x1 - part.x0;
        for (std::size_t c = 0; c < planes.size(); ++c) {
            const ExrPlane& plane = planes[c];
            char* const channel = block.bytes.data() + pixel_offset[c] * block.n_pixels();
            for (int y = part.y0; y < part.y1; ++y) {
                const float* from = plane.data + (y - origin_y) * plane.row_stride +
                                    (part.x0 - origin_x) * plane.pixel_stride;
                const auto at =
                    static_cast<std::size_t>(y - block.y) * static_cast<std::size_t>(block.width) +
                    static_cast<std::size_t>(part.x0 - block.x);
                store_exr_row(types[c], from, plane.pixel_stride, n,
                              channel + at * exr_value_size(types[c]));
            }
        }
        const auto area =
            static_cast<std::size_t>(n) * static_cast<std::size_t>(part.y1 - part.y0);
        block.n_missing -= std::min(area, block.n_missing);
    }

    /// Hands a complete block to OpenEXR.
    void emit(int index, Block& block) {
        std::size_t c = 0;
        for (int p = 0; p < static_cast<int>(spec.parts.size()); ++p) {
            exr::FrameBuffer buffer;
            for (const ExrChannel& channel : spec.parts[static_cast<std::size_t>(p)].channels) {
                buffer.insert(
                    channel.name,
                    exr::Slice::Make(exr_type(channel.type),
                                     block.bytes.data() + pixel_offset[c] * block.n_pixels(),
                                     V2i(spec.data_x + block.x, spec.data_y + block.y),
                                     block.width, block.height));
                ++c;
            }
            if (spec.tiled) {
                exr::TiledOutputPart part(*output, p);
                part.setFrameBuffer(buffer);
                part.writeTile(index % n_across, index / n_across);
            } else {
                exr::OutputPart part(*output, p);
                part.setFrameBuffer(buffer);
                part.writePixels(block.height);
            }
        }
        written[static_cast<std::size_t>(index)] = true;
    }

    /// Emits what can be emitted: any complete tile, or complete bands from the top.
    void flush() {
        for (auto it = pending.begin(); it != pending.end();) {
            const bool in_turn =
                spec.tiled || it->first == 0 || written[static_cast<std::size_t>(it->first) - 1];
            if (!in_turn) break;
            if (it->second.n_missing > 0) {
                if (!spec.tiled) break;
                ++it;
                continue;
            }
            emit(it->first, it->second);
            it = pending.erase(it);
        }
    }

    ExrWriteSpec spec;
    AtomicFile file;
    int block_width = 0, block_height = 0, n_across = 0, n_down = 0;
    std::vector<ExrPixelType> types;        ///< of all channels, part after part
    std::vector<std::size_t> pixel_offset;  ///< bytes of the channels before, for one pixel
    std::size_t bytes_per_pixel = 0;
    std::map<int, Block> pending;         ///< begun, by number
    std::vector<bool> written;            ///< by number
    std::optional<ExrFileStream> stream;  ///< outlives `output`
    std::unique_ptr<exr::MultiPartOutputFile> output;
};

ExrWriter::ExrWriter(const std::string& path, ExrWriteSpec spec) {
    check_spec(path, spec);
    state_ = std::make_unique<State>(path, std::move(spec));
    State& s = *state_;
    guarded_exr(path, [&s] {
        std::vector<exr::Header> headers;
        for (const ExrPart& part : s.spec.parts)
            headers.push_back(make_exr_header(s.spec, part));
        s.stream.emplace(s.file.temporary());
        s.output = std::make_unique<exr::MultiPartOutputFile>(*s.stream, headers.data(),
                                                              static_cast<int>(headers.size()));
    });
}

ExrWriter::~ExrWriter() = default;

void ExrWriter::write(int x, int y, int width, int height, std::span<const ExrPlane> planes) {
    State& s = *state_;
    LIGHTSIEVE_ASSERT(planes.size() == s.types.size(),
                      std::to_string(planes.size()) + " planes for " +
                          std::to_string(s.types.size()) + " channels");
    const int left = x - s.spec.data_x, top = y - s.spec.data_y;
    const Rect rect{std::max(left, 0), std::max(top, 0), std::min(left + width, s.spec.data_width),
                    std::min(top + height, s.spec.data_height)};
    if (rect.x0 >= rect.x1 || rect.y0 >= rect.y1) return;
    guarded_exr(s.file.path(), [&] {
        for (int by = rect.y0 / s.block_height; by <= (rect.y1 - 1) / s.block_height; ++by) {
            for (int bx = rect.x0 / s.block_width; bx <= (rect.x1 - 1) / s.block_width; ++bx) {
                const int index = by * s.n_across + bx;
                if (s.written[static_cast<std::size_t>(index)]) continue;
                auto it = s.pending.find(index);
                if (it == s.pending.end())
                    it = s.pending.emplace(index, s.make_block(index)).first;
                s.fill(it->second, rect, left, top, planes);
            }
        }
        s.flush();
    });
}

void ExrWriter::close() {
    State& s = *state_;
    guarded_exr(s.file.path(), [&s] {
        for (int index = 0; index < s.n_across * s.n_down; ++index) {
            if (s.written[static_cast<std::size_t>(index)]) continue;
            const auto it = s.pending.find(index);
            Block block = it == s.pending.end() ? s.make_block(index) : std::move(it->second);
            if (it != s.pending.end()) s.pending.erase(it);
            s.emit(index, block);
        }
        s.output.reset();
        s.stream->finish();
    });
    s.file.commit();
}

}  // namespace lightsieve
