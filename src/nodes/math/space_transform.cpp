// space_transform: a point, vector or normal taken from one space to another.
#include "nodes/bump/bump_common.h"
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Transformed : std::int32_t { Point, Vector, Normal };
enum class Space : std::int32_t { World, Object, Camera, Screen, Tangent };

struct SpaceTransform {
    Vec3f input;
    Transformed type = Transformed::Point;
    Space from = Space::World, to = Space::World;
    Vec3f tangent, normal;
    bool normalize = false;
    float scale = 1;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const;

  private:
    [[nodiscard]] Mat4f world_from(Space space, const ShadePoint& at) const;
};

NodeType SpaceTransform::describe() {
    const std::vector<std::string> spaces{"world", "object", "camera", "screen", "tangent"};
    Describe<SpaceTransform> d("space_transform", NodeKind::Shader,
                               "A point, vector or normal taken from one space to another.");
    d.param("input", &SpaceTransform::input, "What is taken.");
    d.param("type", &SpaceTransform::type, "What it is.").names({"point", "vector", "normal"});
    d.param("from", &SpaceTransform::from, "The space that it is in.").names(spaces);
    d.param("to", &SpaceTransform::to, "The space that it is wanted in.").names(spaces);
    d.param("tangent", &SpaceTransform::tangent,
            "First axis of tangent space; acts when linked, else dP/du.");
    d.param("normal", &SpaceTransform::normal, "Last axis of tangent space; acts when linked.");
    d.param("normalize", &SpaceTransform::normalize, "The result gets length 1.");
    d.param("scale", &SpaceTransform::scale, "Factor on the result.");
    return d.done();
}

void SpaceTransform::prepare(NodeContext& context) {
    if (!context.is_linked("tangent")) tangent = {};
    if (!context.is_linked("normal")) normal = {};
    for (Space* space : {&from, &to})
        if (*space == Space::Screen) {
            context.diagnostics().warning(
                Code::ParamPending, "screen space is not supported yet: camera space is used",
                context.where(space == &from ? "from" : "to"));
            *space = Space::Camera;
        }
}

Mat4f SpaceTransform::world_from(Space space, const ShadePoint& at) const {
    switch (space) {
        case Space::World: return {};
        case Space::Object:
            return at.services != nullptr ? at.services->world_from_object(at) : Mat4f{};
        case Space::Camera:
        case Space::Screen:
            return at.ray != nullptr && at.ray->camera_from_world != nullptr
                       ? at.ray->camera_from_world->inverse()
                       : Mat4f{};
        case Space::Tangent: break;
    }
    const Frame frame = tangent_frame(at, outward_normal(at, normal), tangent);
    Mat4f out = Mat4f::translation(at.position);
    out.m[0] = {frame.x.x, frame.x.y, frame.x.z, 0};
    out.m[1] = {frame.y.x, frame.y.y, frame.y.z, 0};
    out.m[2] = {frame.z.x, frame.z.y, frame.z.z, 0};
    return out;
}

Vec3f SpaceTransform::eval(const ShadePoint& at) const {
    const Mat4f m = world_from(from, at) * world_from(to, at).inverse();
    Vec3f v = type == Transformed::Point    ? m.point(input)
              : type == Transformed::Vector ? m.vector(input)
                                            : m.inverse().normal_by_inverse(input);
    if (normalize) v = lightsieve::normalize(v, {});
    return v * scale;
}

}  // namespace

NodeType node_space_transform() { return SpaceTransform::describe(); }

}  // namespace lightsieve
