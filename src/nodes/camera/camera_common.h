// What all cameras share: parameters, their documentation, placement with motion, the shutter, the screen window.
//
// A camera looks along its local -Z, +X right, +Y up. It is placed by `matrix`, or else by position, look_at, up.
// The film's point (0,0) is the upper left corner of the frame; screen points run over the screen window with y up.
// A kind of camera only says where in its own space a ray goes (`local_ray`); all else is done here.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/diagnostics.h"
#include "nodes/common/keyed.h"
#include "scene/camera.h"
#include "scene/describe.h"
#include "scene/node_context.h"

namespace lightsieve {

namespace camera_defaults {
inline constexpr Vec2f kWindowMin{-1, -1}, kWindowMax{1, 1};
inline constexpr Vec3f kPosition{0, 0, 0}, kLookAt{0, 0, -1}, kUp{0, 1, 0};
inline constexpr float kFov = 60, kFocusDistance = 1, kApertureSize = 0;
}  // namespace camera_defaults

enum class Handedness : std::int32_t { Right, Left };
enum class ShutterType : std::int32_t { Box, Triangle, Curve };
enum class RollingShutter : std::int32_t { Off, Top, Bottom, Left, Right };

/// Parameters of every camera node.
struct CameraCommon {
    Array<Mat4f> matrix;                                       ///< world_from_camera, one a key
    Array<Vec3f> position{&camera_defaults::kPosition, 1, 1};  ///< used where no matrix is written
    Array<Vec3f> look_at{&camera_defaults::kLookAt, 1, 1};  ///< point in the middle of the picture
    Array<Vec3f> up{&camera_defaults::kUp, 1, 1};           ///< need not be orthogonal to the view
    Handedness handedness = Handedness::Right;              ///< left mirrors the picture's x
    float near_clip = 1e-4F, far_clip = 1e30F;              ///< along the viewing axis
    Array<Vec2f> screen_window_min{&camera_defaults::kWindowMin, 1, 1};
    Array<Vec2f> screen_window_max{&camera_defaults::kWindowMax, 1, 1};
    float exposure = 0;                        ///< f-stops
    float shutter_start = 0, shutter_end = 0;  ///< on the clock of motion keys
    ShutterType shutter_type = ShutterType::Box;
    Array<Vec2f> shutter_curve;  ///< (time, openness) with shutter_type curve
    RollingShutter rolling_shutter = RollingShutter::Off;
    float rolling_shutter_duration = 0;
    float motion_start = 0, motion_end = 1;  ///< where the first and last key lie
    NodeRef filtermap;                       ///< a shader over the film
    Rgba uv_remap{{0, 0, 0}, 1};             ///< acts only when linked
};

/// Documents the parameters of `CameraCommon`.
template <class T>
void describe_camera_common(Describe<T>& d) {
    d.param("matrix", &CameraCommon::matrix,
            "Placement in the world, row vectors; one matrix a motion key.");
    d.param("position", &CameraCommon::position,
            "Place of the eye; used if no matrix is written.");
    d.param("look_at", &CameraCommon::look_at,
            "Point that the camera looks at; used if no matrix is written.");
    d.param("up", &CameraCommon::up,
            "Direction that points up in the picture; used if no matrix is written.");
    d.param("handedness", &CameraCommon::handedness,
            "Handedness of the camera's axes; left mirrors the picture.")
        .names({"right", "left"});
    d.param("near_clip", &CameraCommon::near_clip,
            "Nearest depth along the viewing axis that is seen.")
        .unit("scene units");
    d.param("far_clip", &CameraCommon::far_clip,
            "Farthest depth along the viewing axis that is seen.")
        .unit("scene units");
    d.param("screen_window_min", &CameraCommon::screen_window_min,
            "Screen point at the left and bottom of the frame.");
    d.param("screen_window_max", &CameraCommon::screen_window_max,
            "Screen point at the right and top of the frame.");
    d.param("exposure", &CameraCommon::exposure, "The picture is multiplied by 2^exposure.")
        .unit("f-stops");
    d.param("shutter_start", &CameraCommon::shutter_start, "Time at which the shutter opens.")
        .unit("frames");
    d.param("shutter_end", &CameraCommon::shutter_end, "Time at which the shutter closes.")
        .unit("frames");
    d.param("shutter_type", &CameraCommon::shutter_type,
            "How openness changes while the shutter is open.")
        .names({"box", "triangle", "curve"});
    d.param("shutter_curve", &CameraCommon::shutter_curve,
            "Points (time in 0..1, openness) of a polyline, for shutter_type curve.");
    d.param("rolling_shutter", &CameraCommon::rolling_shutter,
            "Edge of the frame that is exposed first.")
        .names({"off", "top", "bottom", "left", "right"});
    d.param("rolling_shutter_duration", &CameraCommon::rolling_shutter_duration,
            "Part of the shutter in which one line is exposed, with rolling_shutter: 0 is an "
            "instant, 1 the whole time.")
        .hard_range(0, 1);
    d.param("motion_start", &CameraCommon::motion_start, "Time of the first motion key.")
        .unit("frames");
    d.param("motion_end", &CameraCommon::motion_end, "Time of the last motion key.")
        .unit("frames");
    d.param("filtermap", &CameraCommon::filtermap,
            "Shader over the film (u to the right, v upward, 0 to 1) whose mean of the channels "
            "multiplies the picture. Where it is black nothing is traced.");
    d.param("uv_remap", &CameraCommon::uv_remap,
            "Shader over the film whose red and green are the film coordinates to look through "
            "instead. Acts only when linked.");
}

/// The shutter as a density over [0,1): a polyline through (time, openness).
class Shutter {
  public:
    /// Open the whole time.
    Shutter() = default;
    /// points  times increasing within [0,1], openness >= 0 and not all 0
    explicit Shutter(std::vector<Vec2f> points);
    /// Maps a uniform number to a time [0,1).
    [[nodiscard]] float sample(float u) const;

  private:
    std::vector<Vec2f> points_;  ///< empty: box
    std::vector<float> area_;    ///< below the polyline up to each point, from 0 to 1
};

/// Placement, shutter and frame of a camera, checked; base of the camera classes.
class PlacedCamera : public Camera {
  public:
    PlacedCamera(const CameraCommon& params, NodeContext& context);
    [[nodiscard]] Mat4f camera_from_world(float time) const override {
        return world_from_camera_.moves() ? world_from_camera_.at(time).inverse()
                                          : camera_from_world_;
    }
    [[nodiscard]] float sample_time(Vec2f film, float u) const override;
    [[nodiscard]] CameraRay ray(Vec2f film, Vec2f lens, float time) const final;
    [[nodiscard]] float shutter_start() const override { return clock_.start; }
    [[nodiscard]] float shutter_end() const override { return clock_.end; }

  protected:
    /// A ray in the camera's own space.
    struct LocalRay {
        Vec3f origin{};
        /// Of the length that goes with a depth of 1 at the clipping planes: z = -1 where they are planes, a unit vector
        /// where they are spheres. The zero vector: the camera sees nothing there.
        Vec3f direction{};
        float spread = 0, width = 0;  ///< as in CameraRay
    };
    /// film  after uv_remap; lens, time: as in Camera::ray
    [[nodiscard]] virtual LocalRay local_ray(Vec2f film, Vec2f lens, float time) const = 0;

    /// A film point in the screen window, x mirrored for left handedness, y up.
    [[nodiscard]] Vec2f window_point(Vec2f film, float time) const;
    /// The same with `frame_ratio` on y. With it these are the formulas of the scene format: x = sx,
    /// y = sy * (yres/xres) / pixel_aspect_ratio.
    [[nodiscard]] Vec2f screen_point(Vec2f film, float time) const;
    /// Height of the frame over its width, as it is shown.
    [[nodiscard]] float frame_ratio() const { return frame_ratio_; }
    /// -1 for left handedness.
    [[nodiscard]] float mirror() const { return mirror_; }
    /// Motion keys of another parameter of this camera.
    template <class V>
    [[nodiscard]] Keyed<V> keyed(const Array<V>& array, V fallback) const {
        return Keyed<V>(key_values(array, fallback), motion_, clock_);
    }
    /// Width of one pixel on the screen at shutter time 0, in screen units.
    [[nodiscard]] float pixel_width() const;

  private:
    ClockInterval motion_, clock_;
    Keyed<Mat4f> world_from_camera_;
    Mat4f camera_from_world_;  ///< at shutter time 0
    Keyed<Vec2f> window_min_, window_max_;
    Shutter shutter_;
    RollingShutter rolling_;
    float rolling_duration_;                          ///< of one line, as a part of the shutter
    std::optional<ColorInput> uv_remap_, filtermap_;  ///< where they are used
    float mirror_ = 1;                                ///< -1 for left handedness
    float frame_ratio_ = 1;                           ///< (yres/xres) / pixel_aspect_ratio
    int frame_width_ = 1;                             ///< pixels
    float near_clip_, far_clip_, weight_ = 1;
};

}  // namespace lightsieve
