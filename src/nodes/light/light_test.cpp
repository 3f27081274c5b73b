// Every light on one bench: energy against closed forms, densities against counts, both strategies against each other.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/sobol.h"
#include "nodes/common/node_test_support.h"
#include "scene/light.h"

namespace lightsieve {

NodeType node_cylinder_light();
NodeType node_disk_light();
NodeType node_distant_light();
NodeType node_mesh_light();
NodeType node_point_light();
NodeType node_quad_light();
NodeType node_skydome_light();
NodeType node_spot_light();

namespace {

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
        return {&shader, [](const void* program, const ShadePoint& at) { return ShaderValue{(*static_cast<const Shader*>(program))(at), 1}; }};
    }
    [[nodiscard]] bool is_linked(Name) const override { return static_cast<bool>(shader); }
    [[nodiscard]] TextureCache& textures() override { report_bug("no textures in this test", __FILE__, __LINE__, ""); }
    [[nodiscard]] std::optional<std::string> find_asset(std::string_view) const override { return std::nullopt; }
    [[nodiscard]] bool ignore_missing_textures() const override { return false; }
    [[nodiscard]] Frame frame() const override { return {}; }
    [[nodiscard]] std::unique_ptr<ShapeGeometry> geometry_of(NodeRef, Mat4f& world_from_object) override {
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
    explicit Bench(NodeType type) : node(std::move(type)), context(std::make_unique<LightContext>()) {}
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
Mat4f placed(Vec3f shift, Vec3f scale = {1, 1, 1}) {
    return Mat4f::scale(scale) * Mat4f::look_at(shift, shift + Vec3f{1, -2, 0.5F}, {0.3F, 1, 0.1F});
}

Vec2f sobol(std::uint32_t i, std::uint32_t pair = 0) { return Sampler(3, 5, i, 17).at2(pair); }

/// Nearest point where a ray meets a light's geometry, by trying everything.
std::optional<LightHit> cast(const Light& light, Vec3f from, Vec3f wi) {
    const ShapeGeometry* geometry = light.geometry();
    if (geometry == nullptr) return std::nullopt;
    double best = std::numeric_limits<double>::infinity();
    LightHit out;
    if (const SphereList* spheres = std::get_if<SphereList>(&geometry->data)) {
        const Vec3f to = spheres->centers[0][0] - from;
        const double b = static_cast<double>(dot(to, wi)), c = static_cast<double>(length_squared(to) - square(spheres->radii[0]));
        if (b * b < c || b < 0 || c < 0) return std::nullopt;
        best = b - std::sqrt(b * b - c);
        out.position = from + wi * static_cast<float>(best);
        out.normal = normalize(out.position - spheres->centers[0][0]);
    } else {
        const TriangleMesh& mesh = std::get<TriangleMesh>(geometry->data);
        for (std::size_t t = 0; 3 * t < mesh.indices.size(); ++t) {
            const Vec3f a = mesh.positions[0][mesh.indices[3 * t]], b = mesh.positions[0][mesh.indices[3 * t + 1]], c = mesh.positions[0][mesh.indices[3 * t + 2]];
            // Source: Moeller and Trumbore 1997.
            const Vec3f ab = b - a, ac = c - a, p = cross(wi, ac), s = from - a, q = cross(s, ab);
            const double det = static_cast<double>(dot(ab, p));
            if (det == 0) continue;
            const double u = static_cast<double>(dot(s, p)) / det, v = static_cast<double>(dot(wi, q)) / det, distance = static_cast<double>(dot(ac, q)) / det;
            if (u < 0 || v < 0 || u + v > 1 || distance <= 0 || distance >= best) continue;
            best = distance;
            out.position = from + wi * static_cast<float>(distance);
            out.normal = normalize(cross(ab, ac));
            out.primitive = static_cast<std::uint32_t>(t);
            const float bu = static_cast<float>(u), bv = static_cast<float>(v);
            if (!mesh.uvs.empty())
                out.uv = mesh.uvs[mesh.uv_indices[3 * t]] * (1 - bu - bv) + mesh.uvs[mesh.uv_indices[3 * t + 1]] * bu + mesh.uvs[mesh.uv_indices[3 * t + 2]] * bv;
        }
    }
    if (!std::isfinite(best)) return std::nullopt;
    out.distance = static_cast<float>(best);
    return out;
}

/// What a ray from `from` along `wi` finds of the light.
LightEval look(const Light& light, Vec3f from, Vec3f wi) {
    if (light.infinite()) return light.escape(wi);
    const std::optional<LightHit> hit = cast(light, from, wi);
    return hit ? light.hit(from, *hit) : LightEval{};
}

/// Irradiance by sampling.
Color sampled_irradiance(const Light& light, Vec3f from, Vec3f normal, std::uint32_t n = 1U << 15U) {
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
double polygon_irradiance(const std::vector<Vec3f>& corners, Vec3f from, Vec3f normal) {
    using Vec3d = std::array<double, 3>;
    const auto toward = [&](Vec3f p) { return Vec3d{double{p.x} - double{from.x}, double{p.y} - double{from.y}, double{p.z} - double{from.z}}; };
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3d a = toward(corners[i]), b = toward(corners[(i + 1) % corners.size()]);
        const Vec3d axis{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const double size = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        const double angle = std::atan2(size, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
        sum += angle * (axis[0] * double{normal.x} + axis[1] * double{normal.y} + axis[2] * double{normal.z}) / size;
    }
    return std::abs(sum) / 2;
}

struct Cone {
    Vec3f axis;
    double one_minus_cos;  ///< of the half angle
};

/// A cone around all directions that a light samples.
Cone cone_of_samples(const Light& light, Vec3f from) {
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
        out.one_minus_cos = std::max(out.one_minus_cos, static_cast<double>(length_squared(d - out.axis)) / 2);
    out.one_minus_cos = std::min(2.0, out.one_minus_cos * 1.05);
    return out;
}

/// Counts sampled directions in bins of equal solid angle and compares with the integral of the density that rays
/// find there; and both totals. The false alarm rate of the chi-square bound (5 sigma) is below 1e-5 a light.
///
/// n_samples  fewer where the density has peaks that the quadrature cannot follow
void expect_directions_follow_density(const Light& light, Vec3f from, std::uint32_t n_samples = 20000) {
    constexpr std::size_t kZ = 12, kPhi = 12, kFine = 24;
    const Cone cone = cone_of_samples(light, from);
    ASSERT_GT(cone.one_minus_cos, 0);
    const Frame frame = Frame::from_z(cone.axis);

    std::vector<double> expected(kZ * kPhi);
    const double cell = 2 * static_cast<double>(kPi) * cone.one_minus_cos / (kZ * kPhi * kFine * kFine);
    double total = 0;
    for (std::size_t z = 0; z < kZ * kFine; ++z)
        for (std::size_t p = 0; p < kPhi * kFine; ++p) {
            const double one_minus_z = (static_cast<double>(z) + 0.5) / (kZ * kFine) * cone.one_minus_cos;
            const double phi = (static_cast<double>(p) + 0.5) / (kPhi * kFine) * 2 * static_cast<double>(kPi);
            const double r = std::sqrt(one_minus_z * (2 - one_minus_z));
            const Vec3f local{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(1 - one_minus_z)};
            const double share = static_cast<double>(look(light, from, normalize(frame.world_from_local(local))).pdf) * cell;
            expected[z / kFine * kPhi + p / kFine] += share * n_samples;
            total += share;
        }

    std::vector<double> counts(kZ * kPhi);
    double valid = 0;
    Sampler sampler(1, 2, 0, 99);
    for (std::uint32_t i = 0; i < n_samples; ++i) {
        const LightSample s = light.sample(from, {sampler.random(2 * i), sampler.random(2 * i + 1)});
        if (!(s.pdf > 0)) continue;
        valid += 1;
        const double one_minus_z = static_cast<double>(length_squared(s.wi - cone.axis)) / 2;
        const Vec3f local = frame.local_from_world(s.wi);
        double phi = static_cast<double>(std::atan2(local.y, local.x)) / (2 * static_cast<double>(kPi));
        if (phi < 0) phi += 1;
        const std::size_t z = static_cast<std::size_t>(one_minus_z / cone.one_minus_cos * kZ), p = static_cast<std::size_t>(phi * kPhi);
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
void expect_strategies_agree(const Light& light, Vec3f from) {
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
            EXPECT_NEAR(e.radiance[c], s.radiance[c], 2e-3F * (1e-3F + max_component(s.radiance)));
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
void expect_bounds_hold(const Light& light, Vec3f from) {
    const LightBounds bounds = light.bounds();
    const double reach = std::acos(std::clamp(static_cast<double>(bounds.cos_spread), -1.0, 1.0)) + (light.infinite() ? 0 : std::acos(static_cast<double>(bounds.cos_emission)));
    const Vec3f room = Vec3f{1, 1, 1} * (1e-4F * (1 + length(bounds.box.size())));
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const LightSample s = light.sample(from, sobol(i, 3));
        if (!(s.pdf > 0)) continue;
        EXPECT_LE(std::atan2(static_cast<double>(length(cross(bounds.axis, -s.wi))), static_cast<double>(dot(bounds.axis, -s.wi))), reach + 1e-3);
        if (light.infinite()) continue;
        const Vec3f on = from + s.wi * s.distance, low = on - (bounds.box.lower - room), high = (bounds.box.upper + room) - on;
        EXPECT_TRUE(low.x >= 0 && low.y >= 0 && low.z >= 0 && high.x >= 0 && high.y >= 0 && high.z >= 0);
    }
}

void expect_sound(const Light& light, Vec3f from) {
    expect_strategies_agree(light, from);
    expect_directions_follow_density(light, from);
    expect_bounds_hold(light, from);
}

bool never_shines(const Light& light) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Vec2f u = sobol(i);
        const Vec3f from = Vec3f{u.x, u.y, sobol(i, 1).x} * 20 - Vec3f{10, 10, 10};
        const LightSample s = light.sample(from, sobol(i, 2));
        if (s.pdf != 0 || look(light, from, normalize(from)).pdf != 0) return false;
    }
    return light.bounds().intensity == 0;
}

void expect_near(Color actual, Color expected, float relative) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], expected[c], relative * std::max(std::abs(expected[c]), 1e-3F * max_component(expected))) << "channel " << c;
}

// ---- distant_light

TEST(DistantLight, ParallelLightGivesItsIrradiance) {
    Bench b(node_distant_light());
    b.node.set<Color>("color", {1, 0.5F, 0.25F}).set("intensity", 3.0F).set("exposure", 1.0F);
    b.context->color = {1, 0.5F, 0.25F};
    b.matrix(placed({5, 6, 7})).make();
    const LightSample s = b.light->sample({1, 2, 3}, {0.3F, 0.8F});
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(s.pdf, 1);
    EXPECT_EQ(s.distance, kInfinity);
    // The matrix looks along (1, -2, 0.5): that is where the light goes.
    EXPECT_NEAR(dot(s.wi, normalize(Vec3f{-1, 2, -0.5F})), 1, 1e-6F);
    expect_near(s.radiance, {6, 3, 1.5F}, 1e-6F);
    EXPECT_EQ(b.light->escape(s.wi).pdf, 0);
    EXPECT_TRUE(b.light->infinite());
    EXPECT_NEAR(b.light->irradiance(), 3.5F, 1e-5F);
}

TEST(DistantLight, DirectionParameter) {
    Bench b(node_distant_light());
    b.node.set_array<Vec3f>("direction", {{-0.2F, 0.6F, -0.8F}});
    b.make();
    EXPECT_NEAR(dot(b.light->sample({}, {}).wi, normalize(Vec3f{0.2F, -0.6F, 0.8F})), 1, 1e-6F);
}

TEST(DistantLight, AnAngleKeepsTheIrradiance) {
    for (const float angle : {0.5F, 20.0F, 100.0F}) {
        Bench b(node_distant_light());
        b.node.set("angle", angle).set("intensity", 2.0F);
        b.matrix(placed({0, 0, 0})).make();
        const Vec3f facing = normalize(Vec3f{-1, 2, -0.5F});
        EXPECT_NEAR(sampled_irradiance(*b.light, {}, facing).r, 2, 2e-4F) << angle;
        expect_sound(*b.light, {});
    }
    Bench radiance(node_distant_light());
    radiance.node.set("angle", 20.0F).set("normalize", false);
    radiance.make();
    EXPECT_EQ(radiance.light->escape({0, 0, 1}).radiance, kWhite);
    EXPECT_EQ(radiance.light->escape({0, 0, -1}).pdf, 0);
}

TEST(DistantLight, NoDirectionIsAnError) {
    Bench b(node_distant_light());
    b.matrix(Mat4f::scale({1, 1, 0})).make();
    EXPECT_EQ(b.light, nullptr);
    EXPECT_TRUE(b.context->diagnostics().has_errors());
    EXPECT_EQ(b.context->diagnostics().items()[0].where.text(), "matrix");
}

// ---- point_light

TEST(PointLight, TruePointFallsOffWithTheSquare) {
    Bench b(node_point_light());
    b.node.set("intensity", 8.0F).set_array<Vec3f>("position", {{0, 1, 0}});
    b.matrix(Mat4f::translation({0, 1, 0})).make();
    const LightSample s = b.light->sample({}, {0.1F, 0.2F});
    EXPECT_TRUE(s.delta);
    EXPECT_EQ(s.distance, 2);
    expect_near(s.radiance, {2, 2, 2}, 1e-6F);
    EXPECT_EQ(b.light->geometry(), nullptr);
    EXPECT_EQ(b.light->sample({0, 2, 0}, {}).pdf, 0) << "at the light itself";
}

TEST(PointLight, SphereIsAsBrightAsAPointAndExact) {
    for (const float r : {1e-4F, 0.5F, 1.9F}) {
        Bench b(node_point_light());
        b.node.set("intensity", 8.0F);
        b.radius(r).matrix(Mat4f::translation({0, 2, 0})).make();
        const Vec3f normal = normalize(Vec3f{0.02F, 1, 0.01F});
        // E = pi L (R/d)^2 cos for a sphere above the horizon, so I cos / d^2 when normalised.
        EXPECT_NEAR(sampled_irradiance(*b.light, {}, normal).r, 2 * normal.y, 2e-3F) << r;
        if (r > 0.1F) expect_sound(*b.light, {0.1F, 0, -0.2F});
        EXPECT_EQ(b.light->sample({0, 2, r * 0.5F}, {0.5F, 0.5F}).pdf, 0) << "inside";
    }
    Bench radiance(node_point_light());
    radiance.node.set("normalize", false);
    radiance.radius(0.5F).make();
    expect_near(radiance.light->sample({0, 3, 0}, {0.3F, 0.4F}).radiance, kWhite, 1e-6F);
}

TEST(PointLight, MatrixScalesTheRadius) {
    Bench b(node_point_light());
    b.radius(0.5F).matrix(Mat4f::scale({2, 2, 2})).make();
    EXPECT_NEAR(std::get<SphereList>(b.light->geometry()->data).radii[0], 1, 1e-5F);
}

// ---- quad_light

std::vector<Vec3f> quad_corners(const Mat4f& m) { return {m.point({1, -1, 0}), m.point({-1, -1, 0}), m.point({-1, 1, 0}), m.point({1, 1, 0})}; }

TEST(QuadLight, AgreesWithLambertsFormula) {
    // Shining along (1, -2, 0.5) from above; a mirrored and a stretched one too.
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{0.3F, 2, 1}, Vec3f{-1, 0.7F, 1}, Vec3f{0.05F, 0.05F, 0}, Vec3f{1, 1, -1}}) {
        const Mat4f m = placed({-1, 4, 0}, scale);
        Bench b(node_quad_light());
        b.node.set("intensity", 5.0F);
        b.matrix(m).make();
        const double area = 4 * static_cast<double>(std::abs(scale.x * scale.y));
        // Local -Z is the lit side, wherever it points.
        const Vec3f lit = scale.z < 0 ? Vec3f{-2.5F, 8, -1} : Vec3f{0.5F, 0, 1};
        const Vec3f normal = scale.z < 0 ? Vec3f{0, -1, 0} : Vec3f{0, 1, 0};
        const double expected = 5 / area * polygon_irradiance(quad_corners(m), lit, normal);
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, lit, normal).r) / expected, 1, 5e-4) << scale.x << " " << scale.y << " " << scale.z;
        expect_sound(*b.light, lit);
    }
}

TEST(QuadLight, NearAndGrazingPointsStayExact) {
    Bench b(node_quad_light());
    b.matrix(Mat4f::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, 1})).make();
    const std::vector<Vec3f> corners{{1, 1, 1}, {-1, 1, 1}, {-1, 1, -1}, {1, 1, -1}};
    for (const Vec3f from : {Vec3f{0.2F, 0.999F, 0.1F}, Vec3f{4, 0.97F, 0}, Vec3f{500, -800, 300}, Vec3f{0, 0, 0}}) {
        const Vec3f normal = normalize(Vec3f{0, 1, 0} - from);
        const double expected = polygon_irradiance(corners, from, normal) / 4;
        // Near points see parts of the light below their horizon.
        if (from.x < 0.5F && from.y > 0.5F) continue;
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, from, normal).r) / expected, 1, 3e-3) << from.x;
    }
    expect_strategies_agree(*b.light, {0.2F, 0.9F, 0.1F});
    expect_directions_follow_density(*b.light, {0.2F, 0.9F, 0.1F});
}

TEST(QuadLight, OneSidedAndUnnormalised) {
    Bench b(node_quad_light());
    b.node.set("normalize", false);
    b.make();
    EXPECT_EQ(b.light->sample({0, 0, 1}, {0.5F, 0.5F}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 1}, {0, 0, -1}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 1}, {0, 0, -1}).radiance, kBlack);
    EXPECT_EQ(look(*b.light, {0, 0, -1}, {0, 0, 1}).radiance, kWhite);
}

TEST(QuadLight, AnyQuadrilateral) {
    Bench b(node_quad_light());
    const std::vector<Vec3f> corners{{1, -1, 0}, {-1.5F, -1, 0}, {-1, 1, 0}, {0.5F, 2, 0}};
    b.node.set_array("vertices", corners);
    b.matrix(placed({-1, 4, 0})).make();
    std::vector<Vec3f> world;
    for (const Vec3f c : corners)
        world.push_back(placed({-1, 4, 0}).point(c));
    const double area = 0.5 * static_cast<double>(length(cross(world[2] - world[0], world[3] - world[1])));
    const double expected = polygon_irradiance(world, {0.5F, 0, 1}, {0, 1, 0}) / area;
    EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {0.5F, 0, 1}, {0, 1, 0}).r) / expected, 1, 1e-3);
    expect_sound(*b.light, {0.5F, 0, 1});
}

TEST(QuadLight, ColourByTexture) {
    Bench b(node_quad_light());
    b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 1}; };
    b.node.set("normalize", false);
    b.make();
    // From the lit side, looking along +Z with Y up, +X is on the left: u grows to the right, v upward.
    expect_near(look(*b.light, {-0.8F, 0.6F, -2}, {0, 0, 1}).radiance, {0.9F, 0.8F, 1}, 1e-4F);
    expect_strategies_agree(*b.light, {-0.3F, 0.2F, -1});
    EXPECT_NEAR(b.light->bounds().intensity, 4 * 2.0F / 3, 0.01F);
}

TEST(QuadLight, HostileParameters) {
    const float nan = std::nanf("");
    Bench flat(node_quad_light());
    flat.matrix(Mat4f::scale({1, 0, 1})).make();
    EXPECT_TRUE(never_shines(*flat.light));
    EXPECT_EQ(flat.context->diagnostics().n_warnings(), 1U);

    Bench broken(node_quad_light());
    Mat4f m;
    m.m[1][2] = nan;
    broken.matrix(m).make();
    EXPECT_EQ(broken.light, nullptr);
    EXPECT_EQ(broken.context->diagnostics().items().at(0).where.text(), "matrix");

    Bench corners(node_quad_light());
    corners.node.set_array<Vec3f>("vertices", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}});
    corners.make();
    EXPECT_EQ(corners.light, nullptr);
    EXPECT_EQ(corners.context->diagnostics().items().at(0).where.text(), "vertices");

    Bench far(node_quad_light());
    far.node.set_array<Vec3f>("vertices", {{0, 0, 0}, {nan, 0, 0}, {1, 1, 0}, {0, 1, 0}});
    far.make();
    EXPECT_EQ(far.light, nullptr);

    Bench bright(node_quad_light());
    bright.node.set("exposure", 300.0F);
    bright.make();
    EXPECT_EQ(bright.light, nullptr);
    EXPECT_EQ(bright.context->diagnostics().items().at(0).where.text(), "exposure");
}

TEST(AnyLight, IntensityBoundsWhatIsSeenFromAfar) {
    std::vector<Bench> benches;
    for (const auto& make : {node_quad_light, node_disk_light, node_cylinder_light, node_point_light, node_spot_light}) {
        benches.emplace_back(make());
        benches.back().node.set("intensity", 3.0F);
    }
    benches[2].radius(0.3F);
    benches[3].radius(0.3F);
    for (Bench& b : benches) {
        b.make();
        const float intensity = b.light->bounds().intensity;
        float most = 0;
        for (std::uint32_t i = 0; i < 64; ++i) {
            const Vec2f u = sobol(i);
            const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
            const Vec3f away = i == 0 ? Vec3f{0, 0, -1} : Vec3f{r * std::cos(2 * kPi * u.y), r * std::sin(2 * kPi * u.y), z};
            most = std::max(most, sampled_irradiance(*b.light, away * 100, -away, 256).r * 1e4F);
        }
        EXPECT_LT(most, intensity * 1.01F) << b.node.type().name.view();
        EXPECT_GT(most, intensity * 0.9F) << b.node.type().name.view();
    }
}

TEST(AnyLight, MotionIsAWarning) {
    Bench b(node_quad_light());
    b.node.set_array<Mat4f>("matrix", {Mat4f{}, Mat4f::translation({1, 0, 0})}, 2);
    b.make();
    ASSERT_NE(b.light, nullptr);
    EXPECT_EQ(b.context->diagnostics().n_warnings(), 1U);
    Bench still(node_quad_light());
    still.node.set_array<Mat4f>("matrix", {Mat4f{}, Mat4f{}}, 2);
    still.make();
    EXPECT_EQ(still.context->diagnostics().n_warnings(), 0U);
}

// ---- disk_light

TEST(DiskLight, AgreesWithItsClosedForms) {
    Bench b(node_disk_light());
    b.node.set("intensity", 3.0F);
    b.radius(1).matrix(Mat4f::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, 1})).make();
    // On the axis: E = pi L R^2 / (R^2 + h^2), L = I / (pi R^2).
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 3.0F / 5, 3e-4F);
    expect_sound(*b.light, {0.7F, 0, 0.3F});
    EXPECT_EQ(b.light->sample({0, 3, 0}, {0.4F, 0.4F}).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 3, 0}, {0, -1, 0}).pdf, 0);
    // Rays meet a polygon around the disc; its corners do not shine.
    const Vec3f corner = normalize(std::get<TriangleMesh>(b.light->geometry()->data).positions[0][0] - Vec3f{0, 2, 0});
    EXPECT_TRUE(cast(*b.light, corner * 1.0005F, {0, 1, 0}).has_value());
    EXPECT_EQ(look(*b.light, corner * 1.0005F, {0, 1, 0}).pdf, 0);
    EXPECT_GT(look(*b.light, corner * 0.9995F, {0, 1, 0}).pdf, 0);
}

TEST(DiskLight, MatrixMakesEllipses) {
    const Mat4f m = placed({-1, 4, 0}, {2, 0.5F, -1});
    Bench b(node_disk_light());
    b.radius(1).matrix(m).make();
    std::vector<Vec3f> polygon;
    for (int i = 0; i < 2000; ++i)
        polygon.push_back(m.point({std::cos(2 * kPi * static_cast<float>(i) / 2000), std::sin(2 * kPi * static_cast<float>(i) / 2000), 0}));
    const double expected = polygon_irradiance(polygon, {-2.5F, 8, -1}, {0, -1, 0}) / static_cast<double>(kPi);
    EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {-2.5F, 8, -1}, {0, -1, 0}).r) / expected, 1, 1e-3);
    expect_sound(*b.light, {-2.5F, 8, -1});
}

TEST(DiskLight, ZeroRadiusIsDark) {
    Bench b(node_disk_light());
    b.radius(0).make();
    EXPECT_TRUE(never_shines(*b.light));
    EXPECT_EQ(b.context->diagnostics().n_warnings(), 1U);
}

// ---- cylinder_light

/// Irradiance of a lit mantle with radiance 1, by summing over small pieces.
double mantle_irradiance(const Mat4f& m, float radius, Vec3f from, Vec3f normal) {
    constexpr int kAround = 720, kAlong = 400;
    double sum = 0;
    for (int i = 0; i < kAround; ++i)
        for (int j = 0; j < kAlong; ++j) {
            const float a0 = 2 * kPi * static_cast<float>(i) / kAround, a1 = 2 * kPi * static_cast<float>(i + 1) / kAround, a = 0.5F * (a0 + a1);
            const float y = -1 + 2 * (static_cast<float>(j) + 0.5F) / kAlong;
            const Vec3f p = m.point({radius * std::cos(a), y, radius * std::sin(a)});
            const Vec3f piece = cross(m.vector({0, 2.0F / kAlong, 0}), m.vector(Vec3f{radius * (std::cos(a1) - std::cos(a0)), 0, radius * (std::sin(a1) - std::sin(a0))}));
            const Vec3f out = m.vector({std::cos(a), 0, std::sin(a)});
            const Vec3f directed = dot(piece, out) < 0 ? -piece : piece, wi = p - from;
            const double d2 = static_cast<double>(length_squared(wi));
            sum += std::max(0.0, static_cast<double>(-dot(directed, wi))) * std::max(0.0, static_cast<double>(dot(normal, wi))) / (d2 * d2);
        }
    return sum;
}

TEST(CylinderLight, AgreesWithQuadrature) {
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{0.5F, 2, 0.5F}, Vec3f{-1, 1, 1}}) {
        const Mat4f m = placed({-1, 5, 0}, scale);
        Bench b(node_cylinder_light());
        b.node.set("intensity", 3.0F);
        b.radius(0.5F).matrix(m).make();
        const double area = static_cast<double>(2 * kPi * 0.5F * std::abs(scale.x) * 2 * scale.y);
        const double expected = 3 / area * mantle_irradiance(m, 0.5F, {0.5F, 0, 1}, {0, 1, 0});
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {0.5F, 0, 1}, {0, 1, 0}).r) / expected, 1, 3e-3);
        expect_strategies_agree(*b.light, {0.5F, 0, 1});
        expect_bounds_hold(*b.light, {0.5F, 0, 1});
        // At the silhouette the density goes to infinity.
        expect_directions_follow_density(*b.light, {0.5F, 0, 1}, 5000);
    }
}

TEST(CylinderLight, ShinesOutwardOnly) {
    Bench b(node_cylinder_light());
    b.make();
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(b.light->sample({0.1F, 0.2F, 0}, sobol(i)).pdf, 0);
    EXPECT_EQ(look(*b.light, {0, 0, 0}, {1, 0, 0}).pdf, 0);
    EXPECT_GT(look(*b.light, {3, 0, 0.1F}, {-1, 0, 0}).pdf, 0);
    Bench thin(node_cylinder_light());
    thin.radius(0).make();
    EXPECT_TRUE(never_shines(*thin.light));
}

// ---- spot_light

/// Fraction of I cos / d^2 that a spot at the origin gives toward a direction with the given tangents.
float beam(Bench& b, float x, float y) {
    const Vec3f from = Vec3f{x, y, -1} * 3;
    const LightSample s = b.light->sample(from, {0.4F, 0.6F});
    return s.pdf > 0 ? s.radiance.r * length_squared(from) : 0;
}

TEST(SpotLight, BeamProfile) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 60.0F).set("penumbra_angle", 10.0F);
    b.make();
    const float outer = std::tan(deg_to_rad(30)), inner = std::tan(deg_to_rad(20));
    EXPECT_NEAR(beam(b, 0, 0), 1, 1e-5F);
    EXPECT_NEAR(beam(b, inner * 0.99F, 0), 1, 1e-5F);
    EXPECT_NEAR(beam(b, 0, 0.5F * (inner + outer)), 0.5F, 1e-4F);
    EXPECT_NEAR(beam(b, 0.75F * inner + 0.25F * outer, 0), 0.84375F, 1e-4F);  // smoothstep(0.75)
    EXPECT_GT(beam(b, outer * 0.99F, 0), 0);
    EXPECT_EQ(beam(b, outer * 1.01F, 0), 0);
    EXPECT_EQ(beam(b, outer * 0.72F, -outer * 0.72F), 0) << "round";
    EXPECT_EQ(b.light->sample({0, 0, 1}, {}).pdf, 0) << "behind";
    expect_bounds_hold(*b.light, {0.2F, 0.1F, -2});
}

TEST(SpotLight, RoundnessAspectAndPower) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 90.0F).set("roundness", 0.35F);
    b.make();
    // The corner of a superellipse with exponent 2 / 0.35 lies at 2^(-0.175).
    const float corner = std::exp2(-0.175F);
    EXPECT_NEAR(beam(b, corner * 0.99F, corner * 0.99F), 1, 1e-5F);
    EXPECT_EQ(beam(b, corner * 1.01F, corner * 1.01F), 0);
    b.node.set("roundness", 0.0F);
    b.make();
    EXPECT_NEAR(beam(b, 0.99F, 0.99F), 1, 1e-5F);
    EXPECT_EQ(beam(b, 1.01F, 0), 0);
    expect_bounds_hold(*b.light, Vec3f{0.99F, 0.99F, -1} * 2);
    b.node.set("aspect_ratio", 2.0F);
    b.make();
    EXPECT_EQ(beam(b, 0, 0.51F), 0);
    EXPECT_NEAR(beam(b, 0.99F, 0.49F), 1, 1e-5F);
    b.node.set("cosine_power", 4.0F);
    b.make();
    EXPECT_NEAR(beam(b, 0.5F, 0), std::pow(1 / std::sqrt(1.25F), 4.0F), 1e-4F);
}

TEST(SpotLight, SphereKeepsBrightnessAndBeam) {
    Bench b(node_spot_light());
    b.node.set("intensity", 2.0F);
    b.radius(0.5F).matrix(Mat4f::look_at({0, 4, 0}, {0, 0, 0}, {0, 0, 1})).make();
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 2.0F / 16, 1e-4F);
    expect_sound(*b.light, {0.5F, 0, 0.2F});
    const Vec3f outside{4, 0, 0};
    EXPECT_EQ(b.light->sample(outside, {0.3F, 0.3F}).pdf, 0);
    EXPECT_EQ(look(*b.light, outside, normalize(Vec3f{0, 4, 0} - outside)).pdf, 0);
}

TEST(SpotLight, LensSetsTheApexBack) {
    Bench b(node_spot_light());
    b.node.set("cone_angle", 90.0F).set("lens_radius", 1.0F).set("intensity", 9.0F);
    b.make();
    // Apex 1 behind the lens: 3 from the point, which a ray leaves toward the apex and ends at the lens.
    const LightSample s = b.light->sample({0, 0, -2}, {});
    EXPECT_NEAR(s.radiance.r, 1, 1e-5F);
    EXPECT_NEAR(s.distance, 2, 1e-5F);
    // The beam is as wide as the lens where it leaves.
    EXPECT_GT(b.light->sample({0.99F, 0, -0.01F}, {}).pdf, 0);
    EXPECT_EQ(b.light->sample({1.1F, 0, -0.01F}, {}).pdf, 0);
    EXPECT_EQ(b.light->sample({0, 0, 0.5F}, {}).pdf, 0) << "between apex and lens";
    b.radius(0.2F).make();
    EXPECT_NEAR(sampled_irradiance(*b.light, {0, 0, -2}, {0, 0, 1}).r, 1, 1e-3F);
}

TEST(SpotLight, HostileParameters) {
    for (const char* name : {"cone_angle", "penumbra_angle", "cosine_power", "aspect_ratio", "roundness", "lens_radius"}) {
        Bench b(node_spot_light());
        b.node.set(name, std::nanf(""));
        b.make();
        EXPECT_EQ(b.light, nullptr) << name;
        EXPECT_EQ(b.context->diagnostics().items().at(0).where.text(), name);
    }
    Bench closed(node_spot_light());
    closed.node.set("cone_angle", 0.0F);
    closed.make();
    EXPECT_TRUE(never_shines(*closed.light));
    Bench nowhere(node_spot_light());
    nowhere.matrix(Mat4f::scale({1, 1, 0})).make();
    EXPECT_EQ(nowhere.light, nullptr);
    Bench wide(node_spot_light());
    wide.node.set("cone_angle", 180.0F);
    wide.make();
    EXPECT_NEAR(beam(wide, 10, 0), 1, 1e-4F);
}

// ---- mesh_light

/// A cube of two triangles a side, outward, with edge 2.
ShapeGeometry cube() {
    TriangleMesh mesh;
    mesh.positions = {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
    mesh.indices = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 3, 7, 6, 3, 6, 2, 0, 4, 7, 0, 7, 3, 1, 2, 6, 1, 6, 5};
    mesh.corner = mesh.indices;
    mesh.face = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
    return {mesh, {}, true};
}

Bench mesh_bench(const Mat4f& m) {
    Bench b(node_mesh_light());
    b.context->mesh = cube();
    b.context->mesh_matrix = m;
    static const int some_node = 0;
    b.node.set("mesh", NodeRef{reinterpret_cast<const NodeInstance*>(&some_node)});
    return b;
}

TEST(MeshLight, CubeAgreesWithLambertsFormula) {
    for (const Vec3f scale : {Vec3f{1, 1, 1}, Vec3f{-1, 1, 1}, Vec3f{0.5F, 1, 0.25F}}) {
        const Mat4f m = Mat4f::scale(scale) * Mat4f::translation({0, 3, 0});
        Bench b = mesh_bench(m);
        b.node.set("intensity", 6.0F);
        b.make();
        ASSERT_NE(b.light, nullptr);
        const double area = 8 * static_cast<double>(std::abs(scale.x * scale.y) + std::abs(scale.y * scale.z) + std::abs(scale.z * scale.x));
        // Right below the middle only the bottom is seen.
        std::vector<Vec3f> bottom{m.point({-1, -1, -1}), m.point({1, -1, -1}), m.point({1, -1, 1}), m.point({-1, -1, 1})};
        const double expected = 6 / area * polygon_irradiance(bottom, {0, 0, 0}, {0, 1, 0});
        EXPECT_NEAR(static_cast<double>(sampled_irradiance(*b.light, {}, {0, 1, 0}, 1U << 17U).r) / expected, 1, 5e-3);
        expect_directions_follow_density(*b.light, {3, 0, 2});
        expect_bounds_hold(*b.light, {3, 0, 2});
        EXPECT_EQ(look(*b.light, {0, 3, 0}, {0, 1, 0}).pdf, 0) << "inside";
    }
}

TEST(MeshLight, FlatMeshKnowsItsSide) {
    Bench b = mesh_bench(Mat4f::translation({0, 3, 0}));
    TriangleMesh square;
    square.positions = {{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}};
    square.indices = {0, 1, 2, 0, 2, 3};  // downward
    square.corner = square.indices;
    square.face = {0, 0};
    square.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    square.uv_indices = square.indices;
    b.context->mesh = ShapeGeometry{square, {}, true};
    b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 1}; };
    b.node.set("normalize", false);
    b.make();
    EXPECT_EQ(b.light->bounds().cos_spread, 1);
    EXPECT_NEAR(b.light->bounds().axis.y, -1, 1e-6F);
    expect_sound(*b.light, {0.3F, 0, 0.4F});
    expect_near(look(*b.light, {0.5F, 0, 0}, {0, 1, 0}).radiance, {0.75F, 0.5F, 1}, 1e-4F);
    EXPECT_EQ(look(*b.light, {0.5F, 5, 0}, {0, -1, 0}).pdf, 0);
}

TEST(MeshLight, HostileMeshes) {
    Bench none(node_mesh_light());
    none.make();
    EXPECT_EQ(none.light, nullptr);
    EXPECT_EQ(none.context->diagnostics().items().at(0).where.text(), "mesh");

    Bench ball = mesh_bench({});
    ball.context->mesh = ShapeGeometry{SphereList{{{{0, 0, 0}}}, {1}}, {}, true};
    ball.make();
    EXPECT_EQ(ball.light, nullptr);
    EXPECT_EQ(ball.context->diagnostics().items().at(0).where.text(), "mesh");

    Bench flat = mesh_bench(Mat4f::scale({1, 0, 0}));
    flat.make();
    EXPECT_TRUE(never_shines(*flat.light));

    Bench unresolved = mesh_bench({});
    unresolved.context->mesh.reset();
    unresolved.make();
    EXPECT_EQ(unresolved.light, nullptr);

    Bench broken = mesh_bench({});
    std::get<TriangleMesh>(broken.context->mesh->data).positions[0][0].x = std::nanf("");
    broken.make();
    EXPECT_TRUE(never_shines(*broken.light));
}

// ---- skydome_light

TEST(SkydomeLight, EvenDome) {
    Bench b(node_skydome_light());
    b.node.set("intensity", 2.0F);
    b.make();
    EXPECT_TRUE(b.light->is_skydome());
    EXPECT_TRUE(b.light->infinite());
    EXPECT_NEAR(sampled_irradiance(*b.light, {}, {0, 1, 0}).r, 2 * kPi, 2e-3F);
    EXPECT_NEAR(b.light->irradiance(), 2 * kPi, 1e-4F);
    expect_sound(*b.light, {});
    EXPECT_EQ(b.node.get<float>("camera"), 1);
    EXPECT_EQ(b.node.get<float>("transmission"), 1);
}

/// Irradiance of a dome by summing over directions.
Color dome_irradiance(const Light& light, Vec3f normal) {
    constexpr int kLatitudes = 1000;
    double sum[3] = {};
    for (int y = 0; y < kLatitudes; ++y)
        for (int x = 0; x < 2 * kLatitudes; ++x) {
            const double theta = (y + 0.5) / kLatitudes * static_cast<double>(kPi), phi = (x + 0.5) / kLatitudes * static_cast<double>(kPi);
            const Vec3f d{static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::cos(theta)), static_cast<float>(std::sin(theta) * std::sin(phi))};
            const double weight = std::max(0.0, static_cast<double>(dot(d, normal))) * std::sin(theta) * square(kPi / kLatitudes);
            const Color c = light.escape(d).radiance;
            for (int i = 0; i < 3; ++i)
                sum[i] += weight * static_cast<double>(c[i]);
        }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1]), static_cast<float>(sum[2])};
}

TEST(SkydomeLight, PictureIsSampledByBrightness) {
    Bench b(node_skydome_light());
    // A sun of 5 degrees, black ground, and a sky that varies.
    b.context->shader = [](const ShadePoint& at) {
        const Vec3f sun = normalize(Vec3f{1, 2, 0.5F});
        if (dot(at.direction, sun) > std::cos(deg_to_rad(5))) return Color{50, 45, 40};
        return at.direction.y < 0 ? kBlack : Color{0.2F, 0.3F, 0.3F + at.direction.x * 0.2F};
    };
    b.node.set("resolution", 400);
    b.make();
    expect_near(sampled_irradiance(*b.light, {}, {0, 1, 0}, 1U << 17U), dome_irradiance(*b.light, {0, 1, 0}), 4e-3F);
    EXPECT_NEAR(b.light->irradiance(), average(dome_irradiance(*b.light, {0, 1, 0})), 0.02F);
    expect_strategies_agree(*b.light, {});
    expect_directions_follow_density(*b.light, {});
    // Nothing that shines has density 0, and black parts get few samples.
    int black = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        EXPECT_GT(b.light->escape(b.light->sample({}, sobol(i)).wi).pdf, 0);
        black += is_black(b.light->sample({}, sobol(i)).radiance) ? 1 : 0;
    }
    EXPECT_LT(black, 100);
}

TEST(SkydomeLight, DetailsBetweenTheSamplesOfTheTableAreNotLost) {
    Bench b(node_skydome_light());
    // A sun much smaller than a cell, somewhere the table does not look.
    b.context->shader = [](const ShadePoint& at) { return dot(at.direction, normalize(Vec3f{0.31F, 0.17F, 0.43F})) > std::cos(deg_to_rad(0.05F)) ? Color::grey(1e6F) : kBlack; };
    b.node.set("resolution", 16);
    b.make();
    EXPECT_GT(b.light->irradiance(), 0);
    EXPECT_GT(b.light->escape(normalize(Vec3f{0.31F, 0.17F, 0.43F})).pdf, 0);
}

TEST(SkydomeLight, Layouts) {
    // u in red, v in green. Latlong: u = 1/2 - atan2(x, z) / 2 pi, v = 1/2 + asin(y) / pi.
    const auto uv_of = [](std::int32_t format, Vec3f d) {
        Bench b(node_skydome_light());
        b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, 0}; };
        b.node.set_enum("format", format).set("resolution", 16);
        b.make();
        const Color c = b.light->escape(d).radiance;
        return Vec2f{c.r, c.g};
    };
    const auto expect_uv = [](Vec2f uv, float u, float v) {
        EXPECT_NEAR(uv.x, u, 1e-5F);
        EXPECT_NEAR(uv.y, v, 1e-5F);
    };
    constexpr std::int32_t kBall = 0, kAngular = 1, kLatLong = 2;
    expect_uv(uv_of(kLatLong, {0, 0, 1}), 0.5F, 0.5F);
    expect_uv(uv_of(kLatLong, {1, 0, 0}), 0.25F, 0.5F);
    expect_uv(uv_of(kLatLong, {-1, 0, 0}), 0.75F, 0.5F);
    expect_uv(uv_of(kLatLong, normalize(Vec3f{0, 1, 1})), 0.5F, 0.75F);
    expect_uv(uv_of(kAngular, {0, 0, 1}), 0.5F, 0.5F);
    expect_uv(uv_of(kAngular, {0, 1, 0}), 0.5F, 0.75F);
    expect_uv(uv_of(kAngular, {1, 0, 0}), 0.25F, 0.5F);
    expect_uv(uv_of(kBall, {0, 1, 0}), 0.5F, 0.5F + 0.5F * std::sin(kPi / 4));
    expect_uv(uv_of(kBall, {0, 0, 1}), 0.5F, 0.5F);
}

TEST(SkydomeLight, MatrixTurnsThePicture) {
    Bench b(node_skydome_light());
    b.context->shader = [](const ShadePoint& at) { return Color{at.uv.x, at.uv.y, at.direction.x}; };
    b.node.set("resolution", 64);
    // Local X goes to world Z; scale and shift do not matter.
    Mat4f m;
    m.m = {{{0, 0, 3, 0}, {0, 3, 0, 0}, {-3, 0, 0, 0}, {7, 8, 9, 1}}};
    b.matrix(m).make();
    expect_near(b.light->escape({0, 0, 1}).radiance, {0.25F, 0.5F, 0}, 1e-4F);
    expect_near(b.light->escape({-1, 0, 0}).radiance, {0.5F, 0.5F, -1}, 1e-4F);
    expect_sound(*b.light, {});
    // A mirrored dome shows a mirrored picture.
    Bench mirrored(node_skydome_light());
    mirrored.context->shader = b.context->shader;
    mirrored.node.set("resolution", 64);
    mirrored.matrix(Mat4f::scale({-1, 1, 1})).make();
    expect_near(mirrored.light->escape({1, 0, 0}).radiance, {0.75F, 0.5F, 1}, 1e-4F);
    expect_strategies_agree(*mirrored.light, {});
}

TEST(SkydomeLight, HostileParameters) {
    Bench singular(node_skydome_light());
    singular.matrix(Mat4f::scale({0, 0, 0})).make();
    ASSERT_NE(singular.light, nullptr);
    EXPECT_EQ(singular.context->diagnostics().n_warnings(), 1U);

    Bench nan(node_skydome_light());
    nan.context->shader = [](const ShadePoint& at) { return at.uv.x < 0.5F ? Color::grey(std::nanf("")) : kWhite; };
    nan.node.set("resolution", -5);
    nan.make();
    for (std::uint32_t i = 0; i < 100; ++i) {
        const LightSample s = nan.light->sample({}, sobol(i));
        EXPECT_TRUE(std::isfinite(s.pdf) && s.pdf > 0);
    }
    EXPECT_TRUE(std::isfinite(nan.light->irradiance()));

    Bench off(node_skydome_light());
    off.node.set("intensity", 0.0F);
    off.make();
    EXPECT_EQ(off.light->irradiance(), 0);
    Bench colour(node_skydome_light());
    colour.context->color = {1, std::nanf(""), 1};
    colour.make();
    EXPECT_EQ(colour.light, nullptr);
    EXPECT_EQ(colour.context->diagnostics().items().at(0).where.text(), "color");
}

}  // namespace
}  // namespace lightsieve
