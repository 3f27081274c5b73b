// What holds for every lobe model: sampling follows its density, functions agree, energy is conserved.
//
// The models come from lobe_cases.h. Statistics use fixed seeds; the chi-square test rejects a correct lobe with
// probability kFalseAlarm over all cases together (Sidak), so with the seeds fixed it fails only when code changes.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "bsdf/albedo_table.h"
#include "bsdf/fresnel.h"
#include "bsdf/lobe_cases.h"

namespace lightsieve {
namespace {

constexpr int kParameterSets = 20;

/// Calls body(case, model, wo, random) for random parameters and directions.
template <class Body>
void for_each_lobe(const Body& body) {
    std::uint32_t seed = 100;
    for (const LobeCase& lobe : all_lobe_cases()) {
        Random random(++seed);
        for (int i = 0; i < kParameterSets; ++i) {
            const LobeModel model = lobe.random(random);
            const Vec3f wo = direction(random.between(0.05F, 1), random.between(0, 2 * kPi));
            SCOPED_TRACE(lobe.name + ", set " + std::to_string(i));
            body(lobe, model, wo, random);
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

TEST(LobeCases, CoverEveryModel) {
    std::set<std::size_t> kinds;
    Random random(1);
    for (const LobeCase& lobe : all_lobe_cases())
        kinds.insert(lobe.random(random).index());
    EXPECT_EQ(kinds.size(), std::variant_size_v<LobeModel>);
}

// Sampling against density ------------------------------------------------------------------------------------------

constexpr int kCosCells = 20, kPhiCells = 40, kDraws = 100000;
constexpr int kMaxSplits = 8;
constexpr double kFalseAlarm = 0.01;
/// Share of the draws that may lie where the integration finds no density: slivers at the edge of a lobe's support.
constexpr double kEdgeError = 5e-3;
/// Cells that expect fewer draws are joined, or the statistic would not be chi-square.
constexpr double kMinExpected = 5;

/// Integral of the density over a cell of (cos theta, phi): 3 x 3 Gauss points, halved until that changes nothing.
double integrate_pdf(const LobeModel& model, Vec3f wo, float z0, float z1, float phi0, float phi1,
                     int depth, double parent) {
    static constexpr std::array<float, 3> kPoint{-0.77459667F, 0, 0.77459667F},
        kWeight{5.0F / 18, 8.0F / 18, 5.0F / 18};
    const auto gauss = [&](float za, float zb, float pa, float pb) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec3f wi = direction(lerp(za, zb, 0.5F + 0.5F * kPoint[i]),
                                           lerp(pa, pb, 0.5F + 0.5F * kPoint[j]));
                sum += static_cast<double>(kWeight[i] * kWeight[j] * eval(model, wo, wi).pdf);
            }
        return sum * static_cast<double>((zb - za) * (pb - pa));
    };
    const float zm = 0.5F * (z0 + z1), phim = 0.5F * (phi0 + phi1);
    const std::array<double, 4> part{gauss(z0, zm, phi0, phim), gauss(zm, z1, phi0, phim),
                                     gauss(z0, zm, phim, phi1), gauss(zm, z1, phim, phi1)};
    const double sum = part[0] + part[1] + part[2] + part[3];
    // 1e-6 is a tenth of a draw.
    if (depth == 0 || std::abs(sum - parent) < 1e-6) return sum;
    return integrate_pdf(model, wo, z0, zm, phi0, phim, depth - 1, part[0]) +
           integrate_pdf(model, wo, zm, z1, phi0, phim, depth - 1, part[1]) +
           integrate_pdf(model, wo, z0, zm, phim, phi1, depth - 1, part[2]) +
           integrate_pdf(model, wo, zm, z1, phim, phi1, depth - 1, part[3]);
}

/// Upper tail of the chi-square distribution; Wilson and Hilferty 1931, good to a few per cent of the tail here.
double chi_square_tail(double statistic, int freedom) {
    const double k = 2 / (9.0 * freedom),
                 z = (std::cbrt(statistic / freedom) - (1 - k)) / std::sqrt(k);
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

std::size_t cell_of(Vec3f wi) {
    float phi = std::atan2(wi.y, wi.x);
    if (phi < 0) phi += 2 * kPi;
    const int row = std::clamp(static_cast<int>((wi.z + 1) * 0.5F * kCosCells), 0, kCosCells - 1);
    const int column = std::clamp(static_cast<int>(phi / (2 * kPi) * kPhiCells), 0, kPhiCells - 1);
    return static_cast<std::size_t>(row * kPhiCells + column);
}

TEST(Lobe, SamplesFollowTheDensity) {
    const double tests = static_cast<double>(all_lobe_cases().size()) * kParameterSets;
    const double threshold = 1 - std::pow(1 - kFalseAlarm, 1 / tests);
    for_each_lobe([&](const LobeCase&, const LobeModel& model, Vec3f wo, Random& random) {
        std::vector<double> expected(kCosCells * kPhiCells), observed(expected.size());
        double total = 0, failed = 0;
        for (int row = 0; row < kCosCells; ++row)
            for (int column = 0; column < kPhiCells; ++column) {
                const auto z = [](int i) { return -1 + 2 * static_cast<float>(i) / kCosCells; };
                const auto phi = [](int i) { return 2 * kPi * static_cast<float>(i) / kPhiCells; };
                const double p = integrate_pdf(model, wo, z(row), z(row + 1), phi(column),
                                               phi(column + 1), kMaxSplits, -1);
                expected[static_cast<std::size_t>(row * kPhiCells + column)] = p * kDraws;
                total += p;
            }
        for (int i = 0; i < kDraws; ++i) {
            const LobeSample s = sample(model, wo, random.pair(), random.unit());
            if (s.pdf > 0)
                observed[cell_of(s.wi)] += 1;
            else
                failed += 1;
        }
        // The edge of a lobe's support is hard to integrate: not exact enough for a cell of its own.
        EXPECT_LT(total, 1 + kEdgeError);
        EXPECT_NEAR(failed / kDraws, 1 - total, kEdgeError);

        double statistic = 0, few_expected = 0, few_observed = 0;
        int cells = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (expected[i] < kMinExpected) {
                few_expected += expected[i], few_observed += observed[i];
                continue;
            }
            statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
            ++cells;
        }
        if (few_expected >= kMinExpected) {
            statistic +=
                (few_observed - few_expected) * (few_observed - few_expected) / few_expected;
            ++cells;
        } else {
            EXPECT_LT(few_observed / kDraws, kEdgeError);
        }
        EXPECT_GT(chi_square_tail(statistic, cells - 1), threshold)
            << "statistic " << statistic << " of " << cells << " cells";
    });
}

// The functions of one model against one another ----------------------------------------------------------------------

TEST(Lobe, SampleReturnsWhatEvalReturns) {
    for_each_lobe([](const LobeCase&, const LobeModel& model, Vec3f wo, Random& random) {
        for (int i = 0; i < 500; ++i) {
            const LobeSample s = sample(model, wo, random.pair(), random.unit());
            if (!(s.pdf > 0)) continue;
            const LobeEval e = eval(model, wo, s.wi);
            // The microfacet is found again from the directions, so peaks are a little uncertain.
            EXPECT_NEAR(length(s.wi), 1, 1e-5F);
            EXPECT_NEAR(e.pdf / s.pdf, 1, 5e-3F);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e.f[c], s.f[c], 5e-3F * s.f[c] + 1e-6F);
        }
    });
}

TEST(Lobe, DirectionsThatAreLongByRoundingAreFine) {
    const Vec3f pole{0, 0, 1 + 0x1p-22F};
    for_each_lobe([&](const LobeCase&, const LobeModel& model, Vec3f wo, Random&) {
        for (const auto& [from, to] :
             {std::pair{wo, pole}, {pole, wo}, {pole, pole}, {pole, -pole}}) {
            const LobeEval e = eval(model, from, to);
            ASSERT_TRUE(is_finite(e.f) && std::isfinite(e.pdf));
        }
    });
}

TEST(Lobe, AlbedoIsTheIntegral) {
    for_each_lobe([](const LobeCase& lobe, const LobeModel& model, Vec3f wo, Random& random) {
        const float difference =
            largest_difference(albedo(model, wo), measured_albedo(model, wo, 100, random));
        EXPECT_LT(difference * lobe.layering(model, wo), lobe.albedo_tolerance);
    });
}

TEST(Lobe, NoEnergyFromNothing) {
    for_each_lobe([](const LobeCase& lobe, const LobeModel& model, Vec3f wo, Random& random) {
        EXPECT_LE(max_component(albedo(model, wo)), 1);
        const float gained = max_component(measured_albedo(model, wo, 60, random)) - 1;
        EXPECT_LT(gained * lobe.layering(model, wo), 2e-2F);
    });
}

TEST(Lobe, LosslessModelsReturnEverything) {
    for (const LobeCase& lobe : all_lobe_cases()) {
        if (!lobe.lossless) continue;
        Random random(5);
        for (int i = 0; i < kParameterSets; ++i) {
            const LobeModel model = lobe.lossless(random);
            const Vec3f wo = direction(random.between(0.05F, 1), 0);
            EXPECT_NEAR(measured_albedo(model, wo, 100, random).r, 1, 5e-3F) << lobe.name;
            EXPECT_NEAR(albedo(model, wo).r, 1, 5e-3F) << lobe.name;
        }
    }
}

TEST(Lobe, Reciprocal) {
    for_each_lobe([](const LobeCase& lobe, const LobeModel& model, Vec3f wo, Random& random) {
        if (!lobe.reciprocal) return;
        for (int i = 0; i < 100; ++i) {
            const Vec3f wi = direction(random.between(0.02F, 1), random.between(0, 2 * kPi));
            // Values of lobes of surfaces contain a cosine.
            const bool surface = !has_no_sides(model);
            const Color there = eval(model, wo, wi).f * (surface ? 1 / wi.z : 1),
                        back = eval(model, wi, wo).f * (surface ? 1 / wo.z : 1);
            EXPECT_LT(largest_difference(there, back), 1e-4F * max_component(there) + 1e-6F);
        }
    });
}

// Edges ---------------------------------------------------------------------------------------------------------------

bool sane(const LobeEval& e) {
    return is_finite(e.f) && std::isfinite(e.pdf) && e.pdf >= 0 && e.f.r >= 0 && e.f.g >= 0 &&
           e.f.b >= 0;
}

/// Every function with directions down to the horizon and random numbers at their ends.
void expect_sane(const LobeModel& model) {
    Random random(9);
    for (const float cos_o : {1e-5F, 1e-3F, 0.1F, 0.745356F, 1.0F}) {
        const Vec3f wo = direction(cos_o, 0.3F);
        const Color a = albedo(model, wo);
        ASSERT_TRUE(is_finite(a) && max_component(a) <= 1 + 1e-6F &&
                    std::min({a.r, a.g, a.b}) >= 0)
            << cos_o;
        for (const float cos_i : {1.0F, 0.5F, 1e-3F, 1e-6F, 0.0F, -1e-6F, -1e-3F, -0.5F, -1.0F})
            for (const float phi : {0.3F, 1.0F, 0.3F + kPi})
                ASSERT_TRUE(sane(eval(model, wo, direction(cos_i, phi)))) << cos_o << " " << cos_i;
        for (const float x : {0.0F, 0.5F, 0x1.fffffep-1F})
            for (const float y : {0.0F, 0.5F, 0x1.fffffep-1F}) {
                const LobeSample s = sample(model, wo, {x, y}, random.unit());
                ASSERT_TRUE(sane({s.f, s.pdf})) << cos_o << " " << x << " " << y;
                ASSERT_TRUE(s.pdf == 0 || std::abs(length(s.wi) - 1) < 1e-4F);
            }
    }
}

TEST(Lobe, EdgesOfParametersAreSane) {
    const float nan = std::nanf("");
    for (const float a : {-1.0F, 0.0F, 0.5e-3F, kSmoothAlpha, 0.03F, 1.0F, 5.0F, nan, kInfinity}) {
        SCOPED_TRACE(a);
        const GgxAlpha alpha(a), stretched(a, 0);
        for (const float eta : {-1.0F, 0.0F, 0.25F, 0.667F, 0.999F, 1.0F, 1.0001F, 1.5F, 4.0F,
                                100.0F, nan, kInfinity}) {
            SCOPED_TRACE(eta);
            expect_sane(DielectricReflect(alpha, eta));
            expect_sane(DielectricReflect(stretched, eta));
            expect_sane(DielectricTransmit(alpha, eta));
            expect_sane(DielectricTransmit(stretched, eta));
        }
        for (const float r : {-1.0F, 0.0F, 0.5F, 1.0F, 2.0F, nan}) {
            SCOPED_TRACE(r);
            for (const float g : {0.0F, 1.0F, nan})
                expect_sane(
                    ConductorReflect::from_artistic(alpha, Color::grey(r), Color::grey(g)));
            expect_sane(ConductorReflect(alpha, Color::grey(r), Color::grey(a)));
            expect_sane(SchlickReflect(alpha, Color::grey(r), kWhite, Color::grey(a)));
        }
        expect_sane(ThinTransmit(alpha));
        expect_sane(ThinTransmit(stretched));
        for (const float thickness : {0.0F, 300.0F, a})
            expect_sane(FilmReflect(alpha, thickness, a, Color::grey(a), Color(1, a, 0)));
        expect_sane(SheenReflect(a));
        for (const float h : {-2.0F, -1.0F, 0.0F, 0.9F, nan})
            for (const HairPath path : {HairPath::R, HairPath::TT, HairPath::TRT, HairPath::Rest})
                for (const float ior : {0.0F, 1.0F, 1.55F, 100.0F, nan}) {
                    expect_sane(HairLobe(path, HairWidth::from_roughness(a, a), ior,
                                         Color::grey(a), a, h));
                    expect_sane(HairLobe(path, {a, a}, ior, Color::grey(nan), 0.1F, h));
                }
        expect_sane(FilmedSchlickReflect(
            a, a, SchlickReflect(alpha, Color::grey(a), kWhite, Color(1, a, 0))));
        expect_sane(BurleyReflect(kWhite, a));
        expect_sane(BurleyReflect(Color(nan, -1, 1), 0.5F));
        expect_sane(DiffuseReflect(kWhite, a));
        expect_sane(DiffuseTransmit(Color(nan, -1, 1), a));
    }
}

template <class... Models>
void expect_defaults_sane(const std::variant<Models...>&) {
    (expect_sane(Models{}), ...);
}

TEST(Lobe, DefaultsAreSane) { expect_defaults_sane(LobeModel{}); }

TEST(Lobe, EachStaysOnItsSide) {
    for_each_lobe([](const LobeCase&, const LobeModel& model, Vec3f wo, Random& random) {
        if (has_no_sides(model)) return;
        const bool transmits = std::holds_alternative<DielectricTransmit>(model) ||
                               std::holds_alternative<DiffuseTransmit>(model) ||
                               std::holds_alternative<ThinTransmit>(model);
        const Vec3f wrong = direction(transmits ? random.between(0, 1) : random.between(-1, 0),
                                      random.between(0, 6));
        EXPECT_EQ(eval(model, wo, wrong).f, kBlack);
        EXPECT_EQ(eval(model, wo, wrong).pdf, 0);
    });
}

// Particular models ---------------------------------------------------------------------------------------------------

TEST(Lobe, RoughnessZeroIsExactlyLambert) {
    const Vec3f wo = direction(0.3F, 1), wi = direction(0.7F, 2);
    EXPECT_EQ(eval(DiffuseReflect(Color(0.2F, 0.5F, 1), 0), wo, wi).f,
              Color(0.2F, 0.5F, 1) * (kInvPi * wi.z));
    EXPECT_LT(largest_difference(eval(DiffuseReflect(Color::grey(0.5F), 1e-4F), wo, wi).f,
                                 Color::grey(0.5F * kInvPi * wi.z)),
              1e-4F);
}

TEST(Lobe, SmoothGlassIsLossless) {
    for (const float ior : {1.0F, 1.2F, 1.5F, 2.4F})
        for (const float eta : {ior, 1 / ior})
            for (const float c : {0.01F, 0.3F, 0.6F, 0.75F, 0.9F, 1.0F}) {
                // What standard_surface does with specular 1 and transmission 1, both white.
                const Vec3f wo = direction(c, 0.5F);
                const DielectricReflect reflect(GgxAlpha(0), eta);
                const DielectricTransmit transmit(GgxAlpha(0), eta);
                const float left = 1 - reflect.albedo(wo).r;
                EXPECT_NEAR(reflect.sample(wo, {}, 0).f.r + left * transmit.sample(wo, {}, 0).f.r,
                            1, 1e-6F)
                    << ior << " " << c;
                EXPECT_EQ(reflect.sample(wo, {}, 0).f.r, fresnel_dielectric(c, eta).reflectance);
            }
}

TEST(Lobe, RoughGlassIsNearlyLossless) {
    Random random(3);
    for (const float ior : {1.2F, 1.5F, 2.4F})
        for (const bool inside : {false, true})
            for (const float alpha : {0.01F, 0.09F, 0.3F, 0.8F})
                for (const float c : {0.2F, 0.5F, 0.745F, 0.9F, 1.0F}) {
                    const Vec3f wo = direction(c, 0.5F);
                    const float eta = inside ? 1 / ior : ior;
                    const DielectricReflect reflect(GgxAlpha(alpha), eta);
                    const DielectricTransmit transmit(GgxAlpha(alpha), eta);
                    const float left = 1 - reflect.albedo(wo).r;
                    const float total = measured_albedo(reflect, wo, 80, random).r +
                                        left * measured_albedo(transmit, wo, 80, random).r;
                    EXPECT_NEAR(total, 1, 1.5e-2F) << eta << " " << alpha << " " << c;
                }
}

TEST(Lobe, RefractionBendsBySnell) {
    const Vec3f wo = direction(0.5F, 1);
    const LobeSample s = DielectricTransmit(GgxAlpha(0), 1.5F).sample(wo, {}, 0);
    EXPECT_NEAR(std::hypot(s.wi.x, s.wi.y) * 1.5F, std::hypot(wo.x, wo.y), 1e-6F);
    EXPECT_LT(s.wi.z, 0);
    EXPECT_LT(dot(s.wi, {wo.x, wo.y, 0}), 0);
    // Past the critical angle nothing gets through.
    const LobeSample total = DielectricTransmit(GgxAlpha(0), 1 / 1.5F).sample(wo, {}, 0);
    EXPECT_EQ(total.pdf, 0);
    EXPECT_EQ(DielectricTransmit(GgxAlpha(0), 1 / 1.5F).albedo(wo), kBlack);
}

TEST(Lobe, MatchedIndicesGoStraightOn) {
    const Vec3f wo = direction(0.4F, 1);
    const DielectricTransmit matched(GgxAlpha(0.3F), 1);
    EXPECT_TRUE(matched.delta());
    EXPECT_LT(length(matched.sample(wo, {0.3F, 0.7F}, 0).wi + wo), 1e-6F);
    EXPECT_EQ(DielectricReflect(GgxAlpha(0.3F), 1).albedo(wo), kBlack);
}

TEST(Lobe, ThinTransmissionIsStraightWhenSmooth) {
    const Vec3f wo = direction(0.4F, 1);
    const LobeSample s = ThinTransmit(GgxAlpha(0)).sample(wo, {}, 0);
    EXPECT_EQ(s.wi, -wo);
    EXPECT_EQ(s.f, kWhite);
    EXPECT_EQ(s.pdf, 1);
}

TEST(Lobe, SheetsTurnLightTwice) {
    // Two facets of independent lean, each turning by (ior - 1) times its slope: how often the sum is small.
    constexpr float kAlpha = 0.01F, kIor = 1.6F, kNear = 0.2F * kAlpha;
    constexpr int kTurns = 400'000;
    Random random(11);
    const auto slope = [&] {
        const float u = random.unit(), phi = 2 * kPi * random.unit();
        const float length = kAlpha * std::sqrt(u / (1 - u));
        return Vec2f{length * std::cos(phi), length * std::sin(phi)};
    };
    int n_near = 0;
    for (int i = 0; i < kTurns; ++i) {
        const Vec2f a = slope(), b = slope();
        n_near += (kIor - 1) * std::hypot(a.x + b.x, a.y + b.y) < kNear;
    }
    // A lobe of width w that mirrors turns by 2 w sqrt(u / (1 - u)).
    const float width = ThinTransmit::through_sheet(GgxAlpha(kAlpha), kIor).alpha.x;
    const float expected = square(kNear) / (square(kNear) + square(2 * width));
    EXPECT_NEAR(static_cast<float>(n_near) / kTurns, expected, 0.03F * expected);
}

TEST(Lobe, SmoothLobesAreDeltas) {
    EXPECT_TRUE(delta(DielectricReflect(GgxAlpha::from_roughness(0), 1.5F)));
    EXPECT_FALSE(delta(DielectricReflect(GgxAlpha::from_roughness(0.1F), 1.5F)));
    const ConductorReflect mirror =
        ConductorReflect::from_artistic(GgxAlpha(0), Color(0.9F, 0.5F, 0.1F), kWhite);
    const Vec3f wo = direction(1, 0);
    EXPECT_TRUE(mirror.delta());
    EXPECT_LT(largest_difference(mirror.sample(wo, {}, 0).f, Color(0.9F, 0.5F, 0.1F)), 1e-4F);
    EXPECT_EQ(mirror.eval(wo, wo).f, kBlack);
}

TEST(Ggx, AnisotropyKeepsTheArea) {
    const GgxAlpha alpha = GgxAlpha::from_roughness(0.5F, 0.75F);
    EXPECT_NEAR(alpha.x, 0.5F, 1e-6F);
    EXPECT_NEAR(alpha.y, 0.125F, 1e-6F);
    EXPECT_EQ(GgxAlpha::from_roughness(1, 1).x, 1);
}

TEST(Ggx, CosSin) {
    for (int i = 0; i <= 1000; ++i) {
        const float u = static_cast<float>(i) / 1000;
        const Vec2f v = cos_sin_2pi(u);
        EXPECT_NEAR(static_cast<double>(v.x),
                    std::cos(2 * 3.14159265358979 * static_cast<double>(u)), 2e-6);
        EXPECT_NEAR(static_cast<double>(v.y),
                    std::sin(2 * 3.14159265358979 * static_cast<double>(u)), 2e-6);
    }
}

}  // namespace
}  // namespace lightsieve
