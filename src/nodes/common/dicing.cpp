#include "nodes/common/dicing.h"

#include "scene/graph.h"

namespace lightsieve {
namespace {

template <class T>
T first_of(const NodeInstance& node, const char* param, T fallback) {
    if (const auto* list = node.find<Array<T>>(param); list != nullptr)
        return list->empty() ? fallback : (*list)[0];
    const auto* one = node.find<T>(param);
    return one == nullptr ? fallback : *one;
}

}  // namespace

DicingView::DicingView(const NodeInstance* camera, NodeContext::Frame frame) {
    const auto width = static_cast<float>(frame.width);
    pixels_ = width / (2 * kPi);
    if (camera == nullptr) return;
    const auto* matrix = camera->find<Array<Mat4f>>("matrix");
    eye_ = matrix != nullptr && !matrix->empty() ? (*matrix)[0].point({})
                                                 : first_of(*camera, "position", Vec3f{});
    const float window = first_of(*camera, "screen_window_max", Vec2f{1, 1}).x -
                         first_of(*camera, "screen_window_min", Vec2f{-1, -1}).x;
    const float share = window > 0 ? 2 / window : 1;
    const Name type = camera->type().name;
    if (type == Name("ortho_camera")) {
        parallel_ = true;
        pixels_ = width / 2 * share;
    } else if (type == Name("persp_camera")) {
        constexpr float kLeastFov = 0.01F, kMostFov = 179;
        const float fov = std::clamp(first_of(*camera, "fov", 60.0F), kLeastFov, kMostFov);
        pixels_ = width / (2 * std::tan(deg_to_rad(fov) / 2)) * share;
    }
}

float DicingView::pixels(Vec3f p, float length_in_scene) const {
    if (parallel_) return length_in_scene * pixels_;
    // Nearer than its own size a thing fills the picture, no matter how near exactly.
    const float distance = std::max(length(p - eye_), length_in_scene);
    return distance > 0 ? length_in_scene * pixels_ / distance : 0;
}

}  // namespace lightsieve
