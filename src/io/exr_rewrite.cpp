#include "io/exr_rewrite.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTileDescription.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/exr_header.h"

namespace lightsieve {

namespace {

using IMATH_NAMESPACE::Box2i;
using IMATH_NAMESPACE::V2i;

/// Rows that a scanline part is copied by; a multiple of what every compression packs together.
constexpr int kBandRows = 256;

/// Whether a part must be packed in another way so that new pixels are kept as they are.
bool loses_precision(const exr::Header& header) {
    for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
        if (lightsieve::loses_precision(compression_of(header), pixel_type_of(it.channel())))
            return true;
    return false;
}

/// All channels of some rows of a part, each in its own type.
class Band {
  public:
    explicit Band(const exr::Header& header) : window_(header.dataWindow()) {
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it)
            channels_.push_back({it.name(), pixel_type_of(it.channel()), {}});
    }

    /// Makes room for rows y0 to y1, both inside.
    exr::FrameBuffer place(int y0, int y1) {
        y0_ = y0;
        y1_ = y1;
        exr::FrameBuffer buffer;
        for (Channel& channel : channels_) {
            channel.bytes.resize(width() * rows() * exr_value_size(channel.type));
            buffer.insert(
                channel.name,
                exr::Slice::Make(exr_type(channel.type), channel.bytes.data(),
                                 V2i(window_.min.x, y0), static_cast<std::int64_t>(width()),
                                 static_cast<std::int64_t>(rows())));
        }
        return buffer;
    }

    /// Puts other pixels into the channel of that place in the part.
    void replace(std::size_t index, const ExrPlane& plane) {
        Channel& channel = channels_[index];
        const std::size_t row_bytes = width() * exr_value_size(channel.type);
        for (int y = y0_; y <= y1_; ++y)
            store_exr_row(channel.type, plane.data + (y - window_.min.y) * plane.row_stride,
                          plane.pixel_stride, static_cast<int>(width()),
                          channel.bytes.data() + static_cast<std::size_t>(y - y0_) * row_bytes);
    }

  private:
    struct Channel {
        std::string name;
        ExrPixelType type;
        std::vector<char> bytes;
    };
    [[nodiscard]] std::size_t width() const {
        return static_cast<std::size_t>(window_.max.x - window_.min.x) + 1;
    }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(y1_ - y0_) + 1; }

    Box2i window_;
    int y0_ = 0, y1_ = -1;
    std::vector<Channel> channels_;
};

/// The channels of one part that change, by their place in it.
using PartChanges = std::map<std::size_t, ExrPlane>;

void replace_all(Band& band, const PartChanges& changes) {
    for (const auto& [index, plane] : changes)
        band.replace(index, plane);
}

void copy_scanlines(exr::InputPart& in, exr::OutputPart& out, const PartChanges& changes) {
    const exr::Header& header = in.header();
    const int top = header.dataWindow().min.y, bottom = header.dataWindow().max.y;
    const int n_bands = (bottom - top) / kBandRows + 1;
    Band band(header);
    for (int i = 0; i < n_bands; ++i) {
        // Rows are taken in the order in which the file keeps them.
        const int index = header.lineOrder() == exr::DECREASING_Y ? n_bands - 1 - i : i;
        const int y0 = top + index * kBandRows, y1 = std::min(y0 + kBandRows - 1, bottom);
        const exr::FrameBuffer buffer = band.place(y0, y1);
        in.setFrameBuffer(buffer);
        in.readPixels(y0, y1);
        replace_all(band, changes);
        out.setFrameBuffer(buffer);
        out.writePixels(y1 - y0 + 1);
    }
}

void copy_tiles(exr::TiledInputPart& in, exr::TiledOutputPart& out, const PartChanges& changes) {
    Band band(in.header());
    for (int row = 0; row < in.numYTiles(); ++row) {
        const Box2i tile = in.dataWindowForTile(0, row);
        const exr::FrameBuffer buffer = band.place(tile.min.y, tile.max.y);
        in.setFrameBuffer(buffer);
        in.readTiles(0, in.numXTiles() - 1, row, row);
        replace_all(band, changes);
        out.setFrameBuffer(buffer);
        out.writeTiles(0, in.numXTiles() - 1, row, row);
    }
}

void copy_part(exr::MultiPartInputFile& from, exr::MultiPartOutputFile& to, int index,
               const PartChanges& changes) {
    if (from.header(index).hasTileDescription()) {
        exr::TiledInputPart in(from, index);
        exr::TiledOutputPart out(to, index);
        changes.empty() ? out.copyPixels(in) : copy_tiles(in, out, changes);
    } else {
        exr::InputPart in(from, index);
        exr::OutputPart out(to, index);
        changes.empty() ? out.copyPixels(in) : copy_scanlines(in, out, changes);
    }
}

/// What changes in each part; throws if a part is none that can be copied.
std::vector<PartChanges> by_part(const std::string& path, const exr::MultiPartInputFile& file,
                                 const ExrChanges& changes) {
    std::vector<PartChanges> parts(static_cast<std::size_t>(file.parts()));
    std::size_t begin = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const exr::Header& header = file.header(static_cast<int>(p));
        std::size_t n = 0;
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it, ++n) {
            const auto found = changes.channels.find(begin + n);
            if (found != changes.channels.end()) parts[p].emplace(n, found->second);
        }
        begin += n;
        const bool levels =
            header.hasTileDescription() && header.tileDescription().mode != exr::ONE_LEVEL;
        if (levels && !parts[p].empty())
            throw InputError(Error{Code::FileFormat,
                                   "\"" + path + "\" holds its picture in several sizes",
                                   {},
                                   "write it with one level of tiles, or in scanlines",
                                   {},
                                   Severity::Error});
    }
    LIGHTSIEVE_ASSERT(changes.channels.empty() || changes.channels.rbegin()->first < begin,
                      "a channel that the file does not have");
    return parts;
}

}  // namespace

void rewrite_exr(const std::string& path, const std::string& output, const ExrChanges& changes) {
    AtomicFile file(output);
    guarded_exr(output, [&] {
        exr::MultiPartInputFile from(path.c_str(), 0);
        const std::vector<PartChanges> parts = by_part(path, from, changes);
        std::vector<exr::Header> headers;
        for (std::size_t p = 0; p < parts.size(); ++p) {
            exr::Header header = from.header(static_cast<int>(p));
            if (!parts[p].empty() && loses_precision(header))
                header.compression() = exr::ZIP_COMPRESSION;
            for (const auto& [name, value] : changes.attributes)
                add_exr_attribute(header, name, value);
            headers.push_back(std::move(header));
        }
        ExrFileStream stream(file.temporary());
        auto to = std::make_unique<exr::MultiPartOutputFile>(stream, headers.data(),
                                                             static_cast<int>(headers.size()));
        for (std::size_t p = 0; p < parts.size(); ++p)
            copy_part(from, *to, static_cast<int>(p), parts[p]);
        to.reset();
        stream.finish();
    });
    file.commit();
}

}  // namespace lightsieve
