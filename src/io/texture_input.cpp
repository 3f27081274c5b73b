#include "io/texture_input.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "io/image_open.h"

namespace lightsieve {

namespace {

/// Side of the tiles in which the cache sees files that have none.
constexpr int kTileSize = 64;
/// An untiled file up to this size is decoded once and kept while it is open [bytes].
constexpr std::size_t kMaxWholeImage = std::size_t{512} << 20;

std::atomic<std::size_t> whole_image_bytes{0};

}  // namespace

std::size_t whole_images_memory() { return whole_image_bytes; }

bool is_float_format(const OIIO::ImageSpec& spec) { return spec.format.is_floating_point(); }

TexelConversion::TexelConversion(const OIIO::ImageSpec& spec, ColorSpace from, ColorSpace to)
    : color(from, to),
      n_channels(spec.nchannels),
      n_color(spec.nchannels >= 3 ? 3 : 1),
      alpha_channel(spec.alpha_channel) {
    if (alpha_channel < n_color) alpha_channel = -1;
    if (alpha_channel < 0) return;
    const bool unassociated = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    // A matrix acts alike on multiplied colours; a curve does not.
    const bool curved = from.transfer != Transfer::Linear || from.external != nullptr;
    divide_alpha = !unassociated && !color.identity() && curved;
    multiply_alpha = unassociated || divide_alpha;
}

void TexelConversion::apply(float* pixels, std::size_t n) const {
    for (std::size_t i = 0; i < n; ++i) {
        float* const p = pixels + i * static_cast<std::size_t>(n_channels);
        Color c = n_color == 3 ? Color(p[0], p[1], p[2]) : Color::grey(p[0]);
        const float alpha = alpha_channel >= 0 ? p[alpha_channel] : 1;
        const bool divided = divide_alpha && alpha > 0;
        if (divided) c = c * (1 / alpha);
        c = n_color == 3 ? color(c) : Color::grey(color.grey(c.r));
        if (divided || (multiply_alpha && !divide_alpha)) c = c * alpha;
        for (int channel = 0; channel < n_color; ++channel)
            p[channel] = c[channel];
    }
}

namespace {

/// The bytes of a colour space: settings are values, and the spaces that it may point to outlive the cache.
constexpr OIIO::TypeDesc kSpaceType(OIIO::TypeDesc::UINT8, static_cast<int>(sizeof(ColorSpace)));

ColorSpace space_of(const OIIO::ImageSpec& config, const char* name) {
    ColorSpace out;
    const OIIO::ParamValue* value = config.find_attribute(name, kSpaceType);
    if (value != nullptr) std::memcpy(&out, value->data(), sizeof(out));
    return out;
}

}  // namespace

OIIO::ImageSpec ConvertingInput::settings(const std::string& path, ColorSpace from,
                                          ColorSpace to) {
    OIIO::ImageSpec config;
    config.attribute("lightsieve:path", path);
    config.attribute("lightsieve:from", kSpaceType, &from);
    config.attribute("lightsieve:to", kSpaceType, &to);
    return config;
}

bool ConvertingInput::open(const std::string& name, OIIO::ImageSpec&) {
    errorfmt("\"{}\" is opened without settings", name);
    return false;
}

bool ConvertingInput::open(const std::string&, OIIO::ImageSpec& spec,
                           const OIIO::ImageSpec& config) {
    close();
    const std::string path = config.get_string_attribute("lightsieve:path");
    const ColorSpace from = space_of(config, "lightsieve:from"),
                     to = space_of(config, "lightsieve:to");
    std::string problem;
    inner_ = open_image(path, problem);
    if (!inner_) {
        errorfmt("{}", problem);
        return false;
    }
    const OIIO::ImageSpec& s = inner_->spec();
    if (s.deep || s.depth > 1) {
        errorfmt("\"{}\" is deep or three-dimensional", path);
        return false;
    }
    conversion_ = TexelConversion(s, from, to);
    tiled_ = s.tile_width > 0;
    adopt_spec();
    spec = m_spec;
    return true;
}

bool ConvertingInput::close() {
    release_whole();
    inner_.reset();
    miplevel_ = 0;
    return true;
}

void ConvertingInput::release_whole() {
    whole_image_bytes -= whole_.size();
    whole_ = {};
}

bool ConvertingInput::seek_subimage(int subimage, int miplevel) {
    if (!inner_ || subimage != 0 || miplevel < 0) return false;
    if (miplevel == miplevel_) return true;
    if (!inner_->seek_subimage(0, miplevel)) return false;
    miplevel_ = miplevel;
    release_whole();
    adopt_spec();
    return true;
}

void ConvertingInput::adopt_spec() {
    m_spec = inner_->spec();
    const bool mixed = !m_spec.channelformats.empty();
    read_format_ = mixed || !conversion_.identity() ? OIIO::TypeFloat : m_spec.format;
    // Texels of untiled files are kept as small as they are in the file.
    if (!tiled_ && !mixed) read_format_ = m_spec.format;
    m_spec.format = conversion_.identity() ? read_format_ : OIIO::TypeFloat;
    m_spec.channelformats.clear();
    m_spec.erase_attribute("oiio:UnassociatedAlpha");
    // The same file may be open twice, read as different colour spaces: the cache must not take one for the other.
    m_spec.erase_attribute("oiio:SHA-1");
    m_spec.erase_attribute("oiio:ColorSpace");
    // An environment map made by maketx is looked up like any other picture.
    m_spec.erase_attribute("textureformat");
    if (!tiled_) {
        m_spec.tile_width = m_spec.tile_height = kTileSize;
        m_spec.tile_depth = 1;
    }
}

bool ConvertingInput::read_native_scanline(int, int, int, int, void*) {
    errorfmt("textures are read in tiles");
    return false;
}

bool ConvertingInput::read_native_tile(int subimage, int miplevel, int x, int y, int, void* data) {
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    if (conversion_.identity())
        return fetch_tile(x, y, m_spec.format, static_cast<std::byte*>(data));
    const auto n_pixels =
        static_cast<std::size_t>(m_spec.tile_width) * static_cast<std::size_t>(m_spec.tile_height);
    scratch_.resize(n_pixels * static_cast<std::size_t>(m_spec.nchannels));
    if (!fetch_tile(x, y, OIIO::TypeFloat, reinterpret_cast<std::byte*>(scratch_.data())))
        return false;
    conversion_.apply(scratch_.data(), n_pixels);
    std::memcpy(data, scratch_.data(), scratch_.size() * sizeof(float));
    return true;
}

bool ConvertingInput::fetch_tile(int x, int y, OIIO::TypeDesc format, std::byte* out) {
    if (tiled_) {
        if (inner_->read_tile(x, y, 0, format, out)) return true;
        errorfmt("{}", inner_->geterror());
        return false;
    }
    const auto n_values = static_cast<std::size_t>(m_spec.tile_width) *
                          static_cast<std::size_t>(m_spec.tile_height) *
                          static_cast<std::size_t>(m_spec.nchannels);
    std::vector<std::byte> native(n_values * read_format_.size());
    const bool ok = whole_image_fits() ? fetch_from_whole(x, y, native.data())
                                       : fetch_from_strip(x, y, native.data());
    if (!ok) return false;
    return OIIO::convert_pixel_values(read_format_, native.data(), format, out,
                                      static_cast<int>(n_values));
}

bool ConvertingInput::whole_image_fits() const {
    if (!whole_.empty()) return true;
    const auto bytes = static_cast<std::size_t>(m_spec.image_pixels()) *
                       static_cast<std::size_t>(m_spec.nchannels) * read_format_.size();
    return bytes <= kMaxWholeImage && whole_image_bytes + bytes <= kMostWholeImages;
}

bool ConvertingInput::fetch_from_whole(int x, int y, std::byte* out) {
    const std::size_t pixel = static_cast<std::size_t>(m_spec.nchannels) * read_format_.size();
    if (whole_.empty()) {
        whole_.resize(static_cast<std::size_t>(m_spec.image_pixels()) * pixel);
        whole_image_bytes += whole_.size();
        if (!inner_->read_image(0, miplevel_, 0, m_spec.nchannels, read_format_, whole_.data())) {
            errorfmt("{}", inner_->geterror());
            release_whole();
            return false;
        }
    }
    const int left = x - m_spec.x, top = y - m_spec.y;
    const int n = std::min(m_spec.tile_width, m_spec.width - left);
    for (int row = 0; row < std::min(m_spec.tile_height, m_spec.height - top); ++row) {
        const auto from =
            static_cast<std::size_t>(top + row) * static_cast<std::size_t>(m_spec.width) +
            static_cast<std::size_t>(left);
        std::memcpy(out + static_cast<std::size_t>(row) *
                              static_cast<std::size_t>(m_spec.tile_width) * pixel,
                    whole_.data() + from * pixel, static_cast<std::size_t>(n) * pixel);
    }
    return true;
}

bool ConvertingInput::fetch_from_strip(int x, int y, std::byte* out) {
    const std::size_t pixel = static_cast<std::size_t>(m_spec.nchannels) * read_format_.size();
    const std::size_t row_bytes = static_cast<std::size_t>(m_spec.width) * pixel;
    const int end = std::min(y + m_spec.tile_height, m_spec.y + m_spec.height);
    std::vector<std::byte> strip(row_bytes * static_cast<std::size_t>(end - y));
    if (!inner_->read_scanlines(0, miplevel_, y, end, 0, 0, m_spec.nchannels, read_format_,
                                strip.data())) {
        errorfmt("{}", inner_->geterror());
        return false;
    }
    const auto left = static_cast<std::size_t>(x - m_spec.x);
    const auto n =
        static_cast<std::size_t>(std::min(m_spec.tile_width, m_spec.width - (x - m_spec.x)));
    for (int row = 0; row < end - y; ++row) {
        const auto r = static_cast<std::size_t>(row);
        std::memcpy(out + r * static_cast<std::size_t>(m_spec.tile_width) * pixel,
                    strip.data() + r * row_bytes + left * pixel, n * pixel);
    }
    return true;
}

}  // namespace lightsieve
