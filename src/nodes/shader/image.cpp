// image: a texture file at the hit's texture coordinates, in the rendering space.
#include <cmath>

#include "io/texture.h"
#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_point.h"

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
    const Texture* texture = nullptr;  ///< null: missing
    TextureSampling sampling;
    float footprint_scale = 1;  ///< of the hit's footprint, from scales and bias
    bool uvcoords_linked = false;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Vec2f texture_coordinates(const ShadePoint& at) const;
};

NodeType Image::describe() {
    Describe<Image> d("image", NodeKind::Shader, "A texture from a picture file.");
    d.param("filename", &Image::filename,
            "The file: .tx, EXR, TIFF, PNG, JPEG, HDR and others; looked for along "
            "texture_searchpath.");
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
    d.param("uvset", &Image::uvset, "Set of texture coordinates; empty: the first.").pending();
    return d.done();
}

TextureWrap texture_wrap(ImageWrap wrap) {
    // Outside of [0,1] "missing" is answered before the look-up; inside, texels at the edge are repeated.
    return wrap == ImageWrap::Missing ? TextureWrap::Clamp : static_cast<TextureWrap>(wrap);
}

void Image::prepare(NodeContext& context) {
    sampling = {texture_wrap(swrap), texture_wrap(twrap), filter, start_channel, single_channel};
    footprint_scale =
        std::fmax(std::abs(sscale), std::abs(tscale)) * std::exp2(static_cast<float>(mipmap_bias));
    uvcoords_linked = context.is_linked("uvcoords");
    cache = &context.textures();
    texture = nullptr;

    const std::optional<std::string> path = context.find_asset(filename.view());
    if (path) {
        texture = context.textures().open(*path, color_space.view(), context.diagnostics(),
                                          context.where("filename"));
        return;
    }
    const std::string message = filename.empty()
                                    ? "image \"" + context.node_name().str() + "\" has no filename"
                                    : "there is no texture \"" + filename.str() + "\"";
    if (ignore_missing_textures || context.ignore_missing_textures()) {
        context.diagnostics().warning(Code::FileNotFound,
                                      message + "; missing_texture_color stands for it",
                                      context.where("filename"));
        return;
    }
    const bool pattern = filename.view().find('<') != std::string_view::npos;
    context.diagnostics().error(
        Code::FileNotFound, message, context.where("filename"),
        pattern ? "tokens such as <udim> are not supported yet; name one file"
                : "check the name and options.texture_searchpath, or set ignore_missing_textures");
}

Vec2f Image::texture_coordinates(const ShadePoint& at) const {
    Vec2f st = uvcoords_linked ? uvcoords : at.uv;
    if (swap_st) std::swap(st.x, st.y);
    st = {st.x * sscale + soffset, st.y * tscale + toffset};
    if (sflip) st.x = 1 - st.x;
    if (tflip) st.y = 1 - st.y;
    return st;
}

Rgba Image::eval(const ShadePoint& at) const {
    const Vec2f st = texture_coordinates(at);
    const bool outside = (swrap == ImageWrap::Missing && !(st.x >= 0 && st.x <= 1)) ||
                         (twrap == ImageWrap::Missing && !(st.y >= 0 && st.y <= 1));
    if (texture == nullptr || outside) return missing_texture_color;
    const Rgba texel = cache->lookup(*texture, st, at.uv_width * footprint_scale, sampling);
    return {texel.rgb * multiply + offset, texel.a};
}

}  // namespace

NodeType node_image() { return Image::describe(); }

}  // namespace lightsieve
