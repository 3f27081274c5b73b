// thin_film: the colour of a thin film by the angle under which it is seen, for specular colours of the old `standard`.
#include "bsdf/thin_film.h"
#include "nodes/shader/shader_common.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

struct ThinFilmColor {
    float thickness_min = 250, thickness_max = 400, thickness = 0.5F;
    float ior_medium = 1, ior_film = 1.5F, ior_internal = 1;

    static NodeType describe() {
        Describe<ThinFilmColor> d("thin_film", NodeKind::Shader,
                                  "Reflectance of a film as thin as the wavelengths of light, "
                                  "under the angle at which it is seen.");
        d.param("thickness_min", &ThinFilmColor::thickness_min, "Thickness for 0.").unit("nm");
        d.param("thickness_max", &ThinFilmColor::thickness_max, "Thickness for 1.").unit("nm");
        d.param("thickness", &ThinFilmColor::thickness, "Between both.").range(0, 1);
        d.param("ior_medium", &ThinFilmColor::ior_medium,
                "Index of refraction of what surrounds the film.");
        d.param("ior_film", &ThinFilmColor::ior_film, "Of the film.");
        d.param("ior_internal", &ThinFilmColor::ior_internal, "Of what lies below the film.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const {
        constexpr float kThickest = 1e5F, kLeastIor = 1, kMostIor = 4;
        const float outside = std::clamp(positive(ior_medium), kLeastIor, kMostIor);
        ThinFilm film;
        // Waves are shorter in a medium: the film counts for as much more.
        film.thickness = std::clamp(
            positive(std::lerp(thickness_min, thickness_max, unit(thickness)) * outside), 0.0F,
            kThickest);
        // Films that are thinner than what surrounds them, as air in glass, are taken as none.
        film.ior = std::clamp(positive(ior_film) / outside, kLeastIor, kMostIor);
        film.n = Color::grey(std::clamp(positive(ior_internal), kLeastIor, kMostIor) / outside);
        film.k = kBlack;
        return film.reflectance(unit(std::abs(dot(at.normal, at.wo))));
    }
};

}  // namespace

NodeType node_thin_film() { return ThinFilmColor::describe(); }

}  // namespace lightsieve
