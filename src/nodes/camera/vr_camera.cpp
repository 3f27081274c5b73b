// vr_camera: a pair of pictures all around, one for each eye.
//
// Each ray starts where the eye would be if the head had turned to that longitude: sideways by half of the eyes'
// separation, forward by the distance from the neck's axis. Above and below, where turning the head means nothing, the
// eyes are brought together (`merge`). Source of the geometry: Peleg, Ben-Ezra and Pritch 2001, "Omnistereo: Panoramic
// Stereo Imaging".
// The order of a cube map's faces is not documented; it is the usual right, left, up, down, front, back, in rows of six or
// of three.
#include "nodes/camera/camera_common.h"
#include "nodes/camera/panorama.h"

namespace lightsieve {
namespace {

enum class VrMode : std::int32_t { SideBySide, OverUnder, LeftEye, RightEye };
enum class VrProjection : std::int32_t { LatLong, Cube6x1, Cube3x2 };
enum class VrMerge : std::int32_t { None, Cosine, Shader };

struct VrCamera : CameraCommon {
    VrMode mode = VrMode::SideBySide;
    VrProjection projection = VrProjection::LatLong;
    float eye_separation = 0.65F, eye_to_neck = 0;
    VrMerge top_merge_mode = VrMerge::Cosine, bottom_merge_mode = VrMerge::Cosine;
    float top_merge_angle = 90, bottom_merge_angle = 90;
    float merge_shader = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Camera> make_camera(NodeContext& context) const;
};

/// A direction of a cube map; `p` runs over its frame from -1 to 1, y up.
Vec3f cube_direction(Vec2f p, int columns, int rows) {
    const float x = std::clamp((p.x + 1) * 0.5F, 0.0F, 1.0F) * static_cast<float>(columns),
                y = std::clamp((1 - p.y) * 0.5F, 0.0F, 1.0F) * static_cast<float>(rows);
    const int column = std::min(static_cast<int>(x), columns - 1),
              row = std::min(static_cast<int>(y), rows - 1);
    const float a = 2 * (x - static_cast<float>(column)) - 1,
                b = 1 - 2 * (y - static_cast<float>(row));
    switch (row * columns + column) {
        case 0: return normalize(Vec3f{1, b, a});    // right
        case 1: return normalize(Vec3f{-1, b, -a});  // left
        case 2: return normalize(Vec3f{a, 1, b});    // up: below it the front
        case 3: return normalize(Vec3f{a, -1, -b});  // down: above it the front
        case 4: return normalize(Vec3f{a, b, -1});   // front
        default: return normalize(Vec3f{-a, b, 1});  // back
    }
}

class VrCameraRays final : public PlacedCamera {
  public:
    VrCameraRays(const VrCamera& p, NodeContext& context)
        : PlacedCamera(p, context),
          p_(p),
          merge_shader_(context.color_input("merge_shader")),
          top_(deg_to_rad(std::clamp(p.top_merge_angle, 0.0F, 180.0F))),
          bottom_(std::max(top_, deg_to_rad(std::clamp(p.bottom_merge_angle, 0.0F, 180.0F)))) {}

  private:
    [[nodiscard]] LocalRay local_ray(Vec2f film, Vec2f, float time) const override {
        const float eye = split(film);
        const Vec2f p = window_point(film, time);
        LocalRay out;
        switch (p_.projection) {
            case VrProjection::LatLong:
                out.direction = panorama_direction(p.x * kPi, p.y * kPi * 0.5F);
                break;
            case VrProjection::Cube6x1: out.direction = cube_direction(p, 6, 1); break;
            case VrProjection::Cube3x2: out.direction = cube_direction(p, 3, 2); break;
        }
        const Vec3f forward = normalize(Vec3f{out.direction.x, 0, out.direction.z}, {0, 0, -1});
        const Vec3f right{-forward.z, 0, forward.x};
        const float apart =
            0.5F * p_.eye_separation * (1 - merge(out.direction, {film.x, 1 - film.y}));
        out.origin = right * (eye * apart) + forward * p_.eye_to_neck;
        out.spread = kPi * pixel_width();
        return out;
    }

    /// Which eye a place of the film belongs to, -1 left, 1 right; moves it to its place in that eye's picture.
    [[nodiscard]] float split(Vec2f& film) const {
        switch (p_.mode) {
            case VrMode::SideBySide: return halve(film.x);
            case VrMode::OverUnder: return halve(film.y);
            case VrMode::LeftEye: return -1;
            case VrMode::RightEye: break;
        }
        return 1;
    }
    static float halve(float& x) {
        const bool second = x >= 0.5F;
        x = 2 * x - (second ? 1.0F : 0.0F);
        return second ? 1.0F : -1.0F;
    }

    /// How far the eyes are brought together: 0 not, 1 fully.
    [[nodiscard]] float merge(Vec3f direction, Vec2f uv) const {
        const float polar = std::acos(std::clamp(direction.y, -1.0F, 1.0F));
        if (polar < top_) return merged(p_.top_merge_mode, 1 - polar / top_, uv);
        if (polar > bottom_)
            return merged(p_.bottom_merge_mode, (polar - bottom_) / (kPi - bottom_), uv);
        return 0;
    }
    /// way  0 where merging begins to 1 at the pole
    [[nodiscard]] float merged(VrMerge mode, float way, Vec2f uv) const {
        switch (mode) {
            case VrMerge::None: return 0;
            case VrMerge::Cosine: return 1 - std::cos(way * kPi * 0.5F);
            case VrMerge::Shader: break;
        }
        ShadePoint point;
        point.uv = uv;
        return std::clamp(average(merge_shader_.at(point)), 0.0F, 1.0F);
    }

    VrCamera p_;
    ColorInput merge_shader_;
    float top_, bottom_;  ///< polar angles at which merging begins [rad]
};

NodeType VrCamera::describe() {
    Describe<VrCamera> d("vr_camera", NodeKind::Camera,
                         "A pair of pictures all around, one for each eye.");
    describe_camera_common(d);
    d.param("mode", &VrCamera::mode, "Where the pictures of the left and the right eye lie.")
        .names({"side_by_side", "over_under", "left_eye", "right_eye"});
    d.param("projection", &VrCamera::projection,
            "Layout of a picture. Cube maps show right, left, up, down, front, back.")
        .names({"latlong", "cubemap_6x1", "cubemap_3x2"});
    d.param("eye_separation", &VrCamera::eye_separation, "Distance between the eyes.")
        .unit("scene units");
    d.param("eye_to_neck", &VrCamera::eye_to_neck,
            "How far the eyes lie before the axis about which the head turns.")
        .unit("scene units");
    const std::vector<std::string> merges{"none", "cosine", "shader"};
    d.param("top_merge_mode", &VrCamera::top_merge_mode,
            "How the eyes come together toward the zenith.")
        .names(merges);
    d.param("top_merge_angle", &VrCamera::top_merge_angle,
            "Angle to the zenith at which that begins.")
        .unit("deg")
        .range(0, 180);
    d.param("bottom_merge_mode", &VrCamera::bottom_merge_mode,
            "How the eyes come together toward the nadir.")
        .names(merges);
    d.param("bottom_merge_angle", &VrCamera::bottom_merge_angle,
            "Angle to the zenith at which that begins, at least top_merge_angle.")
        .unit("deg")
        .range(0, 180);
    d.param("merge_shader", &VrCamera::merge_shader,
            "How far the eyes come together with merge mode `shader`: 0 not, 1 fully. Evaluated "
            "over each eye's picture.");
    return d.done();
}

std::unique_ptr<Camera> VrCamera::make_camera(NodeContext& context) const {
    return std::make_unique<VrCameraRays>(*this, context);
}

}  // namespace

NodeType node_vr_camera() { return VrCamera::describe(); }

}  // namespace lightsieve
