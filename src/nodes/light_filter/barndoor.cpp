// barndoor: four flaps in the beam of a spot light.
#include "nodes/light_filter/beam_place.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct Barndoor {
    float barndoor_top_left = 0, barndoor_top_right = 0, barndoor_top_edge = 0;
    float barndoor_right_top = 1, barndoor_right_bottom = 1, barndoor_right_edge = 0;
    float barndoor_bottom_left = 1, barndoor_bottom_right = 1, barndoor_bottom_edge = 0;
    float barndoor_left_top = 0, barndoor_left_bottom = 0, barndoor_left_edge = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<LightFilter> make_light_filter(NodeContext& context,
                                                                 const LightPlace& place) const;
};

NodeType Barndoor::describe() {
    Describe<Barndoor> d(
        "barndoor", NodeKind::LightFilter,
        "Four flaps in the beam of a spot light; places are parts of the beam, from "
        "the top left corner.");
    d.param("barndoor_top_left", &Barndoor::barndoor_top_left, "Left end of the upper flap.");
    d.param("barndoor_top_right", &Barndoor::barndoor_top_right, "Its right end.");
    d.param("barndoor_top_edge", &Barndoor::barndoor_top_edge, "Width over which its edge fades.");
    d.param("barndoor_right_top", &Barndoor::barndoor_right_top, "Upper end of the right flap.");
    d.param("barndoor_right_bottom", &Barndoor::barndoor_right_bottom, "Its lower end.");
    d.param("barndoor_right_edge", &Barndoor::barndoor_right_edge,
            "Width over which its edge fades.");
    d.param("barndoor_bottom_left", &Barndoor::barndoor_bottom_left,
            "Left end of the lower flap.");
    d.param("barndoor_bottom_right", &Barndoor::barndoor_bottom_right, "Its right end.");
    d.param("barndoor_bottom_edge", &Barndoor::barndoor_bottom_edge,
            "Width over which its edge fades.");
    d.param("barndoor_left_top", &Barndoor::barndoor_left_top, "Upper end of the left flap.");
    d.param("barndoor_left_bottom", &Barndoor::barndoor_left_bottom, "Its lower end.");
    d.param("barndoor_left_edge", &Barndoor::barndoor_left_edge,
            "Width over which its edge fades.");
    return d.done();
}

/// What passes an edge: 0 outside of it, 1 from `width` inside on.
float past_edge(float inside, float width) {
    if (!(width > 0)) return inside >= 0 ? 1.0F : 0.0F;
    const float t = std::clamp(inside / width, 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

class Flaps final : public LightFilter {
  public:
    Flaps(const Barndoor& node, const LightPlace& place) : n_(node), place_(place) {}
    [[nodiscard]] Color filtered(Color radiance, Vec3f, Vec3f to, float) const override {
        const std::optional<Vec2f> at = beam_place(place_, to);
        if (!at) return kBlack;
        const float x = at->x, y = at->y;
        const float top = lerp(n_.barndoor_top_left, n_.barndoor_top_right, x),
                    bottom = lerp(n_.barndoor_bottom_left, n_.barndoor_bottom_right, x),
                    left = lerp(n_.barndoor_left_top, n_.barndoor_left_bottom, y),
                    right = lerp(n_.barndoor_right_top, n_.barndoor_right_bottom, y);
        // A flap that is open (at the end of the beam or beyond) takes nothing, whatever the shape of the beam.
        float factor = 1;
        if (top > 0) factor *= past_edge(y - top, n_.barndoor_top_edge);
        if (bottom < 1) factor *= past_edge(bottom - y, n_.barndoor_bottom_edge);
        if (left > 0) factor *= past_edge(x - left, n_.barndoor_left_edge);
        if (right < 1) factor *= past_edge(right - x, n_.barndoor_right_edge);
        return radiance * factor;
    }

  private:
    Barndoor n_;
    LightPlace place_;
};

std::unique_ptr<LightFilter> Barndoor::make_light_filter(NodeContext& context,
                                                         const LightPlace& place) const {
    if (!has_beam(place, context, "barndoor")) return nullptr;
    return std::make_unique<Flaps>(*this, place);
}

}  // namespace

NodeType node_barndoor() { return Barndoor::describe(); }

}  // namespace lightsieve
