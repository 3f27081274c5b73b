// ortho_camera: parallel rays along the viewing axis.
#include "nodes/camera/camera_common.h"

namespace lightsieve {
namespace {

class OrthoCameraRays final : public PlacedCamera {
  public:
    using PlacedCamera::PlacedCamera;

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f, float time) const override {
        const Vec2f screen = screen_point(film, time);
        return {{screen.x, screen.y, 0}, {0, 0, -1}, 0, pixel_width()};
    }
};

struct OrthoCamera : CameraCommon {
    static NodeType describe() {
        Describe<OrthoCamera> d(
            "ortho_camera", NodeKind::Camera,
            "Parallel projection; the screen window gives the frame's size in scene units.");
        describe_camera_common(d);
        return d.done();
    }
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const {
        return std::make_unique<OrthoCameraRays>(*this, context);
    }
};

}  // namespace

NodeType node_ortho_camera() { return OrthoCamera::describe(); }

}  // namespace lightsieve
