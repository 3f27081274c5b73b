// noise: a cloudy pattern in space. Arnold's own function is private: the same range and parameters, other clouds.
#include "nodes/texture/coord_space.h"
#include "nodes/texture/perlin.h"

namespace lightsieve {
namespace {

enum class NoiseMode : std::int32_t { Scalar, Vector };

struct Noise : SolidPlace {
    std::int32_t octaves = 1;
    float distortion = 0, lacunarity = 1.92F, amplitude = 1;
    Vec3f scale{1, 1, 1}, offset;
    float time = 0;
    Color color1{0, 0, 0}, color2{1, 1, 1};
    NoiseMode mode = NoiseMode::Scalar;

    static NodeType describe();
    [[nodiscard]] Color eval(const ShadePoint& at) const;
};

NodeType Noise::describe() {
    Describe<Noise> d("noise", NodeKind::Shader, "A cloudy pattern in space.");
    d.param("octaves", &Noise::octaves, "How many patterns of finer and finer grain.").range(1, 8);
    d.param("distortion", &Noise::distortion, "How far another noise moves the point.");
    d.param("lacunarity", &Noise::lacunarity, "How much finer each octave is than the last.");
    d.param("amplitude", &Noise::amplitude, "Strength; 0: the middle of both colours.");
    describe_solid_place(d);
    d.param("scale", &Noise::scale, "Frequency along each axis.");
    d.param("offset", &Noise::offset, "Moves the pattern.");
    d.param("time", &Noise::time, "The pattern changes smoothly with it.");
    d.param("color1", &Noise::color1, "Colour of low values.");
    d.param("color2", &Noise::color2, "Colour of high values.");
    d.param("mode", &Noise::mode, "One noise between both colours, or one a channel.")
        .names({"scalar", "vector"});
    return d.done();
}

Color Noise::eval(const ShadePoint& at) const {
    const Vec3f at_rest = place(at);
    Vec3f p{at_rest.x * scale.x + offset.x, at_rest.y * scale.y + offset.y,
            at_rest.z * scale.z + offset.z};
    if (distortion != 0) {
        const auto moved = [&](float shift) { return perlin_noise(p + Vec3f{shift, 0, 0}, time); };
        p = p + Vec3f{moved(13.5F), moved(47.1F), moved(83.9F)} * distortion;
    }
    const auto value = [&](float shift) {
        return 0.5F +
               0.5F * amplitude * fractal_noise(p + Vec3f{0, shift, 0}, octaves, lacunarity, time);
    };
    if (mode == NoiseMode::Vector) return {value(0), value(29.7F), value(61.3F)};
    return lerp(color1, color2, value(0));
}

}  // namespace

NodeType node_noise() { return Noise::describe(); }

}  // namespace lightsieve
