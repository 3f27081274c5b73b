// persp_camera: the pinhole or thin-lens camera.
//
// From the film outward: screen window, radial distortion, lens shift, lens tilt. Arnold documents what these do, not
// the formulas. Radial distortion here is Brown's cubic term with the screen's half width as unit (Brown 1966,
// "Decentering Distortion of Lenses"), `cubic_inverse` its inverse. Tilt turns the plane of projection, so that a camera
// that looks up by an angle shows upright lines as such with a vertical tilt of that angle.
#include "nodes/camera/camera_common.h"
#include "nodes/camera/lens.h"

namespace lightsieve {
namespace {

/// Fields of view are kept away from 0 and 180 degrees, where the picture degenerates.
constexpr float kMinFov = 1e-3F, kMaxFov = 179.9F;
constexpr Vec2f kNoShift{0, 0};
constexpr float kNoDistortion = 0;

enum class Distortion : std::int32_t { Cubic, CubicInverse };

struct PerspCamera : CameraCommon, LensParams {
    Array<float> fov{&camera_defaults::kFov, 1, 1};  ///< horizontal full angle
    Array<float> radial_distortion{&kNoDistortion, 1, 1};
    Distortion radial_distortion_type = Distortion::Cubic;
    Array<Vec2f> lens_shift{&kNoShift, 1, 1};
    Array<Vec2f> lens_tilt_angle{&kNoShift, 1, 1};

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const;
};

/// The distance r from r (1 + k r^2) = `distorted`; the nearest one there is where k < 0 has folded the picture.
float undistorted(float distorted, float k) {
    if (k < 0) {
        const float fold = 1 / std::sqrt(-3 * k);
        if (!(distorted < fold * (2.0F / 3))) return fold;
    }
    // Newton from the side on which the curve bends toward the root, so that it cannot overshoot.
    float r = k < 0 ? distorted : std::min(distorted, std::cbrt(distorted / k));
    for (int i = 0; i < 20; ++i) {
        const float step = (r * (1 + k * r * r) - distorted) / (1 + 3 * k * r * r);
        r -= step;
        if (!(std::abs(step) > 1e-7F * r)) break;
    }
    return r;
}

class PerspCameraRays final : public PlacedCamera {
  public:
    PerspCameraRays(const PerspCamera& p, NodeContext& context)
        : PlacedCamera(p, context),
          fov_(keyed(p.fov, camera_defaults::kFov)),
          distortion_(keyed(p.radial_distortion, kNoDistortion)),
          shift_(keyed(p.lens_shift, kNoShift)),
          tilt_(keyed(p.lens_tilt_angle, kNoShift)),
          inverse_(p.radial_distortion_type == Distortion::CubicInverse),
          lens_(p, keyed(p.focus_distance, camera_defaults::kFocusDistance),
                keyed(p.aperture_size, camera_defaults::kApertureSize)),
          plain_(is_zero(shift_) && is_zero(tilt_) && is_zero(distortion_)),
          fixed_tan_(tan_half_fov(0)) {
        spread_ = std::atan(fixed_tan_ * pixel_width());
    }

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f lens, float time) const override {
        // Screen point to direction: (sx tan, sy tan ratio, -1).
        const float tan_half = fov_.moves() ? tan_half_fov(time) : fixed_tan_;
        const Vec2f screen = screen_point(film, time);
        LocalRay out;
        out.spread = spread_;
        out.direction = plain_ ? Vec3f{screen.x * tan_half, screen.y * tan_half, -1}
                               : through_lens(screen, tan_half, time);
        if (out.direction.z < 0) lens_.bend(out.origin, out.direction, lens, time);
        return out;
    }

    /// Distortion, shift and tilt. z = -1, or the zero vector where the tilted film lies behind the lens.
    [[nodiscard]] Vec3f through_lens(Vec2f screen, float tan_half, float time) const {
        Vec2f p = screen;
        if (const float k = distortion_.at(time); k != 0) {
            const float r2 = p.x * p.x + p.y * p.y, r = std::sqrt(r2);
            p = p * (inverse_ ? (r > 0 ? undistorted(r, k) / r : 1) : 1 + k * r2);
        }
        const Vec2f shift = shift_.at(time);
        p = p + Vec2f{mirror() * shift.x, -shift.y * frame_ratio()};
        const Vec2f tilt = tilt_.at(time);
        const float ax = deg_to_rad(tilt.x) * mirror(), ay = deg_to_rad(tilt.y);
        const Vec3f right{std::cos(ax), 0, -std::sin(ax)}, up{0, std::cos(ay), -std::sin(ay)};
        const Vec3f d = (right * p.x + up * p.y) * tan_half + Vec3f{0, 0, -1};
        return d.z < 0 && is_finite(d) ? d * (1 / -d.z) : Vec3f{};
    }

    [[nodiscard]] float tan_half_fov(float time) const {
        return std::tan(deg_to_rad(std::clamp(fov_.at(time), kMinFov, kMaxFov)) * 0.5F);
    }
    template <class V>
    static bool is_zero(const Keyed<V>& keys) {
        return std::all_of(keys.keys().begin(), keys.keys().end(),
                           [](const V& v) { return v == V{}; });
    }

    Keyed<float> fov_, distortion_;
    Keyed<Vec2f> shift_, tilt_;
    bool inverse_;
    Lens lens_;
    bool plain_;        ///< neither distortion nor shift nor tilt
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
    describe_lens(d);
    d.param("flat_field_focus", &LensParams::flat_field_focus,
            "Sharp on a plane; off: on a sphere around the eye.");
    d.param("radial_distortion", &PerspCamera::radial_distortion,
            "Above 0: barrel distortion, below: pincushion. The direction of a screen point at "
            "distance r from the middle is that of r (1 + radial_distortion r^2).")
        .range(-0.3F, 1);
    d.param("radial_distortion_type", &PerspCamera::radial_distortion_type,
            "cubic_inverse: the inverse of that.")
        .names({"cubic", "cubic_inverse"});
    d.param("lens_shift", &PerspCamera::lens_shift,
            "Moves the frame on the film: 1 moves its middle to the right or lower edge.");
    d.param("lens_tilt_angle", &PerspCamera::lens_tilt_angle,
            "Turns the plane of projection, across and upward. A camera that looks up by an angle "
            "shows upright lines upright with that angle as the second number.")
        .unit("deg");
    return d.done();
}

std::unique_ptr<Camera> PerspCamera::make_camera(NodeContext& context) const {
    return std::make_unique<PerspCameraRays>(*this, context);
}

}  // namespace

NodeType node_persp_camera() { return PerspCamera::describe(); }

}  // namespace lightsieve
