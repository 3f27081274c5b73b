// Small shaders: lambert, flat, matte, checkerboard, utility.
#include <gtest/gtest.h>

#include <array>

#include "bsdf/closure.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {

NodeType node_checkerboard();
NodeType node_flat();
NodeType node_lambert();
NodeType node_layer_rgba();
NodeType node_matte();
NodeType node_osl();
NodeType node_ray_switch_rgba();
NodeType node_utility();

namespace {

struct Shaded {
    explicit Shaded(const TestNode& node, const ShadePoint& at = {}) {
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
    }
    std::array<LobeRecord, 3> records;
    ClosureSet set;
};

Color value(const TestNode& node, const ShadePoint& at = {}) {
    return node.type().eval_value(node.block(), at).rgb;
}

void expect_color(Color is, Color expected, double tolerance = 1e-6) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(is[i], expected[i], tolerance) << "channel " << i;
}

ShadePoint at_uv(float u, float v, float width = 0) {
    ShadePoint at;
    at.uv = {u, v};
    at.uv_width = width;
    return at;
}

TEST(Checkerboard, CellsHaveTheParityOfTheirNumbers) {
    TestNode node(node_checkerboard());
    const Color odd{1, 0.5F, 0}, even{0, 0.25F, 1};
    node.set("color1", odd).set("color2", even).set("u_frequency", 4.0F).set("v_frequency", 10.0F);
    for (int i = 0; i < 200; ++i) {
        const float u = -1.3F + 0.0171F * static_cast<float>(i),
                    v = 2.1F - 0.0273F * static_cast<float>(i);
        const long c = std::lround(std::floor(2 * 4 * u)) + std::lround(std::floor(2 * 10 * v));
        EXPECT_EQ(value(node, at_uv(u, v)), c % 2 == 0 ? even : odd) << u << " " << v;
    }
}

TEST(Checkerboard, WideFootprintsSeeTheMean) {
    TestNode node(node_checkerboard());
    node.set("u_frequency", 2.0F).set("v_frequency", 2.0F);
    // Against the mean of many points, each sharp.
    for (const Vec2f uv : {Vec2f{0.26F, 0.13F}, Vec2f{0.6F, 0.9F}, Vec2f{-0.24F, 0.51F}}) {
        const float width = 0.15F;
        double mean = 0;
        for (int i = 0; i < 400; ++i)
            for (int j = 0; j < 400; ++j)
                mean += static_cast<double>(
                    value(node, at_uv(uv.x + width * (static_cast<float>(i) + 0.5F - 200) / 400,
                                      uv.y + width * (static_cast<float>(j) + 0.5F - 200) / 400))
                        .r);
        EXPECT_NEAR(value(node, at_uv(uv.x, uv.y, width)).r, mean / 160000, 0.01);
    }
    EXPECT_NEAR(value(node, at_uv(0.3F, 0.1F, 1000)).r, 0.5, 0.01);
    node.set("filter_strength", 0.0F);
    EXPECT_EQ(value(node, at_uv(0.3F, 0.1F, 1000)), kWhite);
}

TEST(Checkerboard, ContrastAndOffset) {
    TestNode node(node_checkerboard());
    node.set("contrast", 0.5F);
    expect_color(value(node, at_uv(0.1F, 0.1F)), Color::grey(0.25F));
    expect_color(value(node, at_uv(0.6F, 0.1F)), Color::grey(0.75F));
    node.set("u_offset", 0.5F);
    expect_color(value(node, at_uv(0.1F, 0.1F)), Color::grey(0.75F));
    EXPECT_TRUE(is_finite(value(node, at_uv(kInfinity, 0))));
}

TEST(Lambert, WeightsAndOpacity) {
    TestNode node(node_lambert());
    node.set("Kd_color", Color{1, 0.5F, 2}).set("opacity", Color{1, 0.25F, 0});
    const Shaded s(node);
    expect_color(s.set.albedo(0), {0.7F, 0.35F * 0.25F, 0});
    expect_color(s.set.transparency(), {0, 0.75F, 1});
    // The written normal has no effect, a linked one has.
    node.set("normal", Vec3f{1, 0, 1});
    EXPECT_NE(Shaded(node).set.closures()[0].frame, 0);
    TestContext context;
    node.type().prepare(node.block(), context);
    EXPECT_EQ(Shaded(node).set.closures()[0].frame, 0);
}

TEST(Flat, IsItsColour) {
    TestNode node(node_flat());
    node.set("color", Color{0.1F, 0.2F, 3});
    EXPECT_EQ(value(node), (Color{0.1F, 0.2F, 3}));
    EXPECT_EQ(node.type().eval_closure, nullptr);
    EXPECT_EQ(node.type().lobes.at(0).kind, EventKind::Object);
}

TEST(Matte, TakesAlphaAway) {
    TestNode node(node_matte());
    const Shaded hole(node);
    EXPECT_EQ(hole.set.matte(), kWhite);
    EXPECT_TRUE(hole.set.emissions().empty());
    node.set("color", Rgba{{1, 0.5F, 0}, 0.75F}).set("opacity", Color::grey(0.5F));
    const Shaded coloured(node);
    expect_color(coloured.set.matte(), Color::grey(0.125F));
    expect_color(coloured.set.transparency(), Color::grey(0.5F));
    expect_color(coloured.set.emissions()[0].radiance, {0.5F, 0.25F, 0});
}

TEST(Utility, ShadeModes) {
    ShadePoint at;
    at.wo = {0.6F, 0, 0.8F};
    TestNode node(node_utility());
    node.set("color", Color{1, 0.5F, 0.25F});
    expect_color(Shaded(node, at).set.emissions()[0].radiance, Color{1, 0.5F, 0.25F} * 0.8F);
    node.set_enum("shade_mode", 2);
    expect_color(Shaded(node, at).set.emissions()[0].radiance, {1, 0.5F, 0.25F});
    node.set_enum("shade_mode", 1);
    const Shaded lambert(node, at);
    EXPECT_TRUE(lambert.set.emissions().empty());
    expect_color(lambert.set.albedo(0), {1, 0.5F, 0.25F});
    // Linked to a parameter it is a plain colour.
    expect_color(value(node, at), {1, 0.5F, 0.25F});
}

TEST(Utility, ColorModes) {
    ShadePoint at;
    at.geometric_normal = {0, 0, -1};
    at.entering = false;
    at.normal = {0.6F, 0, 0.8F};
    at.tangent = {0, 1, 0};
    at.uv = {0.25F, 0.75F};
    at.barycentric = {0.2F, 0.3F};
    at.position = {3, 4, 5};
    TestNode node(node_utility());
    node.set_enum("shade_mode", 2);
    const ParamInfo& modes = *node.type().find("color_mode");
    const std::vector<std::pair<std::string, Color>> rows{
        {"color", {1, 1, 1}},         {"ng", {0.5F, 0.5F, 1}},
        {"ns", {0.8F, 0.5F, 0.9F}},   {"n", {0.8F, 0.5F, 0.9F}},
        {"bary", {0.2F, 0.3F, 0.5F}}, {"uv", {0.25F, 0.75F, 0}},
        {"u", {0.25F, 0.25F, 0.25F}}, {"v", {0.75F, 0.75F, 0.75F}},
        {"dpdu", {0.5F, 1, 0.5F}},    {"p", {3, 4, 5}}};
    for (const auto& [mode, color] : rows) {
        const auto found = std::find(modes.enumerators.begin(), modes.enumerators.end(), mode);
        ASSERT_NE(found, modes.enumerators.end()) << mode;
        node.set_enum("color_mode", static_cast<std::int32_t>(found - modes.enumerators.begin()));
        SCOPED_TRACE(mode);
        expect_color(value(node, at), color);
    }
}

TEST(Utility, PlasticAndMetalReflect) {
    TestNode node(node_utility());
    node.set("color", Color{1, 0.5F, 0.25F}).set_enum("shade_mode", 4);
    const Shaded plastic(node);
    ASSERT_EQ(plastic.set.closures().size(), 2U);
    // What the shine takes the colour below lacks.
    EXPECT_NEAR(plastic.set.albedo(1).r, 1 - plastic.set.albedo(0).r, 1e-5);
    EXPECT_GT(plastic.set.albedo(0).r, 0.03F);
    node.set_enum("shade_mode", 5);
    const Shaded metal(node);
    ASSERT_EQ(metal.set.closures().size(), 1U);
    EXPECT_GT(metal.set.albedo(0).r, metal.set.albedo(0).b);
}

TEST(Utility, ColorsOfThingsAreTheirOwn) {
    TestNode node(node_utility());
    node.set_enum("shade_mode", 2).set_enum("color_mode", 15);
    ShadePoint first, second;
    first.shape_id = 1;
    second.shape_id = 2;
    EXPECT_EQ(value(node, first), value(node, first));
    EXPECT_NE(value(node, first), value(node, second));
    node.set_enum("color_mode", 19);
    EXPECT_EQ(value(node, first), (Color{1, 0, 1})) << "no texture coordinates";
    first.dp_du = {1, 0, 0};
    first.dp_dv = {0, 1, 0};
    EXPECT_EQ(value(node, first), kWhite);
}

TEST(Osl, StandsForTheInitialValueOfItsOutput) {
    const auto shows = [](const char* code) {
        TestNode node(node_osl());
        node.set("code", Name(code));
        TestContext context;
        node.type().prepare(node.block(), context);
        EXPECT_EQ(context.count(Code::ParamPending), 1U);
        return value(node);
    };
    expect_color(shows("shader s(output color Col = color(1, 0.5, -2)) { Col = 0; }"),
                 {1, 0.5F, -2});
    expect_color(shows("shader s(float in = 3, output float x = 0.25, output color c = 1) {}"),
                 Color::grey(0.25F));
    expect_color(shows("shader s(output color Col) { Col = color(1, 1, 1); }"), kBlack);
    expect_color(shows(""), kBlack);
    expect_color(shows("output = ((("), kBlack);
}

TEST(RaySwitchRgba, GivesEachRayItsColour) {
    TestNode node(node_ray_switch_rgba());
    node.set("camera", Rgba{{1, 0, 0}, 1}).set("diffuse_transmission", Rgba{{0, 1, 0}, 0.5F});
    ShadePoint at;
    expect_color(value(node, at), {1, 0, 0});
    at.ray_type = RayType::Subsurface;
    expect_color(value(node, at), {0, 1, 0});
    at.ray_type = RayType::SpecularReflect;
    expect_color(value(node, at), kBlack);
    EXPECT_TRUE(node.type().reads_ray_type);
}

TEST(LayerRgba, PutsLayersOnOneAnother) {
    TestNode node(node_layer_rgba());
    const auto seen = [&] { return node.type().eval_value(node.block(), {}); };
    node.set("input1", Rgba{{0.2F, 0.4F, 0.6F}, 1});
    expect_color(seen().rgb, {0.2F, 0.4F, 0.6F});
    node.set("enable2", true).set("input2", Rgba{{1, 0, 0.5F}, 0.5F}).set("mix2", 0.5F);
    struct Row {
        const char* operation;
        Color blended;
    };
    const auto& names = node.type().find("operation2")->enumerators;
    const auto use = [&](const char* operation) {
        const auto found = std::find(names.begin(), names.end(), operation);
        ASSERT_NE(found, names.end()) << operation;
        node.set_enum("operation2", static_cast<std::int32_t>(found - names.begin()));
    };
    // Each blend of 0.2 0.4 0.6 with 1 0 0.5, a quarter of it.
    for (const Row& row :
         {Row{"over", {1, 0, 0.5F}}, Row{"plus", {1.2F, 0.4F, 1.1F}},
          Row{"minus", {0.8F, -0.4F, -0.1F}}, Row{"from", {-0.8F, 0.4F, 0.1F}},
          Row{"multiply", {0.2F, 0, 0.3F}}, Row{"average", {0.6F, 0.2F, 0.55F}},
          Row{"difference", {0.8F, 0.4F, 0.1F}}, Row{"screen", {1, 0.4F, 0.8F}},
          Row{"overlay", {0.4F, 0, 0.6F}}, Row{"soft_light", {0.36F, 0.16F, 0.6F}},
          Row{"min", {0.2F, 0, 0.5F}}, Row{"max", {1, 0.4F, 0.6F}},
          Row{"color_dodge", {1, 0.4F, 1}}, Row{"color_burn", {0.2F, 0, 0.2F}},
          Row{"exclusion", {0.8F, 0.4F, 0.5F}}, Row{"subtract", {0, 0.4F, 0.1F}}}) {
        SCOPED_TRACE(row.operation);
        use(row.operation);
        expect_color(seen().rgb, lerp(Color{0.2F, 0.4F, 0.6F}, row.blended, 0.25F));
    }
    // Operations that read alphas take what is there whole: half of it, for the mix.
    use("in");
    expect_color(seen().rgb, lerp(Color{0.2F, 0.4F, 0.6F}, Color{1, 0, 0.5F}, 0.5F));
    use("mask");
    expect_color(seen().rgb, Color{0.2F, 0.4F, 0.6F} * 0.75F);
    // Overwrite takes the layer by its mix alone.
    use("overwrite");
    expect_color(seen().rgb, lerp(Color{0.2F, 0.4F, 0.6F}, Color{1, 0, 0.5F}, 0.5F));
    EXPECT_NEAR(seen().a, 0.75, 1e-6);
    use("over");
    node.set_enum("alpha_operation2", 1);
    EXPECT_EQ(seen().a, 1);
}

}  // namespace
}  // namespace lightsieve
