// gobo: a slide in the beam of a spot light.
#include "nodes/light_filter/beam_place.h"
#include "scene/describe.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

enum class GoboMode : std::int32_t { Blend, Replace, Add, Sub, Mix };
enum class GoboWrap : std::int32_t { Clamp, Black, Mirror, Periodic };

struct Gobo {
    Color slidemap{1, 1, 1};
    GoboMode filter_mode = GoboMode::Blend;
    float density = 0;
    Vec2f offset;
    float rotate = 0, sscale = 1, tscale = 1;
    GoboWrap swrap = GoboWrap::Clamp, twrap = GoboWrap::Clamp;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<LightFilter> make_light_filter(NodeContext& context,
                                                                 const LightPlace& place) const;
};

NodeType Gobo::describe() {
    Describe<Gobo> d("gobo", NodeKind::LightFilter, "A slide in the beam of a spot light.");
    const std::vector<std::string> wraps{"clamp", "black", "mirror", "periodic"};
    d.param("slidemap", &Gobo::slidemap, "The slide: a colour, or a texture that is linked.");
    d.param(
         "filter_mode", &Gobo::filter_mode,
         "blend: the light is multiplied by the slide; replace: takes its colour; add, sub: the "
         "slide's light is added or taken away; mix: half of the light is blended.")
        .names({"blend", "replace", "add", "sub", "mix"});
    d.param("density", &Gobo::density, "Darkness of the slide; 1 is opaque.").range(0, 1);
    d.param("offset", &Gobo::offset, "Moves the slide, in parts of the beam.");
    d.param("rotate", &Gobo::rotate, "Turns the slide.").unit("deg");
    d.param("sscale", &Gobo::sscale, "Copies of the slide across.");
    d.param("tscale", &Gobo::tscale, "Copies of the slide upward.");
    d.param("swrap", &Gobo::swrap, "What lies beside the slide.").names(wraps);
    d.param("twrap", &Gobo::twrap, "What lies above and below the slide.").names(wraps);
    return d.done();
}

/// A coordinate brought into 0..1; nothing where the slide ends in black.
std::optional<float> wrapped(float x, GoboWrap wrap) {
    switch (wrap) {
        case GoboWrap::Clamp: return std::clamp(x, 0.0F, 1.0F);
        case GoboWrap::Black: return x >= 0 && x <= 1 ? std::optional(x) : std::nullopt;
        case GoboWrap::Mirror: return std::abs(x - 2 * std::round(x * 0.5F));
        case GoboWrap::Periodic: break;
    }
    return x - std::floor(x);
}

class Slide final : public LightFilter {
  public:
    Slide(const Gobo& node, const LightPlace& place, ColorInput map)
        : n_(node), place_(place), map_(map) {}
    [[nodiscard]] Color filtered(Color radiance, Vec3f, Vec3f to, float) const override {
        const Color slide = color_at(to) * (1 - std::clamp(n_.density, 0.0F, 1.0F));
        switch (n_.filter_mode) {
            case GoboMode::Blend: return radiance * slide;
            case GoboMode::Replace: return slide * average(radiance);
            case GoboMode::Add: return radiance + slide * average(radiance);
            case GoboMode::Sub: return clamp(radiance - slide * average(radiance), 0, kInfinity);
            case GoboMode::Mix: return lerp(radiance, radiance * slide, 0.5F);
        }
        return radiance;
    }

  private:
    [[nodiscard]] Color color_at(Vec3f to) const {
        const std::optional<Vec2f> at = beam_place(place_, to);
        if (!at) return kBlack;
        const float angle = deg_to_rad(n_.rotate), c = std::cos(angle), s = std::sin(angle);
        const Vec2f p{at->x - 0.5F, 0.5F - at->y};
        const std::optional<float> u =
            wrapped((c * p.x - s * p.y + 0.5F) * n_.sscale + n_.offset.x, n_.swrap);
        const std::optional<float> v =
            wrapped((s * p.x + c * p.y + 0.5F) * n_.tscale + n_.offset.y, n_.twrap);
        if (!u || !v) return kBlack;
        ShadePoint point;
        point.position = to;
        point.uv = {*u, *v};
        return map_.at(point);
    }

    Gobo n_;
    LightPlace place_;
    ColorInput map_;
};

std::unique_ptr<LightFilter> Gobo::make_light_filter(NodeContext& context,
                                                     const LightPlace& place) const {
    if (!has_beam(place, context, "gobo")) return nullptr;
    return std::make_unique<Slide>(*this, place, context.color_input("slidemap"));
}

}  // namespace

NodeType node_gobo() { return Gobo::describe(); }

}  // namespace lightsieve
