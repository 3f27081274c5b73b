// triplanar: a texture thrown onto an object from three sides.
#include "nodes/texture/cells.h"
#include "nodes/texture/coord_space.h"

namespace lightsieve {
namespace {

struct Triplanar : SolidPlace {
    Lazy<Rgba> input{{{0, 0, 0}, 1}, {}}, input_Y{{{0, 0, 0}, 1}, {}}, input_Z{{{0, 0, 0}, 1}, {}};
    bool input_per_axis = false;
    Vec3f scale{1, 1, 1}, rotate, offset;
    float blend = 0;
    bool flip_on_opposite_direction = false, cell = false;
    float cell_rotate = 0, cell_blend = 0.1F;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Rgba from_side(const ShadePoint& at, Vec3f p, Vec3f n, int axis) const;
};

NodeType Triplanar::describe() {
    Describe<Triplanar> d("triplanar", NodeKind::Shader,
                          "A texture thrown onto an object along its three axes.");
    d.param("input", &Triplanar::input, "The texture.");
    d.param("input_per_axis", &Triplanar::input_per_axis, "Each axis has a texture of its own.");
    d.param("input_Y", &Triplanar::input_Y, "Texture along y, for input_per_axis.");
    d.param("input_Z", &Triplanar::input_Z, "Texture along z, for input_per_axis.");
    d.param("scale", &Triplanar::scale, "Copies a scene unit, by axis.");
    d.param("rotate", &Triplanar::rotate, "Turns the texture, by axis.").unit("deg");
    d.param("offset", &Triplanar::offset, "Moves the point.");
    describe_solid_place(d);
    d.param("blend", &Triplanar::blend, "Width over which sides blend into each other.")
        .range(0, 1);
    d.param("flip_on_opposite_direction", &Triplanar::flip_on_opposite_direction,
            "Mirrors the texture on the side that faces the negative axis.");
    d.param("cell", &Triplanar::cell, "Cuts the texture into random pieces.");
    d.param("cell_rotate", &Triplanar::cell_rotate, "Most by which pieces are turned.")
        .unit("deg");
    d.param("cell_blend", &Triplanar::cell_blend,
            "Arnold's blending of pieces; here their borders are sharp.")
        .ignored();
    return d.done();
}

Rgba Triplanar::from_side(const ShadePoint& at, Vec3f p, Vec3f n, int axis) const {
    const Vec2f flat = axis == 0 ? Vec2f{p.z, p.y} : axis == 1 ? Vec2f{p.x, p.z} : Vec2f{p.x, p.y};
    Vec2f uv = flat * scale[axis];
    if (flip_on_opposite_direction && n[axis] < 0) uv.x = -uv.x;
    float angle = deg_to_rad(rotate[axis]);
    if (cell) {
        const CellPoint piece = cell_at({uv.x, uv.y, static_cast<float>(axis) * 7}, 1);
        const auto random = [&](std::uint32_t i) {
            return unit_from_bits(mixed_bits(piece.id, i));
        };
        angle += deg_to_rad(cell_rotate) * (2 * random(30) - 1);
        uv = uv + Vec2f{random(31), random(32)};
    }
    const float c = std::cos(angle), s = std::sin(angle);
    ShadePoint point = at;
    point.uv = {c * uv.x - s * uv.y, s * uv.x + c * uv.y};
    point.uv_width = at.width * std::abs(scale[axis]);
    point.dp_du = point.dp_dv = {};
    const Lazy<Rgba>& texture = !input_per_axis || axis == 0 ? input
                                : axis == 1                  ? input_Y
                                                             : input_Z;
    return texture.at(point);
}

Rgba Triplanar::eval(const ShadePoint& at) const {
    const Vec3f p = place(at) + offset;
    Vec3f n = at.entering ? at.normal : -at.normal;
    if (coord_space != CoordSpace::World && at.services != nullptr)
        n = normalize(at.services->world_from_object(at).normal_by_inverse(n), n);
    // The side that faces most, and those within `blend` of it.
    Vec3f share;
    const float most = std::max(std::abs(n.x), std::max(std::abs(n.y), std::abs(n.z)));
    for (int axis = 0; axis < 3; ++axis) {
        const float behind = most - std::abs(n[axis]);
        share[axis] = unit(blend) > 0 ? std::max(0.0F, 1 - behind / unit(blend))
                                      : (behind > 0 ? 0.0F : 1.0F);
    }
    const float total = share.x + share.y + share.z;
    Rgba out{kBlack, 0};
    for (int axis = 0; axis < 3; ++axis) {
        if (!(share[axis] > 0)) continue;
        const Rgba side = from_side(at, p, n, axis);
        out.rgb += side.rgb * (share[axis] / total);
        out.a += side.a * (share[axis] / total);
    }
    return out;
}

}  // namespace

NodeType node_triplanar() { return Triplanar::describe(); }

}  // namespace lightsieve
