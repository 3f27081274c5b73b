// What must hold for every node, whoever adds it; and the defaults that were measured on Arnold's pictures and logs.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "bsdf/closure.h"
#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {
namespace {

class EveryNode : public testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] const NodeType& type() const { return *builtin_registry().find(GetParam()); }
};

TEST_P(EveryNode, IsDocumented) {
    EXPECT_TRUE(type().doc.ends_with('.')) << type().doc;
    for (const ParamInfo& p : type().params)
        EXPECT_TRUE(p.doc.size() > 5 && p.doc.ends_with('.')) << p.name.view() << ": " << p.doc;
    for (const LobeInfo& l : type().lobes)
        EXPECT_TRUE(l.doc.ends_with('.')) << l.index;
}

TEST_P(EveryNode, HasParametersOfItsOwnMemory) {
    std::set<std::string> names;
    std::vector<bool> used(type().block_size, false);
    EXPECT_EQ(type().default_block.size(), type().block_size);
    for (const ParamInfo& p : type().params) {
        EXPECT_TRUE(names.insert(p.name.str()).second) << "twice: " << p.name.view();
        EXPECT_NE(p.name.str(), "name") << "the node's name is no parameter";
        const std::size_t size = p.is_array ? sizeof(Array<float>) : type_size(p.type);
        ASSERT_LE(p.offset + size, type().block_size) << p.name.view();
        for (std::size_t i = p.offset; i < p.offset + size; ++i) {
            EXPECT_FALSE(used[i]) << p.name.view() << " shares its memory";
            used[i] = true;
        }
        EXPECT_FALSE(p.ignored && p.pending) << p.name.view();
    }
}

TEST_P(EveryNode, NamesEveryEnumerator) {
    for (const ParamInfo& p : type().params) {
        EXPECT_EQ(p.type == lightsieve::ParamType::Enum, !p.enumerators.empty()) << p.name.view();
        if (p.type != lightsieve::ParamType::Enum || p.is_array) continue;
        std::int32_t value = -1;
        std::memcpy(&value, type().default_block.data() + p.offset, sizeof(value));
        EXPECT_TRUE(value >= 0 && static_cast<std::size_t>(value) < p.enumerators.size())
            << p.name.view();
    }
}

TEST_P(EveryNode, HasDefaultsWithinItsRanges) {
    for (const ParamInfo& p : type().params) {
        if (p.is_array || p.type != lightsieve::ParamType::Float || !p.low) continue;
        float value = 0;
        std::memcpy(&value, type().default_block.data() + p.offset, sizeof(value));
        EXPECT_TRUE(value >= *p.low && value <= *p.high) << p.name.view();
    }
}

TEST_P(EveryNode, HasTheFunctionsOfItsKind) {
    const NodeType& t = type();
    EXPECT_EQ(t.kind == NodeKind::Camera, t.make_camera != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Shape, t.make_geometry != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Shape, t.shape_common != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Light, t.make_light != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Light, t.light_common != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Filter, t.make_filter != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Driver, t.make_driver != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Imager, t.make_imager != nullptr);
    EXPECT_EQ(t.kind == NodeKind::LightFilter, t.make_light_filter != nullptr);
    const bool evaluates = t.eval_closure != nullptr || t.eval_value != nullptr ||
                           t.eval_text != nullptr || t.eval_matrix != nullptr;
    EXPECT_EQ(t.kind == NodeKind::Shader, evaluates);
    EXPECT_EQ(t.output == OutputType::String, t.possible_texts != nullptr);
    EXPECT_EQ(t.kind == NodeKind::Shader, t.output != OutputType::None);
    if (t.kind == NodeKind::Shader) {
        EXPECT_LE(t.block_size, 2048U);
    }
    for (std::size_t i = 0; i < t.lobes.size(); ++i)
        EXPECT_EQ(t.lobes[i].index, static_cast<int>(i));
}

/// Half of the numbers of a block at random, within [0,1].
void shake(TestNode& node, std::mt19937& engine) {
    const auto unit = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24F; };
    auto* block = static_cast<std::byte*>(node.block());
    for (const ParamInfo& p : node.type().params) {
        const bool numbers =
            p.type == ParamType::Float || p.type == ParamType::Rgb || p.type == ParamType::Vector2;
        if (p.is_array || !numbers || engine() % 2 == 0) continue;
        for (std::size_t i = 0; i < type_size(p.type); i += sizeof(float)) {
            const float value = unit();
            std::memcpy(block + p.offset + i, &value, sizeof(value));
        }
    }
}

/// What a shader makes of a point, seen toward `wi`: the value and weight of each closure.
std::vector<Color> closures_toward(const TestNode& node, const ShadePoint& at, Vec3f wi) {
    const std::vector<LobeRecord> records(node.type().lobes.size());
    ClosureSet set;
    set.begin(at.wo, Frame::from_z(at.normal));
    set.set_records(records);
    node.type().eval_closure(node.block(), at, set);
    std::vector<Color> out{set.transparency()};
    for (std::size_t i = 0; i < set.closures().size(); ++i) {
        out.push_back(set.closures()[i].weight);
        out.push_back(set.eval(i, wi).f);
    }
    return out;
}

TEST_P(EveryNode, LooksAtNoCoordinatesIfItSaysSo) {
    if (type().reads_coordinates == nullptr) return;
    std::mt19937 engine(5);
    for (int i = 0; i < 200; ++i) {
        TestNode node(type());
        shake(node, engine);
        if (type().reads_coordinates(node.block())) continue;
        ShadePoint at;
        at.wo = normalize(Vec3f{0.3F, -0.2F, 0.8F});
        ShadePoint elsewhere = at;
        elsewhere.uv = {0.3F, 0.7F};
        elsewhere.uv_width = 0.1F;
        elsewhere.tangent = normalize(Vec3f{0.6F, 0.8F, 0});
        elsewhere.dp_du = {0, 2, 0};
        elsewhere.dp_dv = {-3, 0, 0};
        const Vec3f wi = normalize(Vec3f{-0.5F, 0.1F, i % 2 == 0 ? 0.4F : -0.4F});
        ASSERT_EQ(closures_toward(node, at, wi), closures_toward(node, elsewhere, wi));
    }
}

INSTANTIATE_TEST_SUITE_P(Nodes, EveryNode, testing::ValuesIn(builtin_registry().names()));

TEST(NodeDefaults, AreThoseMeasured) {
    struct Row {
        const char* node;
        const char* param;
        double value;
    };
    const std::vector<Row> rows{
        {"options", "AA_samples", 1},
        {"options", "GI_diffuse_depth", 0},
        {"options", "GI_specular_depth", 0},
        {"options", "GI_transmission_depth", 2},
        {"options", "GI_volume_depth", 0},
        {"options", "GI_total_depth", 10},
        {"options", "auto_transparency_depth", 10},
        {"options", "indirect_sample_clamp", 10},
        {"options", "xres", 320},
        {"options", "yres", 240},
        {"options", "pixel_aspect_ratio", 1},
        {"options", "bucket_size", 64},
        {"options", "AA_seed", 1},
        {"options", "abort_on_error", 1},
        {"persp_camera", "near_clip", 1e-4F},
        {"persp_camera", "exposure", 0},
        {"polymesh", "smoothing", 0},
        {"polymesh", "visibility", 255},
        {"polymesh", "sidedness", 255},
        {"sphere", "radius", 0.5},
        {"ginstance", "inherit_xform", 1},
        {"standard_surface", "base", 1},
        {"standard_surface", "specular", 1},
        {"standard_surface", "specular_roughness", 0.2F},
        {"standard_surface", "specular_IOR", 1.5},
        {"standard_surface", "coat_roughness", 0.1F},
        {"standard_surface", "sheen_roughness", 0.3F},
        {"standard_surface", "caustics", 0},
        {"standard_surface", "internal_reflections", 1},
        {"lambert", "Kd", 0.7F},
        {"checkerboard", "u_frequency", 1},
        {"utility", "shade_mode", 0},
        {"utility", "color_mode", 0},
    };
    for (const Row& row : rows) {
        const NodeType& type = *builtin_registry().find(row.node);
        const ParamInfo* p = type.find(row.param);
        ASSERT_NE(p, nullptr) << row.node << "." << row.param;
        const std::byte* at = type.default_block.data() + p->offset;
        double value = -1;
        if (p->type == ParamType::Float)
            value = static_cast<double>(*reinterpret_cast<const float*>(at));
        if (p->type == ParamType::Int || p->type == ParamType::Enum)
            value = *reinterpret_cast<const std::int32_t*>(at);
        if (p->type == ParamType::Bool || p->type == ParamType::Byte)
            value = static_cast<double>(std::to_integer<int>(*at));
        EXPECT_EQ(value, row.value) << row.node << "." << row.param;
    }
}

TEST(NodeDefaults, BaseColorIsLightGrey) {
    const TestNode node(*builtin_registry().find("standard_surface"));
    EXPECT_EQ(node.get<Color>("base_color"), (Color{0.8F, 0.8F, 0.8F}));
    EXPECT_EQ(TestNode(*builtin_registry().find("persp_camera")).get<Array<float>>("fov")[0], 60);
}

}  // namespace
}  // namespace lightsieve
