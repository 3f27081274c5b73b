// spherical_camera: all around, by longitude and latitude.
//
// The screen window from -1 to 1 is the whole sphere, whatever the frame's shape: u = 1/2 + longitude / 2 pi to the right of
// the viewing axis, v = 1/2 + latitude / pi. So a picture of it is what a latlong skydome shows.
#include "nodes/camera/camera_common.h"
#include "nodes/camera/panorama.h"

namespace lightsieve {
namespace {

class SphericalCameraRays final : public PlacedCamera {
  public:
    using PlacedCamera::PlacedCamera;

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f, float time) const override {
        const Vec2f p = window_point(film, time);
        return {{}, panorama_direction(p.x * kPi, p.y * kPi * 0.5F), kPi * pixel_width(), 0};
    }
};

struct SphericalCamera : CameraCommon {
    static NodeType describe() {
        Describe<SphericalCamera> d("spherical_camera", NodeKind::Camera,
                                    "All around the eye, by longitude and latitude.");
        describe_camera_common(d);
        return d.done();
    }
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const {
        return std::make_unique<SphericalCameraRays>(*this, context);
    }
};

}  // namespace

NodeType node_spherical_camera() { return SphericalCamera::describe(); }

}  // namespace lightsieve
