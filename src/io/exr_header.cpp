#include "io/exr_header.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFloatAttribute.h>
#include <ImfFloatVectorAttribute.h>
#include <ImfIntAttribute.h>
#include <ImfMatrixAttribute.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTileDescription.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lightsieve {

namespace {

using IMATH_NAMESPACE::Box2i;
using IMATH_NAMESPACE::V2f;
using IMATH_NAMESPACE::V2i;

/// Header attributes that OpenEXR writes itself.
const std::set<std::string> kReserved = {"channels",
                                         "compression",
                                         "dataWindow",
                                         "displayWindow",
                                         "lineOrder",
                                         "pixelAspectRatio",
                                         "screenWindowCenter",
                                         "screenWindowWidth",
                                         "tiles",
                                         "name",
                                         "type",
                                         "version",
                                         "chunkCount",
                                         "chromaticities",
                                         "view",
                                         "maxSamplesPerPixel"};

exr::Compression exr_compression(ExrCompression compression) {
    switch (compression) {
        case ExrCompression::None: return exr::NO_COMPRESSION;
        case ExrCompression::Rle: return exr::RLE_COMPRESSION;
        case ExrCompression::Zip: return exr::ZIP_COMPRESSION;
        case ExrCompression::Zips: return exr::ZIPS_COMPRESSION;
        case ExrCompression::Piz: return exr::PIZ_COMPRESSION;
        case ExrCompression::Pxr24: return exr::PXR24_COMPRESSION;
        case ExrCompression::B44: return exr::B44_COMPRESSION;
        case ExrCompression::B44a: return exr::B44A_COMPRESSION;
        case ExrCompression::Dwaa: return exr::DWAA_COMPRESSION;
        case ExrCompression::Dwab: return exr::DWAB_COMPRESSION;
    }
    return exr::ZIP_COMPRESSION;
}

exr::Chromaticities exr_chromaticities(Primaries primaries) {
    const Chromaticities c = chromaticities(primaries);
    const auto point = [](double x, double y) {
        return V2f(static_cast<float>(x), static_cast<float>(y));
    };
    return {point(c.red_x, c.red_y), point(c.green_x, c.green_y), point(c.blue_x, c.blue_y),
            point(c.white_x, c.white_y)};
}

}  // namespace

void add_exr_attribute(exr::Header& header, const std::string& name, const ExrAttribute& value) {
    if (kReserved.contains(name))
        throw std::runtime_error("the header attribute \"" + name + "\" cannot be chosen");
    if (const int* i = std::get_if<int>(&value)) header.insert(name, exr::IntAttribute(*i));
    if (const float* f = std::get_if<float>(&value)) header.insert(name, exr::FloatAttribute(*f));
    if (const std::string* s = std::get_if<std::string>(&value))
        header.insert(name, exr::StringAttribute(*s));
    if (const std::vector<float>* v = std::get_if<std::vector<float>>(&value)) {
        if (v->size() == 16) {
            IMATH_NAMESPACE::M44f m;
            std::copy(v->begin(), v->end(), m.getValue());
            header.insert(name, exr::M44fAttribute(m));
        } else {
            header.insert(name, exr::FloatVectorAttribute(*v));
        }
    }
}

void refuse_exr(const std::string& path, const std::string& why, const std::string& hint) {
    throw InputError(Error{Code::FileUnwritable,
                           "cannot write \"" + path + "\": " + why,
                           {},
                           hint,
                           {},
                           Severity::Error});
}

exr::PixelType exr_type(ExrPixelType type) {
    switch (type) {
        case ExrPixelType::Half: return exr::HALF;
        case ExrPixelType::Float: return exr::FLOAT;
        case ExrPixelType::UInt: return exr::UINT;
    }
    return exr::FLOAT;
}

ExrPixelType pixel_type_of(const exr::Channel& channel) {
    switch (channel.type) {
        case exr::HALF: return ExrPixelType::Half;
        case exr::UINT: return ExrPixelType::UInt;
        default: return ExrPixelType::Float;
    }
}

ExrCompression compression_of(const exr::Header& header) {
    switch (header.compression()) {
        case exr::RLE_COMPRESSION: return ExrCompression::Rle;
        case exr::ZIP_COMPRESSION: return ExrCompression::Zip;
        case exr::ZIPS_COMPRESSION: return ExrCompression::Zips;
        case exr::PIZ_COMPRESSION: return ExrCompression::Piz;
        case exr::PXR24_COMPRESSION: return ExrCompression::Pxr24;
        case exr::B44_COMPRESSION: return ExrCompression::B44;
        case exr::B44A_COMPRESSION: return ExrCompression::B44a;
        case exr::DWAA_COMPRESSION: return ExrCompression::Dwaa;
        case exr::DWAB_COMPRESSION: return ExrCompression::Dwab;
        default: return ExrCompression::None;
    }
}

std::size_t exr_value_size(ExrPixelType type) {
    return type == ExrPixelType::Half ? sizeof(half) : sizeof(float);
}

void store_exr_row(ExrPixelType type, const float* from, std::ptrdiff_t stride, int n, char* to) {
    for (int i = 0; i < n; ++i) {
        const float v = from[i * stride];
        if (type == ExrPixelType::Half) {
            const half h(std::isfinite(v) ? std::clamp(v, -kHalfMax, kHalfMax) : v);
            std::memcpy(to + static_cast<std::size_t>(i) * sizeof(half), &h, sizeof(half));
        } else {
            // UInt values come as the bits of a float.
            std::memcpy(to + static_cast<std::size_t>(i) * sizeof(float), &v, sizeof(float));
        }
    }
}

exr::Header make_exr_header(const ExrWriteSpec& spec, const ExrPart& part) {
    const Box2i display(V2i(0, 0), V2i(spec.width - 1, spec.height - 1));
    const Box2i data(V2i(spec.data_x, spec.data_y),
                     V2i(spec.data_x + spec.data_width - 1, spec.data_y + spec.data_height - 1));
    // Tiles are stored as they come: random order is what lets them be written at once.
    exr::Header header(display, data, spec.pixel_aspect_ratio, V2f(0, 0), 1,
                       spec.tiled ? exr::RANDOM_Y : exr::INCREASING_Y,
                       exr_compression(spec.compression));
    if (spec.tiled) {
        const auto size = static_cast<unsigned>(spec.tile_size);
        header.setTileDescription(exr::TileDescription(size, size, exr::ONE_LEVEL));
    }
    header.setType(spec.tiled ? exr::TILEDIMAGE : exr::SCANLINEIMAGE);
    if (spec.parts.size() > 1) header.setName(part.name);
    exr::addChromaticities(header, exr_chromaticities(spec.primaries));
    for (const ExrChannel& channel : part.channels) {
        if (header.channels().findChannel(channel.name) != nullptr)
            throw std::runtime_error("two channels are named \"" + channel.name + "\"");
        header.channels().insert(channel.name, exr::Channel(exr_type(channel.type)));
    }
    for (const auto& [name, value] : spec.attributes)
        add_exr_attribute(header, name, value);
    return header;
}

}  // namespace lightsieve
