// fisheye_camera: a round picture in which the distance from the middle is the angle to the viewing axis.
//
// Arnold documents the field of view and `autocrop`, not the projection; the equidistant one is the usual meaning of a
// fisheye lens. The field of view is that of the circle, which touches the nearer edges of the frame; with `autocrop`
// it goes through the corners. Outside of it the picture is empty.
#include "nodes/camera/camera_common.h"
#include "nodes/camera/lens.h"

namespace lightsieve {
namespace {

constexpr float kFov = 90, kMinFov = 1e-3F, kMaxFov = 360;

struct FisheyeCamera : CameraCommon, LensParams {
    Array<float> fov{&kFov, 1, 1};  ///< full angle
    bool autocrop = false;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const;
};

class FisheyeCameraRays final : public PlacedCamera {
  public:
    FisheyeCameraRays(const FisheyeCamera& p, NodeContext& context)
        : PlacedCamera(p, context),
          fov_(keyed(p.fov, kFov)),
          lens_(p, keyed(p.focus_distance, camera_defaults::kFocusDistance),
                keyed(p.aperture_size, camera_defaults::kApertureSize)),
          radius_(p.autocrop ? std::sqrt(1 + frame_ratio() * frame_ratio())
                             : std::min(1.0F, frame_ratio())) {}

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f lens, float time) const override {
        const Vec2f screen = screen_point(film, time);
        const float distance = std::sqrt(screen.x * screen.x + screen.y * screen.y);
        const float half = deg_to_rad(std::clamp(fov_.at(time), kMinFov, kMaxFov)) * 0.5F;
        if (!(distance <= radius_)) return {};
        const float angle = distance / radius_ * half;
        const float across = distance > 0 ? std::sin(angle) / distance : 0;
        LocalRay out;
        out.direction = {screen.x * across, screen.y * across, -std::cos(angle)};
        out.spread = half / radius_ * pixel_width();
        lens_.bend_facing(out.origin, out.direction, lens, time);
        return out;
    }

    Keyed<float> fov_;
    Lens lens_;
    float radius_;  ///< of the circle on the screen
};

NodeType FisheyeCamera::describe() {
    Describe<FisheyeCamera> d("fisheye_camera", NodeKind::Camera,
                              "A round picture in which the distance from the middle is the angle "
                              "to the viewing axis; with depth of field.");
    describe_camera_common(d);
    d.param("fov", &FisheyeCamera::fov, "Field of view, the full angle across the circle.")
        .unit("deg")
        .range(kMinFov, kMaxFov);
    d.param("autocrop", &FisheyeCamera::autocrop,
            "The circle goes through the frame's corners; off: it fits into the frame.");
    describe_lens(d);
    return d.done();
}

std::unique_ptr<Camera> FisheyeCamera::make_camera(NodeContext& context) const {
    return std::make_unique<FisheyeCameraRays>(*this, context);
}

}  // namespace

NodeType node_fisheye_camera() { return FisheyeCamera::describe(); }

}  // namespace lightsieve
