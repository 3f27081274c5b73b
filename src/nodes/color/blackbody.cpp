// blackbody: the colour of things that glow because they are hot.
#include "core/blackbody.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

/// Stefan and Boltzmann's constant over pi: radiance by the fourth power of the temperature [W/(m^2 sr K^4)].
constexpr float kRadiance = 5.670374419e-8F * kInvPi;

struct Blackbody {
    float temperature = 6500, intensity = 1;
    bool normalize = true;

    static NodeType describe() {
        Describe<Blackbody> d("blackbody", NodeKind::Shader,
                              "The colour of things that glow because they are hot.");
        d.param("temperature", &Blackbody::temperature, "How hot they are.")
            .unit("K")
            .range(0, 40000);
        d.param("intensity", &Blackbody::intensity,
                "Factor on the radiance; acts without normalize.");
        d.param("normalize", &Blackbody::normalize,
                "Only the colour, of luminance 1; off: with the radiance of that temperature.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        const Color color = positive(blackbody_color(temperature));
        if (normalize) return color;
        const float t = positive(temperature);
        return color * (positive(intensity) * kRadiance * square(square(t)));
    }
};

}  // namespace

NodeType node_blackbody() { return Blackbody::describe(); }

}  // namespace lightsieve
