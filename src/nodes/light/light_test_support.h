// A bench for lights: energy against counts and closed forms, densities against counts, both strategies against each other.
//
// Shared by the tests of nodes/light; each function fails the running test where a light breaks its contract.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/sobol.h"
#include "nodes/common/node_test_support.h"
#include "scene/light.h"

namespace lightsieve::light_test {

/// Surroundings of a light: a colour that may be a shader, and a mesh.
class LightContext final : public NodeContext {
  public:
    using Shader = std::function<Color(const ShadePoint&)>;

    [[nodiscard]] Diagnostics& diagnostics() override { return diagnostics_; }
    [[nodiscard]] SourceSpan where(Name param) const override {
        auto text = std::make_shared<const SourceText>(SourceText{"test.ass", param.str()});
        return {text, 0, text->text.size()};
    }
    [[nodiscard]] Name node_name() const override { return "tested"; }
    [[nodiscard]] ColorInput color_input(Name) override {
        if (!shader) return ColorInput(color);
        return {&shader, [](const void* program, const ShadePoint& at) {
                    return ShaderValue{(*static_cast<const Shader*>(program))(at), 1};
                }};
    }
    [[nodiscard]] bool is_linked(Name) const override { return static_cast<bool>(shader); }
    [[nodiscard]] TextureCache& textures() override {
        report_bug("no textures in this test", __FILE__, __LINE__, "");
    }
    [[nodiscard]] std::optional<std::string> find_asset(std::string_view) const override {
        return std::nullopt;
    }
    [[nodiscard]] bool ignore_missing_textures() const override { return false; }
    [[nodiscard]] Frame frame() const override { return {}; }
    [[nodiscard]] std::unique_ptr<ShapeGeometry> geometry_of(NodeRef,
                                                             Mat4f& world_from_object) override {
        world_from_object = mesh_matrix;
        return mesh ? std::make_unique<ShapeGeometry>(*mesh) : nullptr;
    }

    Color color = kWhite;
    Shader shader;
    std::optional<ShapeGeometry> mesh;
    Mat4f mesh_matrix;

  private:
    Diagnostics diagnostics_;
};

/// A light with what it was made from.
struct Bench {
    explicit Bench(NodeType type)
        : node(std::move(type)), context(std::make_unique<LightContext>()) {}
    Bench& make() {
        light = node.type().make_light(node.block(), *context);
        return *this;
    }
    Bench& matrix(const Mat4f& m) {
        node.set_array<Mat4f>("matrix", {m});
        return *this;
    }
    Bench& radius(float r) {
        node.set_array<float>("radius", {r});
        return *this;
    }
    TestNode node;
    std::unique_ptr<LightContext> context;
    std::unique_ptr<Light> light;
};

/// A rotation about an arbitrary axis with a shift.
inline Mat4f placed(Vec3f shift, Vec3f scale = {1, 1, 1}) {
    return Mat4f::scale(scale) *
           Mat4f::look_at(shift, shift + Vec3f{1, -2, 0.5F}, {0.3F, 1, 0.1F});
}

inline Vec2f sobol(std::uint32_t i, std::uint32_t pair = 0) {
    return Sampler(3, 5, i, 17).at2(pair);
}

/// Nearest point where a ray meets a light's geometry, by trying everything.
inline std::optional<LightHit> cast(const Light& light, Vec3f from, Vec3f wi) {
    const ShapeGeometry* geometry = light.geometry();
    if (geometry == nullptr) return std::nullopt;
    double best = std::numeric_limits<double>::infinity();
    LightHit out;
    if (const SphereList* spheres = std::get_if<SphereList>(&geometry->data)) {
        const Vec3f to = spheres->centers[0][0] - from;
        const double b = static_cast<double>(dot(to, wi)),
                     c = static_cast<double>(length_squared(to) - square(spheres->radii[0]));
        if (b * b < c || b < 0 || c < 0) return std::nullopt;
        best = b - std::sqrt(b * b - c);
        out.position = from + wi * static_cast<float>(best);
        out.normal = normalize(out.position - spheres->centers[0][0]);
    } else {
        const TriangleMesh& mesh = std::get<TriangleMesh>(geometry->data);
        for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
            const Vec3f a = mesh.positions[0][mesh.indices[3 * t]],
                        b = mesh.positions[0][mesh.indices[3 * t + 1]],
                        c = mesh.positions[0][mesh.indices[3 * t + 2]];
            // Source: Moeller and Trumbore 1997.
            const Vec3f ab = b - a, ac = c - a, p = cross(wi, ac), s = from - a, q = cross(s, ab);
            const double det = static_cast<double>(dot(ab, p));
            if (det == 0) continue;
            const double u = static_cast<double>(dot(s, p)) / det,
                         v = static_cast<double>(dot(wi, q)) / det,
                         distance = static_cast<double>(dot(ac, q)) / det;
            if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || distance >= best) continue;
            best = distance;
            out.position = from + wi * static_cast<float>(distance);
            out.normal = normalize(cross(ab, ac));
            out.primitive = static_cast<std::uint32_t>(t);
            const float bu = static_cast<float>(u), bv = static_cast<float>(v);
            if (!mesh.uvs.empty())
                out.uv = mesh.uvs[mesh.uv_indices[3 * t]] * (1 - bu - bv) +
                         mesh.uvs[mesh.uv_indices[3 * t + 1]] * bu +
                         mesh.uvs[mesh.uv_indices[3 * t + 2]] * bv;
        }
    }
    if (!std::isfinite(best)) return std::nullopt;
    out.distance = static_cast<float>(best);
    return out;
}

/// What a ray from `from` along `wi` finds of the light.
inline LightEval look(const Light& light, Vec3f from, Vec3f wi) {
    if (light.infinite()) return light.escape(from, wi);
    const std::optional<LightHit> hit = cast(light, from, wi);
    return hit ? light.hit(from, *hit) : LightEval{};
}

/// Irradiance by sampling.
inline Color sampled_irradiance(const Light& light, Vec3f from, Vec3f normal,
                                std::uint32_t n = 1U << 15U) {
    double r = 0, g = 0, b = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const LightSample s = light.sample(from, sobol(i));
        if (!(s.pdf > 0)) continue;
        const double weight = static_cast<double>(std::max(0.0F, dot(s.wi, normal)) / s.pdf);
        r += weight * static_cast<double>(s.radiance.r);
        g += weight * static_cast<double>(s.radiance.g);
        b += weight * static_cast<double>(s.radiance.b);
    }
    return {static_cast<float>(r / n), static_cast<float>(g / n), static_cast<float>(b / n)};
}

/// Irradiance that a polygon with radiance 1 gives to a plane that it lies above. Source: Lambert 1760, Photometria.
inline double polygon_irradiance(const std::vector<Vec3f>& corners, Vec3f from, Vec3f normal) {
    using Vec3d = std::array<double, 3>;
    const auto toward = [&](Vec3f p) {
        return Vec3d{double{p.x} - double{from.x}, double{p.y} - double{from.y},
                     double{p.z} - double{from.z}};
    };
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = toward(corners[i]), b = toward(corners[(i + 1) % corners.size()]);
        const Vec3d axis{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
        const double size = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        const double angle = std::atan2(size, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
        sum += angle *
               (axis[0] * double{normal.x} + axis[1] * double{normal.y} +
                axis[2] * double{normal.z}) /
               size;
    }
    return std::abs(sum) / 2;
}

struct Cone {
    Vec3f axis;
    double one_minus_cos;  ///< of the half angle
};

/// A cone around all directions that a light samples.
inline Cone cone_of_samples(const Light& light, Vec3f from) {
    Vec3f mean{};
    std::vector<Vec3f> directions;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const LightSample s = light.sample(from, sobol(i, 1));
        if (!(s.pdf > 0)) continue;
        directions.push_back(s.wi);
        mean += s.wi;
    }
    Cone out{normalize(mean), 0};
    for (const Vec3f d : directions)
        out.one_minus_cos =
            std::max(out.one_minus_cos, static_cast<double>(length_squared(d - out.axis)) / 2);
    out.one_minus_cos = std::min(2.0, out.one_minus_cos * 1.05);
    return out;
}

/// Counts sampled directions in bins of equal solid angle and compares with the integral of the density that rays
/// find there; and both totals. The false alarm rate of the chi-square bound (5 sigma) is below 1e-5 a light.
///
/// n_samples  fewer where the density has peaks that the quadrature cannot follow
inline void expect_directions_follow_density(const Light& light, Vec3f from,
                                             std::uint32_t n_samples = 20000) {
    constexpr std::size_t kZ = 12, kPhi = 12, kFine = 24;
    const Cone cone = cone_of_samples(light, from);
    ASSERT_GT(cone.one_minus_cos, 0);
    const Frame frame = Frame::from_z(cone.axis);

    std::vector<double> expected(kZ * kPhi);
    const double cell =
        2 * static_cast<double>(kPi) * cone.one_minus_cos / (kZ * kPhi * kFine * kFine);
    double total = 0;
    for (std::size_t z = 0; z < kZ * kFine; ++z)
        for (std::size_t p = 0; p < kPhi * kFine; ++p) {
            const double one_minus_z =
                (static_cast<double>(z) + 0.5) / (kZ * kFine) * cone.one_minus_cos;
            const double phi =
                (static_cast<double>(p) + 0.5) / (kPhi * kFine) * 2 * static_cast<double>(kPi);
            const double r = std::sqrt(one_minus_z * (2 - one_minus_z));
            const Vec3f local{static_cast<float>(r * std::cos(phi)),
                              static_cast<float>(r * std::sin(phi)),
                              static_cast<float>(1 - one_minus_z)};
            const double share =
                static_cast<double>(
                    look(light, from, normalize(frame.world_from_local(local))).pdf) *
                cell;
            expected[z / kFine * kPhi + p / kFine] += share * n_samples;
            total += share;
        }

    std::vector<double> counts(kZ * kPhi);
    double valid = 0;
    Sampler sampler(1, 2, 0, 99);
    for (std::uint32_t i = 0; i < n_samples; ++i) {
        const LightSample s =
            light.sample(from, {sampler.random(2 * i), sampler.random(2 * i + 1)});
        if (!(s.pdf > 0)) continue;
        valid += 1;
        const double one_minus_z = static_cast<double>(length_squared(s.wi - cone.axis)) / 2;
        const Vec3f local = frame.local_from_world(s.wi);
        double phi =
            static_cast<double>(std::atan2(local.y, local.x)) / (2 * static_cast<double>(kPi));
        if (phi < 0) phi += 1;
        const std::size_t z = static_cast<std::size_t>(one_minus_z / cone.one_minus_cos * kZ),
                          p = static_cast<std::size_t>(phi * kPhi);
        ASSERT_LE(z, kZ) << "outside the cone";
        counts[std::min(z, kZ - 1) * kPhi + std::min(p, kPhi - 1)] += 1;
    }
    EXPECT_NEAR(total, valid / n_samples, 2 / std::sqrt(n_samples));  // four standard deviations

    // Bins with few expected counts are one bin together.
    double chi2 = 0, few_expected = 0, few_counts = 0;
    int n_bins = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] < 20) {
            few_expected += expected[i];
            few_counts += counts[i];
            continue;
        }
        chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
        ++n_bins;
    }
    if (few_expected > 20) {
        chi2 += (few_counts - few_expected) * (few_counts - few_expected) / few_expected;
        ++n_bins;
    }
    EXPECT_GT(n_bins, 20);
    EXPECT_LT(chi2, n_bins + 5 * std::sqrt(2.0 * n_bins));
}

/// A ray along a sampled direction finds the radiance and the density of the sample.
///
/// dim  radiances that are small compared with that may be off by as much as it
inline void expect_strategies_agree(const Light& light, Vec3f from, float dim = 1e-3F) {
    constexpr std::uint32_t kSamples = 4000;
    std::uint32_t valid = 0, missed = 0;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const LightSample s = light.sample(from, sobol(i, 2));
        if (!(s.pdf > 0)) continue;
        ++valid;
        EXPECT_FALSE(s.delta);
        EXPECT_NEAR(length(s.wi), 1, 1e-5F);
        const LightEval e = look(light, from, s.wi);
        // Rounding at the rim.
        if (!(e.pdf > 0)) {
            ++missed;
            continue;
        }
        EXPECT_NEAR(e.pdf / s.pdf, 1, 2e-3F);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(e.radiance[c], s.radiance[c], 2e-3F * (dim + max_component(s.radiance)));
        if (light.infinite()) {
            EXPECT_EQ(s.distance, kInfinity);
        } else {
            EXPECT_NEAR(cast(light, from, s.wi)->distance / s.distance, 1, 1e-3F);
        }
    }
    EXPECT_GT(valid, kSamples / 4);
    EXPECT_LE(missed, kSamples / 200);
}

/// The bounds hold every sampled point and direction.
inline void expect_bounds_hold(const Light& light, Vec3f from) {
    const LightBounds bounds = light.bounds();
    const double reach =
        std::acos(std::clamp(static_cast<double>(bounds.cos_spread), -1.0, 1.0)) +
        (light.infinite() ? 0 : std::acos(static_cast<double>(bounds.cos_emission)));
    const Vec3f room = Vec3f{1, 1, 1} * (1e-4F * (1 + length(bounds.box.size())));
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const LightSample s = light.sample(from, sobol(i, 3));
        if (!(s.pdf > 0)) continue;
        EXPECT_LE(std::atan2(static_cast<double>(length(cross(bounds.axis, -s.wi))),
                             static_cast<double>(dot(bounds.axis, -s.wi))),
                  reach + 1e-3);
        if (light.infinite()) continue;
        const Vec3f on = from + s.wi * s.distance, low = on - (bounds.box.lower - room),
                    high = (bounds.box.upper + room) - on;
        EXPECT_TRUE(low.x >= 0 && low.y >= 0 && low.z >= 0 && high.x >= 0 && high.y >= 0 &&
                    high.z >= 0);
    }
}

inline void expect_sound(const Light& light, Vec3f from, float dim = 1e-3F) {
    expect_strategies_agree(light, from, dim);
    expect_directions_follow_density(light, from);
    expect_bounds_hold(light, from);
}

inline bool never_shines(const Light& light) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Vec2f u = sobol(i);
        const Vec3f from = Vec3f{u.x, u.y, sobol(i, 1).x} * 20 - Vec3f{10, 10, 10};
        const LightSample s = light.sample(from, sobol(i, 2));
        if (s.pdf != 0 || look(light, from, normalize(from)).pdf != 0) return false;
    }
    return light.bounds().intensity == 0;
}

inline void expect_near(Color actual, Color expected, float relative) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], expected[c],
                    relative * std::max(std::abs(expected[c]), 1e-3F * max_component(expected)))
            << "channel " << c;
}

}  // namespace lightsieve::light_test
