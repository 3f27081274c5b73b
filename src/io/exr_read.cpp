#include "io/exr_read.h"

#include <ImfChannelList.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <new>
#include <set>

#include "core/error.h"
#include "io/exr_header.h"

namespace lightsieve {

namespace {

using IMATH_NAMESPACE::Box2i;

[[noreturn]] void fail(Code code, std::string message, std::string hint) {
    throw InputError(Error{code, std::move(message), {}, std::move(hint), {}, Severity::Error});
}

[[noreturn]] void damaged(const std::string& path, const std::string& why) {
    fail(Code::FileFormat, "\"" + path + "\" cannot be read as an OpenEXR picture: " + why,
         "write the file again, or check how it was copied");
}

/// Larger tiles are a sign of damage; OpenEXR would take memory for them before it looks at the file's length.
constexpr int kMaxTileSize = 8192;

/// Runs `body`; what OpenEXR throws becomes an InputError about `path`.
template <class Body>
auto guarded(const std::string& path, const Body& body) {
    // A limit of the whole process; setting it again changes nothing.
    exr::Header::setMaxTileSize(kMaxTileSize, kMaxTileSize);
    try {
        return body();
    } catch (const InputError&) {
        throw;
    } catch (const std::bad_alloc&) {
        fail(Code::LimitImageSize, "\"" + path + "\" needs more memory than there is",
             "read it on a larger machine, or write fewer layers");
    } catch (const std::exception& e) {
        damaged(path, e.what());
    }
}

void check_exists(const std::string& path) {
    std::error_code ec;
    if (!std::filesystem::exists(path, ec))
        fail(Code::FileNotFound, "there is no file \"" + path + "\"",
             "check the name and the folder");
    if (std::filesystem::is_directory(path, ec))
        fail(Code::FileUnreadable, "\"" + path + "\" is a folder",
             "give the name of an OpenEXR file");
}

/// Four bytes, the lowest first.
std::uint32_t read_word(std::istream& in) {
    std::array<unsigned char, 4> bytes{};
    in.read(reinterpret_cast<char*>(bytes.data()), bytes.size());
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
        word |= std::uint32_t{bytes[i]} << (8 * i);
    return word;
}

/// Walks over the attributes of all headers and checks that each ends within the file: OpenEXR takes memory for an
/// attribute's length, whatever it says, before it reads. Anything else that is wrong is left to OpenEXR.
/// Source: "OpenEXR File Layout", Component Three.
void check_attribute_sizes(const std::string& path) {
    constexpr std::size_t kMaxName = 256;
    constexpr std::uint32_t kMagic = 20000630, kMultipartFlag = 0x1000;
    std::ifstream in(path, std::ios::binary | std::ios::ate);
    const std::streamoff end = in.tellg();
    in.seekg(0);
    if (read_word(in) != kMagic) return;
    const std::uint32_t version = read_word(in);
    std::string name, type;
    for (bool header_began = false; in;) {
        std::getline(in, name, '\0');
        if (name.size() > kMaxName) return;
        if (name.empty()) {
            // An empty name ends a header; the only one, or the list of them if there is nothing before it.
            if (!header_began || (version & kMultipartFlag) == 0) return;
            header_began = false;
            continue;
        }
        header_began = true;
        std::getline(in, type, '\0');
        const std::uint32_t size = read_word(in);
        if (!in) return;
        if (size > end - in.tellg())
            damaged(path, "its header attribute \"" + name + "\" is longer than the file");
        in.seekg(size, std::ios::cur);
    }
}

/// Channels of later parts carry their part's name unless they already do.
std::string full_name(const exr::Header& header, int part, const std::string& channel) {
    if (part == 0 || !header.hasName() || channel.find('.') != std::string::npos ||
        channel == header.name())
        return channel;
    return header.name() + "." + channel;
}

void read_attributes(const exr::Header& header, std::map<std::string, ExrAttribute>& out) {
    // What describes the file itself has members of its own.
    static const std::set<std::string> kStructural = {
        "chunkCount", "name", "pixelAspectRatio", "screenWindowWidth", "type", "version"};
    for (auto it = header.begin(); it != header.end(); ++it) {
        if (kStructural.contains(it.name())) continue;
        const exr::Attribute& a = it.attribute();
        if (const auto* i = dynamic_cast<const exr::IntAttribute*>(&a))
            out.emplace(it.name(), i->value());
        if (const auto* f = dynamic_cast<const exr::FloatAttribute*>(&a))
            out.emplace(it.name(), f->value());
        if (const auto* s = dynamic_cast<const exr::StringAttribute*>(&a))
            out.emplace(it.name(), s->value());
        if (const auto* v = dynamic_cast<const exr::FloatVectorAttribute*>(&a))
            out.emplace(it.name(), v->value());
        if (const auto* m = dynamic_cast<const exr::M44fAttribute*>(&a))
            out.emplace(it.name(),
                        std::vector<float>(m->value().getValue(), m->value().getValue() + 16));
    }
}

/// Width of a window as OpenEXR counts it: both ends inside. 64 bits, because a header may say anything.
std::int64_t extent(int first, int last) { return std::int64_t{last} - first + 1; }

void read_windows(const std::string& path, const exr::Header& header, ExrFile& out) {
    const Box2i& display = header.displayWindow();
    const Box2i& data = header.dataWindow();
    const std::int64_t sizes[] = {extent(display.min.x, display.max.x),
                                  extent(display.min.y, display.max.y),
                                  extent(data.min.x, data.max.x), extent(data.min.y, data.max.y)};
    for (const std::int64_t size : sizes) {
        if (size < 1 || size > (std::int64_t{1} << 30))
            damaged(path, "its windows are " + std::to_string(size) + " pixels wide or high");
    }
    out.width = static_cast<int>(sizes[0]);
    out.height = static_cast<int>(sizes[1]);
    out.data_width = static_cast<int>(sizes[2]);
    out.data_height = static_cast<int>(sizes[3]);
    out.data_x = static_cast<int>(std::int64_t{data.min.x} - display.min.x);
    out.data_y = static_cast<int>(std::int64_t{data.min.y} - display.min.y);
}

/// Everything but pixels, from an open file.
ExrFile read_headers(const std::string& path, const exr::MultiPartInputFile& file) {
    ExrFile out;
    out.n_parts = file.parts();
    for (int p = 0; p < file.parts(); ++p) {
        const exr::Header& header = file.header(p);
        if (header.hasType() &&
            (header.type() == exr::DEEPSCANLINE || header.type() == exr::DEEPTILE)) {
            fail(Code::FileFormat, "\"" + path + "\" holds deep pixels, which are not supported",
                 "flatten it first");
        }
        if (p == 0) {
            read_windows(path, header, out);
            out.pixel_aspect_ratio = header.pixelAspectRatio();
            out.tiled = header.hasTileDescription();
            out.compression = compression_of(header);
            read_attributes(header, out.attributes);
        } else if (header.dataWindow() != file.header(0).dataWindow()) {
            fail(Code::FileFormat,
                 "the parts of \"" + path +
                     "\" have different data windows, which is not supported",
                 "write all parts with one data window");
        }
        for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
            if (it.channel().xSampling != 1 || it.channel().ySampling != 1) {
                fail(Code::FileFormat,
                     "channel \"" + std::string(it.name()) + "\" of \"" + path +
                         "\" is subsampled, which is not supported",
                     "convert the file to RGB");
            }
            out.channels.push_back(
                {full_name(header, p, it.name()), pixel_type_of(it.channel()), {}});
        }
    }
    return out;
}

void read_pixels(exr::MultiPartInputFile& file, const std::string& path, ExrFile& out) {
    std::size_t next = 0;
    for (int p = 0; p < file.parts(); ++p) {
        exr::InputPart part(file, p);
        if (!part.isComplete()) damaged(path, "it ends before its last pixel");
        const Box2i data = part.header().dataWindow();
        exr::FrameBuffer buffer;
        for (auto it = part.header().channels().begin(); it != part.header().channels().end();
             ++it) {
            ExrReadChannel& channel = out.channels[next++];
            channel.pixels.resize(static_cast<std::size_t>(out.data_width) *
                                  static_cast<std::size_t>(out.data_height));
            const exr::PixelType type =
                channel.type == ExrPixelType::UInt ? exr::UINT : exr::FLOAT;
            buffer.insert(it.name(), exr::Slice::Make(type, channel.pixels.data(), data));
        }
        part.setFrameBuffer(buffer);
        part.readPixels(data.min.y, data.max.y);
    }
}

}  // namespace

bool loses_precision(ExrCompression compression, ExrPixelType type) {
    switch (compression) {
        case ExrCompression::B44:
        case ExrCompression::B44a: return type == ExrPixelType::Half;
        case ExrCompression::Pxr24: return type == ExrPixelType::Float;
        case ExrCompression::Dwaa:
        case ExrCompression::Dwab: return true;
        default: return false;
    }
}

const ExrReadChannel* ExrFile::find(const std::string& name) const {
    const auto it = std::find_if(channels.begin(), channels.end(),
                                 [&](const ExrReadChannel& c) { return c.name == name; });
    return it == channels.end() ? nullptr : &*it;
}

ExrFile read_exr_header(const std::string& path) {
    check_exists(path);
    return guarded(path, [&] {
        check_attribute_sizes(path);
        const exr::MultiPartInputFile file(path.c_str(), 0);
        return read_headers(path, file);
    });
}

ExrFile read_exr(const std::string& path, std::size_t max_bytes) {
    check_exists(path);
    return guarded(path, [&] {
        check_attribute_sizes(path);
        exr::MultiPartInputFile file(path.c_str(), 0);
        ExrFile out = read_headers(path, file);
        const std::size_t n_pixels =
            static_cast<std::size_t>(out.data_width) * static_cast<std::size_t>(out.data_height);
        const std::size_t n_channels = std::max<std::size_t>(1, out.channels.size());
        if (n_pixels > max_bytes / sizeof(float) / n_channels) {
            fail(Code::LimitImageSize,
                 "\"" + path + "\" has " + std::to_string(out.data_width) + "x" +
                     std::to_string(out.data_height) + " pixels of " + std::to_string(n_channels) +
                     " channels, more than " + std::to_string(max_bytes >> 20) + " MiB",
                 "write fewer layers into one file, or a smaller region");
        }
        read_pixels(file, path, out);
        return out;
    });
}

}  // namespace lightsieve
