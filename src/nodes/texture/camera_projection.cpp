// camera_projection: a picture thrown onto the scene from a camera, as a slide projector would.
#include "nodes/texture/coord_space.h"
#include "scene/graph.h"

namespace lightsieve {
namespace {

struct CameraProjection : SolidPlace {
    CameraProjection() { coord_space = CoordSpace::World; }
    Lazy<Rgba> projection_color{{{1, 1, 1}, 1}, {}};
    Lazy<Rgba> offscreen_color;
    float mask = 1;
    NodeRef camera;
    float aspect_ratio = 1.333F;
    bool front_facing = true, back_facing = true, use_shading_normal = false;

    // Found by prepare(); no camera: everything is off screen.
    Mat4f camera_from_world;
    Vec3f eye;
    Vec2f window_min{-1, -1}, window_max{1, 1};
    float tangent = 0;  ///< of half the field of view; 0: parallel rays
    bool has_camera = false;

    static NodeType describe();
    void prepare(NodeContext& context);
    [[nodiscard]] Rgba eval(const ShadePoint& at) const;

  private:
    /// Where a point lies in the picture, 0..1 inside of it; false behind the camera.
    [[nodiscard]] bool picture_place(Vec3f world, Vec2f& uv) const;
};

NodeType CameraProjection::describe() {
    using Node = CameraProjection;
    Describe<Node> d("camera_projection", NodeKind::Shader,
                     "A picture thrown onto the scene from a camera.");
    d.param("projection_color", &Node::projection_color, "The picture.");
    d.param("offscreen_color", &Node::offscreen_color, "What lies beside the picture.");
    d.param("mask", &Node::mask, "Part of the picture; 0: all is offscreen_color.").range(0, 1);
    d.param("camera", &Node::camera, "The camera; none: the one that renders.");
    d.param("aspect_ratio", &Node::aspect_ratio, "Width of the picture over its height.");
    d.param("front_facing", &Node::front_facing, "Surfaces that face the camera get the picture.");
    d.param("back_facing", &Node::back_facing, "So do those that face away.");
    d.param("use_shading_normal", &Node::use_shading_normal,
            "Facing goes by the shading normal, not by the geometric one.");
    describe_solid_place(d);
    return d.done();
}

void CameraProjection::prepare(NodeContext& context) {
    SolidPlace::prepare(context);
    const NodeInstance* node = camera ? camera.node : context.camera();
    has_camera = node != nullptr && node->kind() == NodeKind::Camera;
    if (!has_camera) return;
    const auto first = [&]<class T>(const char* param, T fallback) {
        const auto* values = node->find<Array<T>>(param);
        return values == nullptr || values->empty() ? fallback : (*values)[0];
    };
    const Mat4f place = node->is_set("matrix") ? first("matrix", Mat4f{})
                                               : Mat4f::look_at(first("position", Vec3f{}),
                                                                first("look_at", Vec3f{0, 0, -1}),
                                                                first("up", Vec3f{0, 1, 0}));
    camera_from_world = place.inverse();
    eye = place.point({});
    window_min = first("screen_window_min", window_min);
    window_max = first("screen_window_max", window_max);
    constexpr float kNarrowest = 0.01F, kWidest = 179;  // [deg]
    if (node->type().find("fov") != nullptr)
        tangent =
            std::tan(0.5F * deg_to_rad(std::clamp(first("fov", 60.0F), kNarrowest, kWidest)));
}

bool CameraProjection::picture_place(Vec3f world, Vec2f& uv) const {
    const Vec3f p = camera_from_world.point(world);
    if (!(p.z < 0)) return false;
    const float scale = tangent > 0 ? 1 / (-p.z * tangent) : 1;
    const Vec2f screen{p.x * scale, p.y * scale * aspect_ratio};
    uv = {(screen.x - window_min.x) / (window_max.x - window_min.x),
          (screen.y - window_min.y) / (window_max.y - window_min.y)};
    return std::isfinite(uv.x) && std::isfinite(uv.y);
}

Rgba CameraProjection::eval(const ShadePoint& at) const {
    Vec2f uv;
    const Vec3f p = place(at);
    const bool seen =
        has_camera && picture_place(p, uv) && uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1;
    const Vec3f shading = at.entering ? at.normal : -at.normal;
    const Vec3f n = use_shading_normal ? shading : at.geometric_normal;
    const bool facing = dot(n, eye - at.position) > 0;
    const float share = seen && (facing ? front_facing : back_facing) ? unit(mask) : 0;
    if (!(share > 0)) return offscreen_color.at(at);
    ShadePoint point = at;
    point.uv = uv;
    point.dp_du = point.dp_dv = {};
    const float depth = -camera_from_world.point(p).z;
    point.uv_width = 0.5F * at.width / (tangent > 0 ? depth * tangent : 1);
    const Rgba picture = projection_color.at(point);
    if (share == 1) return picture;
    const Rgba beside = offscreen_color.at(at);
    return {lerp(beside.rgb, picture.rgb, share), lerp(beside.a, picture.a, share)};
}

}  // namespace

NodeType node_camera_projection() { return CameraProjection::describe(); }

}  // namespace lightsieve
