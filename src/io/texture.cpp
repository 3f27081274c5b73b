#include "io/texture.h"

#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "io/image_open.h"
#include "io/image_try.h"
#include "io/texture_input.h"

namespace lightsieve {

namespace {

using OIIO::Tex::InterpMode;
using OIIO::Tex::Wrap;

/// Files of the cache that may be open at once; well below the usual limit of 1024 a process.
constexpr int kMaxOpenFiles = 256;
/// Coordinates beyond this are the same as this for wrap modes that do not repeat [uv units].
constexpr float kMaxCoordinate = 64;
/// The coarsest level is reached long before.
constexpr float kMaxFootprint = 64;

Wrap oiio_wrap(TextureWrap wrap) {
    switch (wrap) {
        case TextureWrap::Periodic: return Wrap::Periodic;
        case TextureWrap::Black: return Wrap::Black;
        case TextureWrap::Clamp: return Wrap::Clamp;
        case TextureWrap::Mirror: return Wrap::Mirror;
        case TextureWrap::File: return Wrap::Default;
    }
    return Wrap::Periodic;
}

InterpMode oiio_filter(TextureFilter filter) {
    switch (filter) {
        case TextureFilter::Closest: return InterpMode::Closest;
        case TextureFilter::Bilinear: return InterpMode::Bilinear;
        case TextureFilter::Bicubic: return InterpMode::Bicubic;
        case TextureFilter::SmartBicubic: return InterpMode::SmartBicubic;
    }
    return InterpMode::SmartBicubic;
}

/// A finite coordinate near [0,1]: far ones lose their fraction, and converted to integers they would overflow.
float bounded(float x, TextureWrap wrap) {
    if (!std::isfinite(x)) return 0;
    switch (wrap) {
        case TextureWrap::Periodic: return x - std::floor(x);
        case TextureWrap::Mirror: return x - 2 * std::floor(x * 0.5F);
        case TextureWrap::Black:
        case TextureWrap::Clamp: return std::clamp(x, -kMaxCoordinate, kMaxCoordinate);
        case TextureWrap::File: return std::clamp(x, -65536.0F, 65536.0F);
    }
    return x;
}

/// A side of a footprint that OpenImageIO can work with.
Vec2f bounded(Vec2f side) {
    const float size = std::hypot(side.x, side.y);
    if (!std::isfinite(size)) return {};
    return size > kMaxFootprint ? side * (kMaxFootprint / size) : side;
}

/// Distinguishes caches, also a new one at the address of an old one.
std::atomic<std::uint64_t> next_cache_id{1};

struct ThreadHandle {
    std::uint64_t cache_id = 0;
    OIIO::TextureSystem::Perthread* info = nullptr;
};
thread_local ThreadHandle thread_handle;

}  // namespace

struct Texture {
    OIIO::TextureSystem::TextureHandle* handle = nullptr;
    TextureInfo info;
    std::string path;
};

struct TextureCache::State {
    std::shared_ptr<const ColorSpaces> spaces;
    float memory_mb = 0;
    OIIO::TextureSystem* system = nullptr;
    std::uint64_t id = next_cache_id++;
    std::mutex mutex;  ///< guards what follows
    std::map<std::tuple<std::string, Primaries, Transfer, bool, const ExternalSpace*>,
             std::unique_ptr<Texture>>
        textures;
    std::map<std::string, std::string> failures;  ///< path to the first message
    double open_seconds = 0;

    OIIO::TextureSystem::Perthread* thread() const {
        if (thread_handle.cache_id != id) thread_handle = {id, system->get_perthread_info()};
        return thread_handle.info;
    }

    /// The slow end of a look-up that failed.
    void note_failure(const Texture& texture) {
        const std::string message = system->geterror();
        const std::lock_guard lock(mutex);
        failures.emplace(texture.path, message);
    }

    std::unique_ptr<Texture> load(const std::string& path, const TextureInfo& info,
                                  std::string& problem);
    bool readable(const Texture& texture, std::string& problem);
};

namespace {

void report(Diagnostics& diagnostics, Code code, const std::string& message,
            const SourceSpan& where, const std::string& hint) {
    diagnostics.error(code, message, where, hint);
}

/// Describes a file without keeping it open. False with `problem` set.
bool read_info(const std::string& path, TextureInfo& info, std::string& problem) {
    if (!try_image(path, problem)) return false;
    const std::unique_ptr<OIIO::ImageInput> input = open_image(path, problem);
    if (!input) return false;
    const OIIO::ImageSpec& spec = input->spec();
    info.width = spec.width;
    info.height = spec.height;
    info.n_channels = spec.nchannels;
    info.has_alpha = spec.alpha_channel >= 0;
    info.is_float = is_float_format(spec);
    return true;
}

}  // namespace

TextureCache::TextureCache(std::size_t memory_mb, std::shared_ptr<const ColorSpaces> spaces)
    : state_(std::make_unique<State>()) {
    state_->spaces = spaces ? std::move(spaces) : std::make_shared<const ColorSpaces>();
    state_->system = OIIO::TextureSystem::create(false);
    OIIO::TextureSystem& system = *state_->system;
    state_->memory_mb = static_cast<float>(memory_mb);
    system.attribute("max_memory_MB", state_->memory_mb);
    system.attribute("max_open_files", kMaxOpenFiles);
    system.attribute("automip", 1);
    // A file read as two colour spaces is two textures, though its fingerprint is one.
    system.attribute("deduplicate", 0);
    system.attribute("gray_to_rgb", 0);
}

TextureCache::~TextureCache() {
    state_->textures.clear();
    OIIO::TextureSystem::destroy(state_->system, true);
}

std::unique_ptr<Texture> TextureCache::State::load(const std::string& path,
                                                   const TextureInfo& info, std::string& problem) {
    // A made-up name: OpenImageIO would look for patterns such as <UDIM> in the real one.
    const OIIO::ustring name("lightsieve-texture-" + std::to_string(textures.size()));
    const OIIO::ImageSpec settings =
        ConvertingInput::settings(path, info.space, spaces->rendering());
    auto texture = std::make_unique<Texture>();
    texture->info = info;
    texture->path = path;
    system->imagecache()->add_file(name, &ConvertingInput::create, &settings, true);
    texture->handle = system->get_texture_handle(name);
    if (texture->handle == nullptr || !system->good(texture->handle)) {
        problem = system->geterror();
        return nullptr;
    }
    return readable(*texture, problem) ? std::move(texture) : nullptr;
}

bool TextureCache::State::readable(const Texture& texture, std::string& problem) {
    // The last texel: a truncated file lacks it, and an untiled one is decoded up to it.
    const OIIO::ImageSpec* spec = system->imagespec(texture.handle);
    if (spec == nullptr) {
        problem = system->geterror();
        return false;
    }
    const int x = spec->x + spec->width - 1, y = spec->y + spec->height - 1;
    std::vector<float> texel(static_cast<std::size_t>(spec->nchannels));
    OIIO::TextureOpt options;
    if (system->get_texels(texture.handle, nullptr, options, 0, x, x + 1, y, y + 1, 0, 1, 0,
                           spec->nchannels, OIIO::TypeFloat, texel.data()))
        return true;
    problem = system->geterror();
    return false;
}

const Texture* TextureCache::open(const std::string& path, std::string_view color_space,
                                  Diagnostics& diagnostics, const SourceSpan& where) {
    const auto start = std::chrono::steady_clock::now();
    const Texture* texture = open_untimed(path, color_space, diagnostics, where);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const std::lock_guard lock(state_->mutex);
    state_->open_seconds += taken.count();
    return texture;
}

const Texture* TextureCache::open_untimed(const std::string& path, std::string_view color_space,
                                          Diagnostics& diagnostics, const SourceSpan& where) {
    std::error_code ec;
    if (!std::filesystem::exists(path, ec)) {
        report(diagnostics, Code::FileNotFound, "there is no texture \"" + path + "\"", where,
               "check the name and options.texture_searchpath, or set ignore_missing_textures");
        return nullptr;
    }
    TextureInfo info;
    std::string problem;
    std::unique_ptr<Texture> loaded;
    try {
        if (read_info(path, info, problem)) {
            const ColorSpaces& spaces = *state_->spaces;
            info.space =
                spaces.resolve(color_space, info.is_float ? spaces.rendering() : spaces.integers(),
                               diagnostics, where);
            const std::lock_guard lock(state_->mutex);
            const std::tuple key(path, info.space.primaries, info.space.transfer, info.space.raw,
                                 info.space.external);
            if (const auto it = state_->textures.find(key); it != state_->textures.end())
                return it->second.get();
            loaded = state_->load(path, info, problem);
            if (loaded) return (state_->textures[key] = std::move(loaded)).get();
        }
    } catch (const std::exception& e) {
        problem = e.what();
    }
    report(diagnostics, Code::FileFormat, "texture \"" + path + "\" cannot be read: " + problem,
           where, "write the file again, or convert it to .tx, EXR, TIFF or PNG");
    return nullptr;
}

const TextureInfo& TextureCache::info(const Texture& texture) { return texture.info; }

Rgba TextureCache::lookup(const Texture& texture, Vec2f uv, TextureFootprint footprint,
                          const TextureSampling& sampling) const noexcept {
    const int first = sampling.start_channel;
    const int n_there = std::max(0, texture.info.n_channels - first);
    const int n = sampling.single_channel ? std::min(1, n_there) : std::min(4, n_there);
    if (n == 0 || first < 0) return {kBlack, 1};

    const float s = bounded(uv.x, sampling.wrap_s);
    const float t = 1 - bounded(uv.y, sampling.wrap_t);  // files begin with the top row
    const Vec2f across = bounded(footprint.across), along = bounded(footprint.along);
    OIIO::TextureOpt options;
    options.firstchannel = first;
    options.swrap = static_cast<OIIO::TextureOpt::Wrap>(oiio_wrap(sampling.wrap_s));
    options.twrap = static_cast<OIIO::TextureOpt::Wrap>(oiio_wrap(sampling.wrap_t));
    options.interpmode = static_cast<OIIO::TextureOpt::InterpMode>(oiio_filter(sampling.filter));
    options.mipmode = OIIO::TextureOpt::MipModeAniso;
    float v[4] = {0, 0, 0, 1};
    try {
        if (!state_->system->texture(texture.handle, state_->thread(), options, s, t, across.x,
                                     -across.y, along.x, -along.y, n, v)) {
            state_->note_failure(texture);
            return {kBlack, 1};
        }
    } catch (...) {
        return {kBlack, 1};  // out of memory: the tile stays missing, rendering goes on
    }
    if (n == 1) return {Color::grey(v[0]), 1};
    if (n == 2) return {Color::grey(v[0]), v[1]};
    return {{v[0], v[1], v[2]}, n == 4 ? v[3] : 1};
}

std::size_t TextureCache::memory() const {
    std::int64_t cached = 0;
    state_->system->imagecache()->getattribute("stat:cache_memory_used", OIIO::TypeDesc::INT64,
                                               &cached);
    return static_cast<std::size_t>(std::max<std::int64_t>(cached, 0)) + whole_images_memory();
}

std::size_t TextureCache::most_memory() const {
    const std::lock_guard lock(state_->mutex);
    double texels = 0, whole = 0;
    for (const auto& [key, texture] : state_->textures) {
        const OIIO::ImageSpec* spec = state_->system->imagespec(texture->handle);
        if (spec == nullptr) continue;
        // Tiles are kept as bytes, halfs or floats; the coarser levels are a third of the finest.
        const double size = static_cast<double>(spec->image_pixels()) * spec->nchannels *
                            (spec->format.size() <= 2 ? double(spec->format.size()) : 4.0);
        texels += size * 4 / 3;
        whole += size;
    }
    const double bound = double{state_->memory_mb} * 0x1p20;
    return static_cast<std::size_t>(std::min(texels, bound) +
                                    std::min(whole, static_cast<double>(kMostWholeImages)));
}

double TextureCache::open_seconds() const {
    const std::lock_guard lock(state_->mutex);
    return state_->open_seconds;
}

void TextureCache::report_failures(Diagnostics& diagnostics) const {
    const std::lock_guard lock(state_->mutex);
    for (const auto& [path, message] : state_->failures) {
        diagnostics.error(
            Code::FileUnreadable,
            "texture \"" + path + "\" failed while rendering and gave black: " + message, {},
            "check that the file was not changed or removed meanwhile");
    }
}

}  // namespace lightsieve
