// fog: haze of one colour that lies on the ground and thins out upward. It is not lit: the colour is what one sees of it.
//
// Its density falls exponentially with the height, so what a ray meets on its way has a closed form (Quilez 2010, "Better
// fog"); the renderer gets it as an even medium of that much in all along the ray.
#include <cmath>

#include "bsdf/closure.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct Fog {
    float distance = 20, height = 5;
    Color color{1, 1, 1};
    Vec3f ground_point{0, 0, 0}, ground_normal{0, 0, 1};

    static NodeType describe() {
        Describe<Fog> d("fog", NodeKind::Shader,
                        "Haze of one colour that lies on the ground, for options.atmosphere.");
        d.fills_volumes();
        d.lobe(0, EventKind::Object, EventLobe::None, "", "What is seen of it.");
        d.param("distance", &Fog::distance,
                "Way on the ground after which 1/e of what lies behind is still seen.")
            .unit("scene units")
            .range(0, kInfinity);
        d.param("height", &Fog::height, "Height at which it is 1/e as dense as on the ground.")
            .unit("scene units")
            .range(0, kInfinity);
        d.param("color", &Fog::color, "Its colour.");
        d.param("ground_point", &Fog::ground_point, "A point of the ground, world space.");
        d.param("ground_normal", &Fog::ground_normal, "Away from the ground, world space.");
        return d.done();
    }

    /// In an atmosphere, ray_length is how far the ray goes.
    void eval(const ShadePoint& at, ClosureSet& out) const {
        const float density = mean_density(at);
        if (!(density > 0)) return;
        const Color extinction = Color::grey(density);
        out.add_haze(0, extinction, kBlack, Phase());
        out.emit(0, positive(color) * extinction);
    }

  private:
    /// Of the way from `at` along the ray [1/scene unit].
    [[nodiscard]] float mean_density(const ShadePoint& at) const {
        // Fog without extent is a wall or nothing; deep below the ground it is as dense as it gets.
        constexpr float kLeast = 1e-6F, kDeepest = 30;
        const Vec3f up = normalize(ground_normal, {0, 0, 1});
        const float scale = std::max(positive(height), kLeast);
        const auto depth = [&](Vec3f p) {
            return std::min(dot(ground_point - p, up) / scale, kDeepest);
        };
        const float from = depth(at.position),
                    to = depth(at.position + at.direction * at.ray_length);
        // The mean of exp(x) from one end of the way to the other.
        const float slope = to - from;
        const float mean =
            std::abs(slope) > kLeast ? std::exp(from) * std::expm1(slope) / slope : std::exp(from);
        return mean / std::max(positive(distance), kLeast);
    }
};

}  // namespace

NodeType node_fog() { return Fog::describe(); }

}  // namespace lightsieve
