// Every lobe model with random parameters, for the tests of lobe_test.cpp. Only for tests.
//
// A model without a case here fails the test LobeCases.CoverEveryModel, so a new one is tested the day it exists.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "bsdf/models.h"

namespace lightsieve {

/// Uniform numbers that are the same everywhere (std::uniform_real_distribution is not).
class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24F; }
    float between(float low, float high) { return lerp(low, high, unit()); }
    Vec2f pair() {
        const float x = unit();
        return {x, unit()};
    }
    Color color() {
        const float r = unit(), g = unit();
        return {r, g, unit()};
    }

  private:
    std::mt19937 engine_;
};

struct LobeCase {
    std::string name;
    /// A model with random parameters, rough enough (alpha >= 0.03) for statistics on a grid.
    std::function<LobeModel(Random&)> random;
    /// f(wo, wi) = f(wi, wo).
    bool reciprocal = false;
    /// Directional albedo is 1 in the channels of white parameters made by this, for every wo.
    std::function<LobeModel(Random&)> lossless{};
    /// How far albedo() may be from the integral of f.
    float albedo_tolerance = 3e-3F;
    /// Factor on that distance: refraction is only used below 1 - R, which hides its error where both are small.
    std::function<float(const LobeModel&, Vec3f)> layering = [](const LobeModel&, Vec3f) {
        return 1.0F;
    };
};

inline float below_reflection(const LobeModel& model, Vec3f wo) {
    const auto& refraction = std::get<DielectricTransmit>(model);
    return 1 - DielectricReflect(refraction.alpha, refraction.eta).albedo(wo).r;
}

inline GgxAlpha random_alpha(Random& random) { return GgxAlpha(square(random.between(0.18F, 1))); }

/// Refraction narrows the lobe by about eta - 1.
inline GgxAlpha random_refraction_alpha(Random& random) {
    return GgxAlpha(square(random.between(0.35F, 1)));
}

inline GgxAlpha random_stretched_alpha(Random& random) {
    const float roughness = random.between(0.25F, 1);
    return GgxAlpha::from_roughness(roughness, random.between(0, 0.7F));
}

[[nodiscard]] inline std::vector<LobeCase> all_lobe_cases() {
    std::vector<LobeCase> cases;
    cases.push_back({"lambert reflection", [](Random& r) { return DiffuseReflect(r.color()); },
                     true, [](Random&) { return DiffuseReflect(kWhite); }, 1e-5F});
    cases.push_back({"rough diffuse reflection",
                     [](Random& r) { return DiffuseReflect(r.color(), r.unit()); }, true,
                     [](Random& r) { return DiffuseReflect(kWhite, r.unit()); }});
    cases.push_back({"diffuse transmission",
                     [](Random& r) { return DiffuseTransmit(r.color(), r.unit()); }, false,
                     [](Random& r) { return DiffuseTransmit(kWhite, r.unit()); }});
    cases.push_back(
        {"dielectric reflection from outside",
         [](Random& r) { return DielectricReflect(random_alpha(r), r.between(1.05F, 3)); }, true});
    cases.push_back(
        {"dielectric reflection from inside",
         [](Random& r) { return DielectricReflect(random_alpha(r), 1 / r.between(1.05F, 3)); },
         false,
         {},
         1e-2F});
    cases.push_back({"stretched dielectric reflection",
                     [](Random& r) {
                         return DielectricReflect(random_stretched_alpha(r), r.between(1.05F, 3));
                     },
                     true,
                     {},
                     5e-2F});
    cases.push_back({"refraction into",
                     [](Random& r) {
                         return DielectricTransmit(random_refraction_alpha(r), r.between(1.2F, 3));
                     },
                     false,
                     {},
                     8e-3F,
                     below_reflection});
    cases.push_back({"refraction out of",
                     [](Random& r) {
                         return DielectricTransmit(random_refraction_alpha(r),
                                                   1 / r.between(1.2F, 3));
                     },
                     false,
                     {},
                     1.2e-2F,
                     below_reflection});
    cases.push_back({"stretched refraction",
                     [](Random& r) {
                         return DielectricTransmit(random_stretched_alpha(r), r.between(1.4F, 2));
                     },
                     false,
                     {},
                     0.2F,
                     below_reflection});
    cases.push_back({"thin transmission", [](Random& r) { return ThinTransmit(random_alpha(r)); },
                     false, [](Random& r) { return ThinTransmit(random_alpha(r)); }});
    cases.push_back({"metal",
                     [](Random& r) {
                         return ConductorReflect::from_artistic(random_alpha(r), r.color(),
                                                                r.color());
                     },
                     false,
                     [](Random& r) {
                         return ConductorReflect::from_artistic(random_alpha(r), kWhite, kWhite);
                     },
                     1.5e-2F});
    cases.push_back({"stretched metal",
                     [](Random& r) {
                         return ConductorReflect::from_artistic(random_stretched_alpha(r),
                                                                r.color(), r.color());
                     },
                     false,
                     {},
                     0.12F});
    cases.push_back(
        {"schlick",
         [](Random& r) {
             const GgxAlpha alpha = random_alpha(r);
             const Color facing = r.color();
             return SchlickReflect(alpha, facing, kWhite, r.color());
         },
         false, [](Random& r) { return SchlickReflect(random_alpha(r), kWhite, kWhite); }, 1e-2F});
    cases.push_back({"film on a metal",
                     [](Random& r) {
                         const GgxAlpha alpha = random_alpha(r);
                         const float thickness = r.between(0, 1000);
                         const Color n = r.color();
                         return FilmReflect(alpha, thickness, r.between(1.1F, 2.2F), n,
                                            r.color() * 4);
                     },
                     false,
                     {},
                     3e-2F});
    cases.push_back({"film on a schlick base",
                     [](Random& r) {
                         const GgxAlpha alpha = random_alpha(r);
                         const float thickness = r.between(0, 1000);
                         const Color facing = r.color();
                         return FilmedSchlickReflect(
                             thickness, r.between(1.1F, 2.2F),
                             SchlickReflect(alpha, facing, kWhite, r.color()));
                     },
                     false,
                     {},
                     3e-2F});
    cases.push_back({"burley diffuse reflection", [](Random& r) {
                         const Color color = r.color();
                         return BurleyReflect(color, r.unit());
                     }});
    cases.push_back({"oren-nayar reflection", [](Random& r) {
                         const Color color = r.color();
                         return OrenNayarReflect(color, r.unit());
                     }});
    cases.push_back({"sheen", [](Random& r) { return SheenReflect(r.between(0.1F, 1)); }, true});
    static constexpr std::array kPaths{HairPath::R, HairPath::TT, HairPath::TRT, HairPath::Rest};
    for (const HairPath path : kPaths)
        cases.push_back({"hair, path " + std::to_string(static_cast<int>(path)),
                         [path](Random& r) {
                             const HairWidth width = HairWidth::from_roughness(
                                 r.between(0.25F, 1), r.between(0.25F, 1));
                             const Color absorption = r.color();
                             return HairLobe(path, width.of(path), r.between(1.1F, 2), absorption,
                                             r.between(-0.2F, 0.2F), r.between(-1, 1));
                         },
                         false,
                         {},
                         1e-4F});
    cases.push_back({"phase function",
                     [](Random& r) {
                         const float first = r.between(-0.9F, 0.9F);
                         return PhaseLobe(Phase(first, r.between(-0.9F, 0.9F), r.unit()));
                     },
                     true, [](Random& r) { return PhaseLobe(Phase(r.between(-0.9F, 0.9F))); },
                     1e-4F});
    return cases;
}

// The four functions, whatever the model.
inline LobeEval eval(const LobeModel& m, Vec3f wo, Vec3f wi) {
    return std::visit([&](const auto& l) { return l.eval(wo, wi); }, m);
}
inline LobeSample sample(const LobeModel& m, Vec3f wo, Vec2f u, float u_choice) {
    return std::visit([&](const auto& l) { return l.sample(wo, u, u_choice); }, m);
}
inline Color albedo(const LobeModel& m, Vec3f wo) {
    return std::visit([&](const auto& l) { return l.albedo(wo); }, m);
}
inline bool delta(const LobeModel& m) {
    return std::visit([](const auto& l) { return l.delta(); }, m);
}

inline Vec3f direction(float cos_theta, float phi) {
    const float s = std::sqrt((1 - cos_theta) * (1 + cos_theta));
    return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

/// Albedo by a stratified integration of the lobe's own samples; n * n of them.
inline Color measured_albedo(const LobeModel& m, Vec3f wo, int n, Random& random) {
    double r = 0, g = 0, b = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const Vec2f jitter = random.pair(),
                        corner{static_cast<float>(i), static_cast<float>(j)};
            const LobeSample s =
                sample(m, wo, (corner + jitter) * (1 / static_cast<float>(n)), random.unit());
            if (!(s.pdf > 0)) continue;
            r += static_cast<double>(s.f.r / s.pdf), g += static_cast<double>(s.f.g / s.pdf),
                b += static_cast<double>(s.f.b / s.pdf);
        }
    }
    const double count = n * n;
    return {static_cast<float>(r / count), static_cast<float>(g / count),
            static_cast<float>(b / count)};
}

inline float largest_difference(Color a, Color b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

}  // namespace lightsieve
