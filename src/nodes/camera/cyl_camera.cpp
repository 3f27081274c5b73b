// cyl_camera: a picture on a cylinder around the eye, by longitude.
//
// Arnold documents two ways to look along the height. `projective` off: all rays start at the middle of the cylinder, in
// height like those of a pinhole. On: they start along its axis, in height like those of an orthographic camera. The
// cylinder's radius is not documented; it is taken as 1, so that both show the same at that distance.
#include "nodes/camera/camera_common.h"
#include "nodes/camera/panorama.h"

namespace lightsieve {
namespace {

constexpr float kHorizontalFov = 60, kVerticalFov = 90;
/// Tangents are tame below it [deg].
constexpr float kMaxVerticalFov = 179.9F;

struct CylCamera : CameraCommon {
    Array<float> horizontal_fov{&kHorizontalFov, 1, 1}, vertical_fov{&kVerticalFov, 1, 1};
    bool projective = true;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const;
};

class CylCameraRays final : public PlacedCamera {
  public:
    CylCameraRays(const CylCamera& p, NodeContext& context)
        : PlacedCamera(p, context),
          horizontal_(keyed(p.horizontal_fov, kHorizontalFov)),
          vertical_(keyed(p.vertical_fov, kVerticalFov)),
          projective_(p.projective) {}

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f, float time) const override {
        const Vec2f p = window_point(film, time);
        const float half = deg_to_rad(std::clamp(horizontal_.at(time), 0.0F, 360.0F)) * 0.5F;
        const float height =
            p.y *
            std::tan(deg_to_rad(std::clamp(vertical_.at(time), 0.0F, kMaxVerticalFov)) * 0.5F);
        LocalRay out;
        out.direction = panorama_direction(p.x * half, 0);
        if (projective_)
            out.origin.y = height;
        else
            out.direction = normalize(out.direction + Vec3f{0, height, 0});
        out.spread = half * pixel_width();
        return out;
    }

    Keyed<float> horizontal_, vertical_;
    bool projective_;
};

NodeType CylCamera::describe() {
    Describe<CylCamera> d("cyl_camera", NodeKind::Camera,
                          "A picture on a cylinder around the eye, by longitude.");
    describe_camera_common(d);
    d.param("horizontal_fov", &CylCamera::horizontal_fov, "Full angle across the frame.")
        .unit("deg")
        .range(0, 360);
    d.param("vertical_fov", &CylCamera::vertical_fov,
            "Full angle over the frame's height, seen from the middle of the cylinder.")
        .unit("deg")
        .range(0, kMaxVerticalFov);
    d.param("projective", &CylCamera::projective,
            "Rays start along the axis of a cylinder of radius 1, without perspective in height; "
            "off: all start at one point.");
    return d.done();
}

std::unique_ptr<Camera> CylCamera::make_camera(NodeContext& context) const {
    return std::make_unique<CylCameraRays>(*this, context);
}

}  // namespace

NodeType node_cyl_camera() { return CylCamera::describe(); }

}  // namespace lightsieve
