// color_jitter: a colour varied at random: by user data, by procedural, by object, by face.
#include <array>

#include "nodes/math/math_node.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

/// What tells copies apart, as the prefixes of the parameters.
enum Source : std::size_t { kData, kProc, kObj, kFace, kSources };
constexpr std::array<const char*, kSources> kPrefix{"data", "proc", "obj", "face"};
constexpr std::array<const char*, kSources> kWhat{"data_input", "the procedural", "the object",
                                                  "the face"};
enum class FaceMode : std::int32_t { FaceId, UniformId };

/// How far colours are varied.
struct Variation {
    float gain_min = 0, gain_max = 0, hue_min = 0, hue_max = 0, saturation_min = 0,
          saturation_max = 0;
    std::int32_t seed = 0;
};

struct ColorJitter {
    Color input;
    std::int32_t data_input = 0;
    std::array<Variation, kSources> by;
    FaceMode face_mode = FaceMode::FaceId;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint& at) const;
};

NodeType ColorJitter::describe() {
    Describe<ColorJitter> d("color_jitter", NodeKind::Shader, "A colour varied at random.");
    d.param("input", &ColorJitter::input, "The colour.");
    d.param("data_input", &ColorJitter::data_input, "A number that tells copies apart.");
    for (std::size_t i = 0; i < kSources; ++i) {
        const std::string p = kPrefix[i] + std::string("_");
        const std::string by = std::string(", by ") + kWhat[i] + ".";
        const auto of = [i](ColorJitter& n) -> Variation& { return n.by[i]; };
        d.part(
            p + "gain_min", [=](ColorJitter& n) -> float& { return of(n).gain_min; },
            "Least change of brightness" + by);
        d.part(
            p + "gain_max", [=](ColorJitter& n) -> float& { return of(n).gain_max; },
            "Most change of brightness" + by);
        d.part(
            p + "hue_min", [=](ColorJitter& n) -> float& { return of(n).hue_min; },
            "Least turn of the hue" + by);
        d.part(
            p + "hue_max", [=](ColorJitter& n) -> float& { return of(n).hue_max; },
            "Most turn of the hue" + by);
        d.part(
            p + "saturation_min", [=](ColorJitter& n) -> float& { return of(n).saturation_min; },
            "Least change of saturation" + by);
        d.part(
            p + "saturation_max", [=](ColorJitter& n) -> float& { return of(n).saturation_max; },
            "Most change of saturation" + by);
        d.part(
            p + "seed", [=](ColorJitter& n) -> std::int32_t& { return of(n).seed; },
            "Another seed gives other colours" + by);
    }
    d.param("face_mode", &ColorJitter::face_mode, "Faces are triangles, or polygons.")
        .names({"face id", "uniform id"});
    return d.done();
}

Color ColorJitter::eval(const ShadePoint& at) const {
    const std::array<std::uint32_t, kSources> id{
        static_cast<std::uint32_t>(data_input), at.shape_id, at.shape_id,
        face_mode == FaceMode::FaceId ? at.primitive : at.face};
    Color hsv = hsv_from_rgb(input);
    bool varied = false;
    for (std::size_t i = 0; i < kSources; ++i) {
        const Variation& v = by[i];
        const auto draw = [&](std::uint32_t stream, float low, float high) {
            if (low == 0 && high == 0) return 0.0F;
            varied = true;
            const std::uint32_t h =
                mixed_bits(mixed_bits(id[i], static_cast<std::uint32_t>(v.seed)),
                           stream + 8 * static_cast<std::uint32_t>(i));
            return lerp(low, high, unit_from_bits(h));
        };
        hsv.r += draw(0, v.hue_min, v.hue_max);
        hsv.g = unit(hsv.g + draw(1, v.saturation_min, v.saturation_max));
        hsv.b = positive(hsv.b + draw(2, v.gain_min, v.gain_max));
    }
    return varied ? rgb_from_hsv(hsv) : input;
}

}  // namespace

NodeType node_color_jitter() { return ColorJitter::describe(); }

}  // namespace lightsieve
