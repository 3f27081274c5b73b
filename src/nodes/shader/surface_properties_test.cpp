// What holds for every shader that scatters, taken from the registry: parameters act, no light is made, lobes agree with
// themselves. A new surface or closure is tested the day it exists.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "bsdf/closure.h"
#include "nodes/all_nodes.h"
#include "nodes/common/node_test_support.h"

namespace lightsieve {
namespace {

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float unit() { return static_cast<float>(engine_() >> 8) * 0x1p-24F; }
    Color color() {
        const float r = unit(), g = unit();
        return {r, g, unit()};
    }
    Vec3f direction() {
        const float x = unit() - 0.5F, y = unit() - 0.5F;
        return normalize({x, y, unit() + 0.5F}, {0, 0, 1});
    }

  private:
    std::mt19937 engine_;
};

bool scatters(const NodeType& type) {
    if (type.eval_closure == nullptr) return false;
    for (const ParamInfo& p : type.params)
        if (p.type == ParamType::Closure) return false;  // only combines others
    for (const LobeInfo& lobe : type.lobes)
        if (lobe.kind == EventKind::Reflection || lobe.kind == EventKind::Transmission)
            return true;
    return false;
}

std::vector<NodeType> scattering_types() {
    std::vector<NodeType> out;
    for (const NodeType* type : builtin_registry().all())
        if (scatters(*type)) out.push_back(*type);
    return out;
}

/// A value for a parameter, within what makes sense: weights and colours 0..1, indices of refraction 1..2.5.
void draw(TestNode& node, const ParamInfo& p, Random& random) {
    const std::string name = p.name.str();
    const bool ior = name.ends_with("IOR") || name.ends_with("ior");
    switch (p.type) {
        case ParamType::Bool: node.set(name.c_str(), random.unit() > 0.5F); break;
        case ParamType::Float:
            node.set(name.c_str(), random.unit() * (ior ? 1.5F : 1) + (ior ? 1.0F : 0.0F));
            break;
        case ParamType::Rgb:
            node.set(name.c_str(), random.unit() < 0.1F ? kBlack : random.color());
            break;
        case ParamType::Vector: node.set(name.c_str(), random.direction()); break;
        case ParamType::Vector2: {
            const float x = random.unit();
            node.set(name.c_str(), Vec2f{x, random.unit()});
            break;
        }
        case ParamType::Int:
            node.set(name.c_str(), static_cast<std::int32_t>(1000 * random.unit()));
            break;
        case ParamType::Enum:
            node.set_enum(name.c_str(),
                          static_cast<std::int32_t>(random.unit() * 0.999F *
                                                    static_cast<float>(p.enumerators.size())));
            break;
        default: break;
    }
}

void draw_all(TestNode& node, Random& random) {
    for (const ParamInfo& p : node.type().params)
        if (!p.ignored) draw(node, p, random);
}

struct View {
    float cosine;
    bool entering, on_curve, monochromatic;
};

ShadePoint point(const View& view) {
    ShadePoint at;
    at.wo = {safe_sqrt(1 - view.cosine * view.cosine), 0, view.cosine};
    at.geometric_normal = view.entering ? Vec3f{0, 0, 1} : Vec3f{0, 0, -1};
    at.entering = view.entering;
    at.on_curve = view.on_curve;
    at.curve_offset = 0.3F;
    at.uv = at.curve_uv = {0.5F, 0.4F};
    at.face = 3;
    at.wavelength = 450;
    at.monochromatic = view.monochromatic;
    return at;
}

struct Shaded {
    Shaded(const TestNode& node, const View& view) : records(node.type().lobes.size()) {
        for (std::size_t i = 0; i < records.size(); ++i) {
            records[i].kind = node.type().lobes[i].kind;
            records[i].lobe = node.type().lobes[i].lobe;
        }
        const ShadePoint at = point(view);
        set.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
        set.set_records(records);
        node.type().eval_closure(node.block(), at, set);
    }
    std::vector<LobeRecord> records;
    ClosureSet set;
};

/// Everything that the renderer can learn of a hit, as numbers.
std::vector<float> fingerprint(const TestNode& node) {
    std::vector<float> out;
    const auto put = [&](Color c) { out.insert(out.end(), {c.r, c.g, c.b}); };
    for (const View view : {View{0.8F, true, false, false}, View{0.7F, false, false, true},
                            View{0.6F, true, true, false}}) {
        const Shaded s(node, view);
        put(s.set.transparency());
        put(s.set.shadow_transmission());
        put(s.set.matte());
        const Medium& inside = s.set.interior().medium;
        put(inside.extinction);
        put(inside.scattering);
        out.push_back(inside.phase.anisotropy);
        out.push_back(s.set.interior().ior);
        out.push_back(static_cast<float>(s.set.interior().priority));
        out.push_back(s.set.disperses() ? 1.0F : 0.0F);
        for (const Emission& e : s.set.emissions())
            put(e.radiance);
        for (const SubsurfaceClosure& below : s.set.subsurfaces()) {
            put(below.weight);
            put(below.medium.reflectance);
            put(below.medium.mean_free_path);
            out.push_back(below.medium.anisotropy);
            out.push_back(below.indirect);
        }
        if (const ShadowMatte* m = s.set.shadow_matte()) {
            put(m->background);
            put(m->shadow_color);
            put(m->diffuse);
            out.insert(out.end(), {m->opacity, m->backlighting, m->alpha_is_mask ? 1.0F : 0.0F,
                                   m->sees_background ? 1.0F : 0.0F});
        }
        for (std::size_t i = 0; i < s.set.closures().size(); ++i) {
            const Closure& c = s.set.closures()[i];
            put(c.weight);
            out.insert(out.end(), {c.caustics ? 1.0F : 0.0F, c.indirect});
            put(s.set.albedo(i));
            const LobeSample sample = s.set.sample(i, {0.3F, 0.6F}, 0.4F);
            put(sample.f);
            out.insert(out.end(), {sample.wi.x, sample.wi.y, sample.wi.z, sample.pdf});
        }
    }
    return out;
}

/// Parameters that the renderer reads itself, or that act on what only a scene has; their tests are in render/.
const std::set<std::string> kReadByRenderer{"transmit_aovs",
                                            "transmission_transmit_aovs",
                                            "exit_to_background",
                                            "extra_depth",
                                            "overlay_mode",
                                            "ao_distance",
                                            "id1",
                                            "id2",
                                            "id3",
                                            "id4",
                                            "id5",
                                            "id6",
                                            "id7",
                                            "id8"};

TEST(SurfaceProperties, EveryParameterActs) {
    constexpr int kTries = 60;
    for (const NodeType& type : scattering_types()) {
        for (const ParamInfo& p : type.params) {
            if (p.ignored || p.pending || p.is_array || p.type == ParamType::String ||
                p.type == ParamType::Node || kReadByRenderer.contains(p.name.str()))
                continue;
            Random random(7);
            bool acts = false;
            for (int i = 0; i < kTries && !acts; ++i) {
                TestNode node(type);
                // Often the defaults but for a few, so that what only a corner of the model reads has its chance.
                for (const ParamInfo& other : type.params)
                    if (!other.ignored && random.unit() < (i % 2 == 0 ? 1.0F : 0.5F))
                        draw(node, other, random);
                const std::vector<float> before = fingerprint(node);
                draw(node, p, random);
                acts = fingerprint(node) != before;
            }
            EXPECT_TRUE(acts) << type.name.str() << "." << p.name.str();
        }
    }
}

/// Shaders whose weights are the user's: they may add up to more than 1, as they do in Arnold.
const std::set<std::string> kMayGain{"standard", "hair", "shadow_matte", "skin", "toon"};
/// Tables of albedos are good to 1e-3; stretched lobes are estimated (ggx_compensation.h).
constexpr float kGain = 1.006F;

TEST(SurfaceProperties, NoLightFromNothing) {
    for (const NodeType& type : scattering_types()) {
        if (kMayGain.contains(type.name.str())) continue;
        Random random(11);
        for (int k = 0; k <= 20; ++k) {
            TestNode node(type);
            if (k > 0) draw_all(node, random);
            for (const float cosine : {1.0F, 0.6F, 0.2F, 0.05F})
                for (const bool entering : {true, false})
                    for (const bool curve : {false, true}) {
                        const Shaded s(node, {cosine, entering, curve, false});
                        Color total = s.set.transparency();
                        for (std::size_t i = 0; i < s.set.closures().size(); ++i)
                            total += s.set.albedo(i);
                        for (const SubsurfaceClosure& below : s.set.subsurfaces())
                            total += below.albedo();
                        EXPECT_LE(max_component(total), kGain)
                            << type.name.str() << " set " << k << " cos " << cosine << " entering "
                            << entering << " curve " << curve;
                    }
        }
    }
}

TEST(SurfaceProperties, LayersKnowTheAlbedoOfTheirOwnLobe) {
    int n_known = 0;
    for (const NodeType& type : scattering_types()) {
        Random random(17);
        for (int k = 0; k <= 20; ++k) {
            TestNode node(type);
            if (k > 0) draw_all(node, random);
            const Shaded s(node, {0.4F, k % 3 != 0, k % 2 != 0, false});
            for (const Closure& c : s.set.closures()) {
                if (!c.albedo) continue;
                ++n_known;
                const Vec3f wo = s.set.local_wo(c.frame);
                EXPECT_EQ(*c.albedo,
                          std::visit([&](const auto& m) { return m.albedo(wo); }, c.model))
                    << type.name.str() << " set " << k;
            }
        }
    }
    EXPECT_GT(n_known, 100);
}

TEST(SurfaceProperties, LobesReturnWhatTheySample) {
    for (const NodeType& type : scattering_types()) {
        Random random(13);
        for (int k = 0; k <= 20; ++k) {
            TestNode node(type);
            if (k > 0) draw_all(node, random);
            const Shaded s(node, {0.7F, k % 3 != 0, k % 2 != 0, false});
            for (std::size_t i = 0; i < s.set.closures().size(); ++i)
                for (int n = 0; n < 20; ++n) {
                    const Vec2f u{random.unit(), random.unit()};
                    const LobeSample sample = s.set.sample(i, u, random.unit());
                    if (!(sample.pdf > 0) || s.set.delta(i)) continue;
                    const LobeEval e = s.set.eval(i, sample.wi);
                    EXPECT_NEAR(e.pdf / sample.pdf, 1, 2e-2F) << type.name.str() << " set " << k;
                    for (int c = 0; c < 3; ++c)
                        EXPECT_NEAR(e.f[c], sample.f[c], 2e-2F * sample.f[c] + 1e-5F)
                            << type.name.str() << " set " << k;
                }
        }
    }
}

}  // namespace
}  // namespace lightsieve
