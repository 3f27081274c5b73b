// image: a texture file at the hit's texture coordinates, in the rendering space.
#include <algorithm>
#include <cmath>
#include <memory>

#include "io/texture.h"
#include "nodes/texture/image_files.h"
#include "nodes/texture/uv_set.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

/// As Arnold numbers them. Missing: outside of [0,1] lies `missing_texture_color`.
enum class ImageWrap : std::int32_t { Periodic, Black, Clamp, Mirror, File, Missing };

struct Image {
    Name filename;
    Name color_space = "auto";
    TextureFilter filter = TextureFilter::SmartBicubic;
    std::int32_t mipmap_bias = 0;
    Color multiply{1, 1, 1}, offset{0, 0, 0};
    bool ignore_missing_textures = false;
    Rgba missing_texture_color{{0, 0, 0}, 0};
    bool single_channel = false;
    std::int32_t start_channel = 0;
    ImageWrap swrap = ImageWrap::Periodic, twrap = ImageWrap::Periodic;
    float sscale = 1, tscale = 1;
    bool sflip = false, tflip = false;
    float soffset = 0, toffset = 0;
    bool swap_st = false;
    Vec2f uvcoords;
    Name uvset;

    // Found by prepare().
    const TextureCache* cache = nullptr;
    const ImageFiles* files = nullptr;
    TextureSampling sampling;
    float footprint_scale = 1;  ///< of the hit's footprint, from mipmap_bias
    bool uvcoords_linked = false;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Vec2f texture_coordinates(Vec2f uv) const;
    [[nodiscard]] TextureFootprint footprint(const ShadePoint& at, const UvPoint& uv) const;
    [[nodiscard]] const ImageTiles& tiles_at(const ShadePoint& at) const;
    /// Opens every file that the name may stand for.
    [[nodiscard]] std::shared_ptr<const ImageFiles> open_files(NodeContext& context) const;
    void report_missing(NodeContext& context) const;
};

NodeType Image::describe() {
    Describe<Image> d("image", NodeKind::Shader, "A texture from a picture file.");
    d.param("filename", &Image::filename,
            "The file: .tx, EXR, TIFF, PNG, JPEG, HDR and others; looked for along "
            "texture_searchpath. Tokens: <udim>, <tile>, <uvtile>, <frame>, <attr:NAME "
            "default:TEXT>.");
    d.param("color_space", &Image::color_space,
            "What the file's colours are; auto: sRGB for integers, ACEScg for floats; empty: no "
            "conversion.");
    d.param("filter", &Image::filter,
            "Interpolation; smart_bicubic: a cubic B-spline where texels are magnified, else "
            "bilinear.")
        .names({"closest", "bilinear", "bicubic", "smart_bicubic"});
    d.param("mipmap_bias", &Image::mipmap_bias,
            "Levels by which the texture is read coarser (or finer, if negative).")
        .range(-5, 5);
    d.param("multiply", &Image::multiply, "Factor on the colour.");
    d.param("offset", &Image::offset, "Added to the colour, after multiply.");
    d.param("ignore_missing_textures", &Image::ignore_missing_textures,
            "A missing file gives missing_texture_color instead of an error.");
    d.param("missing_texture_color", &Image::missing_texture_color, "Stands for a missing file.");
    d.param("single_channel", &Image::single_channel,
            "Reads start_channel alone and gives it as grey.");
    d.param("start_channel", &Image::start_channel, "The file's channel that becomes red.")
        .range(0, 31);
    d.param("swrap", &Image::swrap, "What lies outside 0..1 in s.")
        .names({"periodic", "black", "clamp", "mirror", "file", "missing"});
    d.param("twrap", &Image::twrap, "What lies outside 0..1 in t.")
        .names({"periodic", "black", "clamp", "mirror", "file", "missing"});
    d.param("sscale", &Image::sscale, "Factor on s.");
    d.param("tscale", &Image::tscale, "Factor on t.");
    d.param("sflip", &Image::sflip, "Mirrors the texture left to right.");
    d.param("tflip", &Image::tflip, "Turns the texture upside down.");
    d.param("soffset", &Image::soffset, "Added to s, after sscale.");
    d.param("toffset", &Image::toffset, "Added to t, after tscale.");
    d.param("swap_st", &Image::swap_st, "Exchanges s and t.");
    d.param("uvcoords", &Image::uvcoords,
            "Texture coordinates in place of the shape's; acts only when linked.");
    d.param("uvset", &Image::uvset, "Set of texture coordinates; empty: the first.");
    return d.done();
}

TextureWrap texture_wrap(ImageWrap wrap) {
    // Outside of [0,1] "missing" is answered before the look-up; inside, texels at the edge are repeated.
    return wrap == ImageWrap::Missing ? TextureWrap::Clamp : static_cast<TextureWrap>(wrap);
}

void Image::prepare(NodeContext& context) {
    sampling = {texture_wrap(swrap), texture_wrap(twrap), filter, start_channel, single_channel};
    footprint_scale = std::exp2(static_cast<float>(mipmap_bias));
    uvcoords_linked = context.is_linked("uvcoords");
    cache = &context.textures();
    const std::shared_ptr<const ImageFiles> opened = open_files(context);
    files = opened.get();
    context.keep(opened);
}

std::shared_ptr<const ImageFiles> Image::open_files(NodeContext& context) const {
    auto out = std::make_shared<ImageFiles>();
    const std::size_t n_errors = context.diagnostics().n_errors();
    const auto open = [&](const std::string& name) {
        return open_tiles(with_frame(name, context.frame_number()), color_space.view(), context);
    };
    const std::string name = filename.str();
    bool by_data = false;
    const FileToken token = find_token(name, "attr", by_data);
    const auto with_text = [&](std::string_view text) {
        return name.substr(0, token.begin) + std::string(text) + name.substr(token.end);
    };
    if (by_data) {
        const std::size_t blank = token.rest.find(' ');
        const std::string standard = token.rest.find("default:") == std::string::npos
                                         ? std::string{}
                                         : token.rest.substr(token.rest.find("default:") + 8);
        out->attribute = token.rest.substr(0, blank);
        for (const Name text : context.user_texts(out->attribute))
            out->by_text[text.id()] = open(with_text(text.view()));
        out->fallback = open(with_text(standard));
    } else if (context.is_linked("filename")) {
        for (const Name text : context.possible_texts("filename"))
            out->by_text[text.id()] = open(text.str());
    } else {
        out->fallback = open(name);
    }
    const bool some = !out->fallback.empty() ||
                      std::any_of(out->by_text.begin(), out->by_text.end(),
                                  [](const auto& entry) { return !entry.second.empty(); });
    // A file that is there but cannot be read has been reported.
    if (!some && context.diagnostics().n_errors() == n_errors) report_missing(context);
    return out;
}

void Image::report_missing(NodeContext& context) const {
    const std::string message = filename.empty()
                                    ? "image \"" + context.node_name().str() + "\" has no filename"
                                    : "there is no texture \"" + filename.str() + "\"";
    if (ignore_missing_textures || context.ignore_missing_textures()) {
        context.diagnostics().warning(Code::FileNotFound,
                                      message + "; missing_texture_color stands for it",
                                      context.where("filename"));
        return;
    }
    context.diagnostics().error(
        Code::FileNotFound, message, context.where("filename"),
        "check the name and options.texture_searchpath, or set ignore_missing_textures");
}

const ImageTiles& Image::tiles_at(const ShadePoint& at) const {
    Name text = filename;
    if (!files->attribute.empty() &&
        (at.services == nullptr || !at.services->user_text(at, files->attribute, text)))
        return files->fallback;
    const auto found = files->by_text.find(text.id());
    return found == files->by_text.end() ? files->fallback : found->second;
}

Vec2f Image::texture_coordinates(Vec2f uv) const {
    Vec2f st = uvcoords_linked ? uvcoords : uv;
    if (swap_st) std::swap(st.x, st.y);
    st = {st.x * sscale + soffset, st.y * tscale + toffset};
    if (sflip) st.x = 1 - st.x;
    if (tflip) st.y = 1 - st.y;
    return st;
}

/// The footprint in the file's coordinates.
TextureFootprint Image::footprint(const ShadePoint& at, const UvPoint& uv) const {
    // How coordinates that come from elsewhere run is not known.
    const TextureFootprint in_uv =
        uvcoords_linked ? TextureFootprint::round(uv.width) : texture_footprint(at, uv);
    const auto scaled = [&](Vec2f side) {
        if (swap_st) std::swap(side.x, side.y);
        return Vec2f{side.x * sscale * (sflip ? -1.0F : 1.0F),
                     side.y * tscale * (tflip ? -1.0F : 1.0F)} *
               footprint_scale;
    };
    return {scaled(in_uv.across), scaled(in_uv.along)};
}

Rgba Image::eval(const ShadePoint& at) const {
    const UvPoint at_uv = uv_of_set(at, uvset);
    Vec2f st = texture_coordinates(at_uv.uv);
    const bool outside = (swrap == ImageWrap::Missing && !(st.x >= 0 && st.x <= 1)) ||
                         (twrap == ImageWrap::Missing && !(st.y >= 0 && st.y <= 1));
    if (files == nullptr || outside) return missing_texture_color;
    const ImageTiles& tiles = tiles_at(at);
    const Texture* texture = tiles.single;
    if (tiles.tiled) {
        const float u = std::floor(st.x), v = std::floor(st.y);
        if (!(u >= 0 && u < 10 && v >= 0 && v < 1000)) return missing_texture_color;
        const auto found = tiles.tiles.find(1001 + static_cast<std::int32_t>(u) +
                                            10 * static_cast<std::int32_t>(v));
        if (found == tiles.tiles.end()) return missing_texture_color;
        texture = found->second;
        st = st - Vec2f{u, v};
    }
    if (texture == nullptr) return missing_texture_color;
    TextureSampling how = sampling;
    if (tiles.tiled) how.wrap_s = how.wrap_t = TextureWrap::Clamp;
    const Rgba texel = cache->lookup(*texture, st, footprint(at, at_uv), how);
    return {texel.rgb * multiply + offset, texel.a};
}

}  // namespace

NodeType node_image() { return Image::describe(); }

}  // namespace lightsieve
