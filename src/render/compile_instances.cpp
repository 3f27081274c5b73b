// Follows instances and instancers to the shapes that they place. See shape_leaf.h.
//
// The bottom level of the ray structure knows one level of instances, so nested ones are flattened here: geometry is
// shared, and an instance is a matrix and a few numbers.
#include <fmt/format.h>

#include <algorithm>

#include "render/compiler.h"
#include "render/turning.h"
#include "scene/assemble.h"

namespace lightsieve {
namespace {

/// Instances of instances of ...
constexpr int kMaxInstanceDepth = 64;
/// Shapes in the world after flattening, about 500 bytes each. Nesting makes more out of a short file than any machine holds.
constexpr std::uint64_t kMaxLeaves = std::uint64_t{1} << 25U;
constexpr std::string_view kByInstance = "instance_";

Shutter shutter_of(const RenderSettings& s) { return {s.shutter_start, s.shutter_end}; }

std::vector<Mat4f> resampled(std::span<const Mat4f> keys, MotionRange range, Shutter shutter) {
    return keys_over_shutter<Mat4f>(
        keys, range, shutter,
        [](const Mat4f& a, const Mat4f& b, float t) { return lerp(a, b, t); });
}

/// Placement over the shutter. `center`: what TransformType::RotateAboutCenter turns about, object space.
std::vector<Mat4f> matrices_over_shutter(const ShapeCommon& common, Shutter shutter,
                                         Vec3f center) {
    if (common.matrix.empty() || common.matrix.n == 0) return {Mat4f{}};
    // A matrix array of n elements and one key means n keys, too: that is how they are written.
    const std::size_t n = std::size_t{common.matrix.n} * common.matrix.n_keys;
    const std::vector<Mat4f> keys =
        turning_keys(std::span<const Mat4f>(common.matrix.data, n), common.transform_type, center);
    return resampled(keys, {common.motion_start, common.motion_end}, shutter);
}

bool turns_about_center(const ShapeCommon& common) {
    return std::size_t{common.matrix.n} * common.matrix.n_keys > 1 &&
           common.transform_type == TransformType::RotateAboutCenter;
}

/// The middle of a geometry's bounds at the first key, object space; radii do not count.
Vec3f center_of(const ShapeGeometry& geometry) {
    Box3f box;
    const auto grow = [&](const std::vector<std::vector<Vec3f>>& keys) {
        if (keys.empty()) return;
        for (const Vec3f p : keys[0])
            box.grow(p);
    };
    if (const auto* mesh = std::get_if<TriangleMesh>(&geometry.data)) grow(mesh->positions);
    if (const auto* spheres = std::get_if<SphereList>(&geometry.data)) grow(spheres->centers);
    if (const auto* curves = std::get_if<CurveList>(&geometry.data)) grow(curves->points);
    if (const auto* points = std::get_if<PointList>(&geometry.data)) grow(points->centers);
    if (const auto* shape = std::get_if<SimpleShape>(&geometry.data)) {
        box.grow(shape->base);
        if (shape->kind == SimpleShape::Kind::Mantle)
            box.grow(shape->base + shape->axis * shape->height);
    }
    return box.empty() ? Vec3f{} : box.center();
}

/// Placement of what leaves to the world pass through, around a leaf as it is placed inside.
std::vector<Mat4f> matrices_around(const ShapeLeaf& leaf, const ShapeCommon& common,
                                   Shutter shutter) {
    const Vec3f center =
        turns_about_center(common) ? leaf.placement[0].point(center_of(*leaf.geometry)) : Vec3f{};
    return matrices_over_shutter(common, shutter, center);
}

/// outer applied after inner, key by key.
std::vector<Mat4f> compose(const std::vector<Mat4f>& inner, const std::vector<Mat4f>& outer) {
    const std::size_t n = std::max(inner.size(), outer.size());
    const auto at = [n](const std::vector<Mat4f>& keys, std::size_t i) {
        if (keys.size() == 1) return keys[0];
        const float x = n > 1 ? static_cast<float>(i) / static_cast<float>(n - 1) *
                                    static_cast<float>(keys.size() - 1)
                              : 0;
        const std::size_t k = std::min(static_cast<std::size_t>(x), keys.size() - 2);
        return lerp(keys[k], keys[k + 1], x - static_cast<float>(k));
    };
    std::vector<Mat4f> out;
    out.reserve(n);
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(at(inner, i) * at(outer, i));
    return out;
}

/// Writes a node's values over those of what it places. `counts(param)` says which of them hold.
template <class Counts>
void override_values(ShapeLeaf& leaf, const ShapeCommon& common, const Counts& counts) {
    if (counts("shader")) leaf.shaders = common.shader;
    if (counts("sidedness")) leaf.sidedness = common.sidedness;
    if (counts("matte")) leaf.matte = common.matte;
    if (counts("invert_normals")) leaf.invert_normals = common.invert_normals;
    if (counts("receive_shadows")) leaf.receive_shadows = common.receive_shadows;
    if (counts("self_shadows")) leaf.self_shadows = common.self_shadows;
    if (counts("id")) leaf.id = common.id;
    if (counts("step_size")) leaf.step_size = common.step_size;
    if (counts("use_light_group")) {
        leaf.use_light_group = common.use_light_group;
        leaf.light_group = common.light_group;
    }
    if (counts("use_shadow_group")) {
        leaf.use_shadow_group = common.use_shadow_group;
        leaf.shadow_group = common.shadow_group;
    }
}

/// What an instancer says of one instance.
void override_by_instance(ShapeLeaf& leaf, const InstanceList& list, std::uint32_t i) {
    const auto set = [&](auto& value, const auto& array) { value = list.value(array, i, value); };
    if (!list.instance_shader.empty()) {
        const std::uint32_t k = std::min(i, list.instance_shader.n - 1);
        if (list.instance_shader[k]) leaf.shaders = {&list.instance_shader[k], 1, 1};
    }
    leaf.visibility &= list.value(list.instance_visibility, i, std::uint8_t{255});
    set(leaf.sidedness, list.instance_sidedness);
    set(leaf.matte, list.instance_matte);
    set(leaf.invert_normals, list.instance_invert_normals);
    set(leaf.receive_shadows, list.instance_receive_shadows);
    set(leaf.self_shadows, list.instance_self_shadows);
    set(leaf.id, list.instance_id);
    set(leaf.use_light_group, list.instance_use_light_group);
    set(leaf.use_shadow_group, list.instance_use_shadow_group);
    if (!list.instance_light_group.empty()) leaf.light_group = list.instance_light_group;
    if (!list.instance_shadow_group.empty()) leaf.shadow_group = list.instance_shadow_group;
}

/// The instance's matrix with its keys over the shutter.
std::vector<Mat4f> instance_placement(const InstanceList& list, std::uint32_t i,
                                      const ShapeCommon& common, Shutter shutter) {
    const Array<Mat4f>& all = list.instance_matrix;
    const std::uint32_t k = std::min(i, all.n - 1);
    if (all.n_keys == 1) return {all[k]};
    std::vector<Mat4f> keys;
    for (std::uint32_t key = 0; key < all.n_keys; ++key)
        keys.push_back(all.key(key)[k]);
    return resampled(keys,
                     {list.value(list.instance_motion_start, i, common.motion_start),
                      list.value(list.instance_motion_end, i, common.motion_end)},
                     shutter);
}

/// How many numbers of SceneObject::instance a lineage takes.
std::uint64_t numbers_of(const Lineage& lineage) {
    return std::max<std::uint64_t>(1, lineage.back().n * lineage.back().stride);
}

}  // namespace

const Lineage* Compiler::extend(const Lineage* lineage, const NodeInstance& node,
                                std::uint32_t n_instances) {
    LineageStep step;
    step.node = &node;
    step.n = n_instances;
    if (lineage != nullptr) step.stride = numbers_of(*lineage);
    if (n_instances > 1)
        for (const UserData& data : node.user_data())
            if (data.name.view().starts_with(kByInstance) &&
                data.user_class == UserDataClass::Constant && data.n > 0 && data.data != nullptr)
                step.by_instance.emplace_back(data.name.view().substr(kByInstance.size()), &data);
    Lineage& out = scene_->lineages.emplace_back();
    if (lineage != nullptr) out = *lineage;
    out.push_back(std::move(step));
    return &out;
}

void Compiler::find_leaves(const NodeInstance& node, const LeafUse& use, const LeafSink& sink) {
    if (use.depth > kMaxInstanceDepth)
        return diagnostics_.error(Code::CyclicLink,
                                  "instances refer to each other more than " +
                                      std::to_string(kMaxInstanceDepth) + " deep",
                                  node.where("node"));
    // What a procedural holds may place the procedural again.
    if (std::find(open_shapes_.begin(), open_shapes_.end(), &node) != open_shapes_.end())
        return diagnostics_.error(Code::CyclicLink,
                                  fmt::format("\"{}\" holds itself", node.name().view()),
                                  node.where(), "take one of the instances out");
    open_shapes_.push_back(&node);
    leaves_of(node, use, sink);
    open_shapes_.pop_back();
}

void Compiler::leaves_of(const NodeInstance& node, const LeafUse& use, const LeafSink& sink) {
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (!use.as_source && common.visibility == 0) return;
    if (const NodeScope* inside = graph_.contents(node); inside != nullptr)
        return leaves_of_procedural(node, *inside, use, sink);
    const ShapeGeometry* geometry = shared_geometry(node);
    if (geometry == nullptr) return;
    if (geometry->instances != nullptr) return leaves_of_instancer(node, *geometry, use, sink);
    if (geometry->instance_of) return leaves_of_instance(node, *geometry, use, sink);
    ShapeLeaf leaf;
    leaf.shape = leaf.outermost = &node;
    leaf.geometry = geometry;
    leaf.placement = {Mat4f{}};
    if (use.with_matrix)
        leaf.placement = matrices_around(leaf, common, shutter_of(scene_->settings));
    leaf.lineage = extend(nullptr, node, 1);
    override_values(leaf, common, [](const char*) { return true; });
    if (!use.as_source) leaf.visibility = common.visibility;
    leaf.label = object_label_of(node);
    leaf.name = node.name();
    sink(std::move(leaf));
}

/// The shape that an instance names; null with an error reported if it is none.
const NodeInstance* Compiler::placed_shape(const NodeInstance& by, const NodeRef& ref,
                                           const char* param) {
    if (ref.node->type().shape_common != nullptr) return ref.node;
    diagnostics_.error(
        Code::LinkType,
        "\"" + ref.node->name().str() + "\" is a " + ref.node->type().name.str() + ", not a shape",
        by.where(param));
    return nullptr;
}

void Compiler::leaves_of_instance(const NodeInstance& node, const ShapeGeometry& geometry,
                                  const LeafUse& use, const LeafSink& sink) {
    const NodeInstance* source = placed_shape(node, geometry.instance_of, "node");
    if (source == nullptr) return;
    const ShapeCommon& common = *node.type().shape_common(node.block());
    const Shutter shutter = shutter_of(scene_->settings);
    const Name label = object_label_of(node);
    std::map<const Lineage*, const Lineage*> lineages;
    find_leaves(*source, {true, geometry.inherit_xform, use.depth + 1}, [&](ShapeLeaf&& leaf) {
        if (use.with_matrix)
            leaf.placement = compose(leaf.placement, matrices_around(leaf, common, shutter));
        const Lineage*& lineage = lineages[leaf.lineage];
        if (lineage == nullptr) lineage = extend(leaf.lineage, node, 1);
        leaf.lineage = lineage;
        // What an instance does not write it takes from its source, but for its own visibility.
        override_values(leaf, common, [&](const char* param) { return node.is_set(param); });
        if (!use.as_source) leaf.visibility &= common.visibility;
        if (!label.empty()) leaf.label = label;
        leaf.name = node.name();
        leaf.outermost = &node;
        sink(std::move(leaf));
    });
}

void Compiler::leaves_of_procedural(const NodeInstance& node, const NodeScope& inside,
                                    const LeafUse& use, const LeafSink& sink) {
    const ShapeCommon& common = *node.type().shape_common(node.block());
    const Shutter shutter = shutter_of(scene_->settings);
    const Name label = object_label_of(node);
    const std::string prefix = scope_prefix(node);
    const bool all = node.get<bool>("override_nodes");
    const auto counts = [&](std::string_view param) {
        if (!node.is_set(param)) return false;
        if (param == "shader") return !common.shader.empty() && common.shader[0];
        // Exporters write defaults, too; sidedness is restricted below.
        return all || (!node.has_default(param) && param != "sidedness");
    };
    std::map<const Lineage*, const Lineage*> lineages;
    const auto pass = [&](ShapeLeaf&& leaf) {
        if (use.with_matrix)
            leaf.placement = compose(leaf.placement, matrices_around(leaf, common, shutter));
        const Lineage*& lineage = lineages[leaf.lineage];
        if (lineage == nullptr) lineage = extend(leaf.lineage, node, 1);
        leaf.lineage = lineage;
        override_values(leaf, common, counts);
        if (!all) leaf.sidedness &= common.sidedness;
        if (all && node.is_set("visibility"))
            leaf.visibility = common.visibility;
        else if (!use.as_source)
            leaf.visibility &= common.visibility;
        if (!label.empty()) leaf.label = label;
        leaf.name = prefix + leaf.name.str();
        sink(std::move(leaf));
    };
    for (const auto& shape : inside.nodes)
        if (shape->kind() == NodeKind::Shape && shape->type().shape_common != nullptr)
            find_leaves(*shape, {false, true, use.depth + 1}, pass);
}

/// The leaves of one of an instancer's nodes, ready to be copied for each instance.
std::vector<ShapeLeaf> Compiler::leaves_for_instances(const NodeInstance& node, const NodeRef& ref,
                                                      std::uint32_t n, const LeafUse& use) {
    std::vector<ShapeLeaf> out;
    const NodeInstance* source = ref ? placed_shape(node, ref, "nodes") : nullptr;
    if (source == nullptr) return out;
    const ShapeCommon& common = *node.type().shape_common(node.block());
    const Name label = object_label_of(node);
    std::map<const Lineage*, const Lineage*> lineages;
    find_leaves(*source, use, [&](ShapeLeaf&& leaf) {
        const Lineage*& lineage = lineages[leaf.lineage];
        if (lineage == nullptr) lineage = extend(leaf.lineage, node, n);
        leaf.lineage = lineage;
        override_values(leaf, common, [&](const char* param) {
            return node.is_set(param) && !node.has_default(param);
        });
        if (!label.empty()) leaf.label = label;
        leaf.name = node.name();
        leaf.outermost = &node;
        out.push_back(std::move(leaf));
    });
    return out;
}

void Compiler::leaves_of_instancer(const NodeInstance& node, const ShapeGeometry& geometry,
                                   const LeafUse& use, const LeafSink& sink) {
    const InstanceList& list = *geometry.instances;
    const Shutter shutter = shutter_of(scene_->settings);
    const ShapeCommon& common = *node.type().shape_common(node.block());
    // Where it turns about the middle of what it places, that is another one for each.
    const bool turns = use.with_matrix && turns_about_center(common);
    const std::vector<Mat4f> own = use.with_matrix && !turns
                                       ? matrices_over_shutter(common, shutter, {})
                                       : std::vector<Mat4f>{Mat4f{}};
    const std::uint32_t n = list.size();
    // Leaves by node, with and without its own matrix.
    std::map<std::pair<std::uint32_t, bool>, std::vector<ShapeLeaf>> templates;
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t source = list.value(list.node_idxs, i, 0U);
        if (source >= list.nodes.n) continue;
        const bool inherit = list.value(list.instance_inherit_xform, i, false);
        const auto [known, added] = templates.try_emplace({source, inherit});
        if (added)
            known->second =
                leaves_for_instances(node, list.nodes[source], n, {true, inherit, use.depth + 1});
        if (known->second.empty()) continue;
        const std::vector<Mat4f> place =
            compose(instance_placement(list, i, common, shutter), own);
        for (const ShapeLeaf& leaf : known->second) {
            ShapeLeaf copy = leaf;
            copy.placement = compose(leaf.placement, place);
            if (turns)
                copy.placement = compose(copy.placement, matrices_around(copy, common, shutter));
            copy.instance += i * leaf.lineage->back().stride;
            override_by_instance(copy, list, i);
            if (!use.as_source) copy.visibility &= common.visibility;
            sink(std::move(copy));
        }
    }
}

/// What a node places directly, each source once; nothing for a leaf.
std::vector<Compiler::PlacedSource> Compiler::sources_of(const NodeInstance& node) {
    std::vector<PlacedSource> out;
    const auto add = [&](const NodeInstance* placed, bool as_source, std::uint64_t times) {
        if (placed == nullptr || placed->type().shape_common == nullptr) return;
        if (!as_source && placed->type().shape_common(placed->block())->visibility == 0) return;
        out.push_back({placed, times});
    };
    if (const NodeScope* inside = graph_.contents(node); inside != nullptr) {
        for (const auto& shape : inside->nodes)
            if (shape->kind() == NodeKind::Shape) add(shape.get(), false, 1);
    } else if (const ShapeGeometry* geometry = shared_geometry(node); geometry == nullptr) {
        return out;
    } else if (const InstanceList* list = geometry->instances; list != nullptr) {
        std::vector<std::uint64_t> times(list->nodes.n);
        for (std::uint32_t i = 0; i < list->size(); ++i) {
            const std::uint32_t source = list->value(list->node_idxs, i, 0U);
            if (source < list->nodes.n) ++times[source];
        }
        for (std::uint32_t i = 0; i < list->nodes.n; ++i)
            if (times[i] > 0) add(list->nodes[i].node, true, times[i]);
    } else if (geometry->instance_of) {
        add(geometry->instance_of.node, true, 1);
    }
    return out;
}

/// Whether a node is geometry itself and places no other.
bool Compiler::is_leaf(const NodeInstance& node) {
    if (graph_.contents(node) != nullptr) return false;
    const ShapeGeometry* geometry = shared_geometry(node);
    return geometry != nullptr && geometry->instances == nullptr && !geometry->instance_of;
}

/// How many leaves find_leaves would give, before any is made. What places itself counts as nothing here. Not recursive:
/// chains of instances may be longer than the stack.
std::uint64_t Compiler::count_leaves(const NodeInstance& node) {
    if (node.type().shape_common(node.block())->visibility == 0) return 0;
    struct Open {
        const NodeInstance* node;
        bool expanded = false;
    };
    std::vector<Open> open{{&node}};
    while (!open.empty()) {
        const NodeInstance& top = *open.back().node;
        if (!open.back().expanded) {
            open.back().expanded = true;
            if (!leaf_counts_.try_emplace(&top, 0).second) {
                open.pop_back();
                continue;
            }
            for (const PlacedSource& source : sources_of(top))
                open.push_back({source.node});
            continue;
        }
        std::uint64_t count = is_leaf(top) ? 1 : 0;
        // Saturating: nothing counts further than past the limit.
        for (const PlacedSource& source : sources_of(top))
            count = std::min(count + source.times * leaf_counts_[source.node], kMaxLeaves + 1);
        leaf_counts_[&top] = count;
        open.pop_back();
    }
    return leaf_counts_[&node];
}

/// Places a node of the scene itself with all that it holds.
void Compiler::place_all(const NodeInstance& node) {
    n_leaves_ += count_leaves(node);
    if (n_leaves_ > kMaxLeaves) {
        n_leaves_ = 0;  // what comes after it may be placed
        return diagnostics_.error(
            Code::LimitInstances,
            fmt::format("with \"{}\" and what it places there are more than {} shapes",
                        node.name().view(), kMaxLeaves),
            node.where(), "nest instances less deep, or place fewer");
    }
    find_leaves(node, {}, [this](ShapeLeaf&& leaf) { place(std::move(leaf)); });
}

}  // namespace lightsieve
