#include "render/testing/lobe_truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace lightsieve::testing {
namespace {

/// Names of the AOVs that take what is scattered by this event first.
std::vector<std::string> aovs_of(const Event& event) {
    const bool diffuse = event.lobe == EventLobe::Diffuse;
    if (event.kind == EventKind::Transmission) return {diffuse ? "sss" : "transmission"};
    if (diffuse) return {"diffuse"};
    if (event.labels == std::vector<std::string>{"coat"}) return {"coat"};
    if (event.labels == std::vector<std::string>{"sheen"}) return {"sheen", "specular"};
    return {"specular"};
}

using Sums = std::map<std::string, std::array<double, 3>>;

/// The lobes at the point, evaluated one by one.
class Lobes {
  public:
    Lobes(const Scene& scene, const SeenPoint& point) : scene_(scene) {
        const auto object =
            std::find_if(scene.objects.begin(), scene.objects.end(),
                         [&](const SceneObject& o) { return o.name.view() == point.shape; });
        if (object == scene.objects.end()) throw std::runtime_error("no shape " + point.shape);
        ShadePoint at;
        at.position = point.position;
        at.wo = point.wo;
        at.normal = at.geometric_normal = point.normal;
        const Frame frame = Frame::from_z(point.normal);
        at.tangent = frame.x;
        set_.begin(point.wo, frame);
        object->shaders[0]->closures(at, set_);
    }
    /// Adds every lobe's value for a direction.
    void add(Vec3f wi, Color weight, Sums& sums) const {
        for (std::size_t i = 0; i < set_.closures().size(); ++i)
            add(i, set_.eval(i, wi).f * weight, sums);
    }
    /// Adds the weights of lobes with one direction.
    void add_mirrors(Sums& sums) const {
        for (std::size_t i = 0; i < set_.closures().size(); ++i)
            if (set_.delta(i)) add(i, set_.albedo(i), sums);
    }

  private:
    void add(std::size_t i, Color value, Sums& sums) const {
        for (const std::string& aov : aovs_of(scene_.events[set_.closures()[i].record->event]))
            for (int c = 0; c < 3; ++c)
                sums[aov][static_cast<std::size_t>(c)] += static_cast<double>(value[c]);
    }

    const Scene& scene_;
    ClosureSet set_;
};

LobeSums to_colors(const Sums& sums) {
    LobeSums out;
    for (const char* aov : {"diffuse", "specular", "coat", "sheen", "transmission", "sss"})
        out[aov] = kBlack;
    for (const auto& [aov, s] : sums)
        out[aov] = {static_cast<float>(s[0]), static_cast<float>(s[1]), static_cast<float>(s[2])};
    return out;
}

}  // namespace

LobeSums integrate_over_quad(const Scene& scene, const SeenPoint& point, Vec3f corner, Vec3f u,
                             Vec3f v, int n) {
    const Lobes lobes(scene, point);
    Sums sums;
    const Vec3f normal = cross(u, v);  // its length is the area
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const float s = (static_cast<float>(i) + 0.5F) / static_cast<float>(n),
                        t = (static_cast<float>(j) + 0.5F) / static_cast<float>(n);
            const Vec3f toward = corner + u * s + v * t - point.position;
            const float distance = length(toward);
            const Vec3f wi = toward / distance;
            const float solid_angle =
                std::abs(dot(normal, wi)) /
                (distance * distance * static_cast<float>(n) * static_cast<float>(n));
            lobes.add(wi, Color::grey(solid_angle), sums);
        }
    return to_colors(sums);
}

LobeSums integrate_over_sphere(const Scene& scene, const SeenPoint& point,
                               const std::function<Color(Vec3f)>& radiance, int n) {
    const Lobes lobes(scene, point);
    Sums sums;
    const Frame frame = Frame::from_z(point.normal);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < 2 * n; ++j) {
            const float theta = (static_cast<float>(i) + 0.5F) * kPi / static_cast<float>(n),
                        phi = (static_cast<float>(j) + 0.5F) * kPi / static_cast<float>(n);
            const Vec3f wi =
                frame.world_from_local({std::sin(theta) * std::cos(phi),
                                        std::sin(theta) * std::sin(phi), std::cos(theta)});
            const float solid_angle = std::sin(theta) * square(kPi / static_cast<float>(n));
            lobes.add(wi, radiance(wi) * solid_angle, sums);
        }
    return to_colors(sums);
}

LobeSums mirror_weights(const Scene& scene, const SeenPoint& point) {
    Sums sums;
    Lobes(scene, point).add_mirrors(sums);
    return to_colors(sums);
}

}  // namespace lightsieve::testing
