// persp_camera: the pinhole or thin-lens camera.
#include "nodes/camera/camera_common.h"

#include "core/sampling.h"

namespace lightsieve {
namespace {

/// Fields of view are kept away from 0 and 180 degrees, where the picture degenerates.
constexpr float kMinFov = 1e-3F, kMaxFov = 179.9F;

struct PerspCamera : CameraCommon {
    Array<float> fov{&camera_defaults::kFov, 1, 1};  ///< horizontal full angle
    Array<float> focus_distance{&camera_defaults::kFocusDistance, 1, 1};  ///< from the eye
    Array<float> aperture_size{&camera_defaults::kApertureSize, 1, 1};    ///< radius of the lens
    std::int32_t aperture_blades = 0;                                     ///< fewer than 3: a disc
    float aperture_blade_curvature = 0;  ///< 1: a disc, below 0: a star
    float aperture_rotation = 0;
    float aperture_aspect_ratio = 1;
    bool flat_field_focus = true;  ///< focus on a plane, not on a sphere

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const;
};

class PerspCameraRays final : public PlacedCamera {
  public:
    PerspCameraRays(const PerspCamera& p, NodeContext& context)
        : PlacedCamera(p, context),
          fov_(keyed(p.fov, camera_defaults::kFov)),
          focus_distance_(keyed(p.focus_distance, camera_defaults::kFocusDistance)),
          aperture_size_(keyed(p.aperture_size, camera_defaults::kApertureSize)),
          has_lens_(std::any_of(aperture_size_.keys().begin(), aperture_size_.keys().end(),
                                [](float r) { return r > 0; })),
          n_blades_(p.aperture_blades >= 3 ? p.aperture_blades : 0),
          curvature_(std::clamp(p.aperture_blade_curvature, -1.0F, 1.0F)),
          rotation_(deg_to_rad(p.aperture_rotation)),
          aspect_(p.aperture_aspect_ratio > 0 ? p.aperture_aspect_ratio : 1),
          flat_focus_(p.flat_field_focus),
          fixed_tan_(tan_half_fov(0)) {
        spread_ = std::atan(fixed_tan_ * pixel_width());
    }

    [[nodiscard]] CameraRay ray(Vec2f film, Vec2f lens, float time) const override {
        // Screen point to direction: (sx tan, sy tan ratio, -1).
        const float tan_half = fov_.moves() ? tan_half_fov(time) : fixed_tan_;
        const Vec2f screen = screen_point(film, time);
        Vec3f origin{}, direction{screen.x * tan_half, screen.y * tan_half, -1};
        if (has_lens_) bend(origin, direction, lens, time);
        CameraRay out = to_world(origin, direction, time);
        out.spread = spread_;
        return out;
    }

  private:
    [[nodiscard]] float tan_half_fov(float time) const {
        return std::tan(deg_to_rad(std::clamp(fov_.at(time), kMinFov, kMaxFov)) * 0.5F);
    }

    /// Moves the ray's origin on the lens so that the point in focus stays where it is.
    void bend(Vec3f& origin, Vec3f& direction, Vec2f lens, float time) const {
        const float radius = aperture_size_.at(time), focus = focus_distance_.at(time);
        if (!(radius > 0 && focus > 0)) return;
        const Vec2f p = aperture_point(lens);
        origin = {p.x * radius * aspect_, p.y * radius, 0};
        const Vec3f in_focus = direction * (flat_focus_ ? focus : focus / length(direction));
        const Vec3f d = in_focus - origin;
        direction = d * (1 / -d.z);
    }

    /// A point of the unit aperture: a disc, or a polygon whose edges bend outward (curvature 1: a disc) or inward.
    [[nodiscard]] Vec2f aperture_point(Vec2f u) const {
        if (n_blades_ == 0) return sample_concentric_disk(u);
        // Choose a blade with the first number and stretch what is left of it.
        const float n = static_cast<float>(n_blades_);
        const float blade = std::min(std::floor(u.x * n), n - 1);
        const Vec2f b =
            sample_uniform_triangle({std::min(u.x * n - blade, kOneMinusEpsilon), u.y});
        const float sector = 2 * kPi / n, from = rotation_ + blade * sector;
        const Vec2f p{b.x * std::cos(from) + b.y * std::cos(from + sector),
                      b.x * std::sin(from) + b.y * std::sin(from + sector)};
        if (curvature_ == 0) return p;
        // Scale along the radius so that the polygon's edge moves toward the circle, or as far inward.
        const float angle = std::atan2(p.y, p.x) - from;
        const float edge = std::cos(sector * 0.5F) /
                           std::cos(angle - std::floor(angle / sector) * sector - sector * 0.5F);
        return p * ((edge + curvature_ * (1 - edge)) / edge);
    }

    Keyed<float> fov_, focus_distance_, aperture_size_;
    bool has_lens_;
    std::int32_t n_blades_;
    float curvature_, rotation_, aspect_;
    bool flat_focus_;
    float fixed_tan_;   ///< of half the field of view at shutter time 0
    float spread_ = 0;  ///< angle of one pixel in the middle of the frame
};

NodeType PerspCamera::describe() {
    Describe<PerspCamera> d("persp_camera", NodeKind::Camera,
                            "Perspective projection, with depth of field.");
    describe_camera_common(d);
    d.param("fov", &PerspCamera::fov,
            "Horizontal field of view, the full angle over screen x = -1..1.")
        .unit("deg")
        .range(kMinFov, kMaxFov);
    d.param("focus_distance", &PerspCamera::focus_distance, "Depth at which the picture is sharp.")
        .unit("scene units")
        .range(0, kInfinity);
    d.param("aperture_size", &PerspCamera::aperture_size, "Radius of the lens; 0 is a pinhole.")
        .unit("scene units")
        .range(0, kInfinity);
    d.param("aperture_blades", &PerspCamera::aperture_blades,
            "Edges of the aperture; fewer than 3 is a disc.");
    d.param("aperture_blade_curvature", &PerspCamera::aperture_blade_curvature,
            "0: straight edges, 1: a disc, below 0: edges bent inward.")
        .range(-1, 1);
    d.param("aperture_rotation", &PerspCamera::aperture_rotation, "Turns the aperture's polygon.")
        .unit("deg");
    d.param("aperture_aspect_ratio", &PerspCamera::aperture_aspect_ratio,
            "Width of the aperture over its height.");
    d.param("flat_field_focus", &PerspCamera::flat_field_focus,
            "Sharp on a plane; off: on a sphere around the eye.");
    return d.done();
}

std::unique_ptr<Camera> PerspCamera::make_camera(NodeContext& context) const {
    return std::make_unique<PerspCameraRays>(*this, context);
}

}  // namespace

NodeType node_persp_camera() { return PerspCamera::describe(); }

}  // namespace lightsieve
