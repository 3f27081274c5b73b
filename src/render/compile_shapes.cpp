// Shapes and instances to placed geometry. See compiler.h.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "render/compiler.h"
#include "render/shade_services.h"
#include "render/turning.h"

namespace lightsieve {
namespace {

/// Instances of instances of ...
constexpr int kMaxInstanceDepth = 64;

Vec3f blend_points(const Vec3f& a, const Vec3f& b, float t) { return a * (1 - t) + b * t; }

/// FNV-1a: ids of shapes without one are a stable function of their names.
std::uint32_t hash_name(std::string_view name) {
    std::uint32_t h = 2166136261U;
    for (const char c : name)
        h = (h ^ static_cast<unsigned char>(c)) * 16777619U;
    return h;
}

Shutter shutter_of(const RenderSettings& s) { return {s.shutter_start, s.shutter_end}; }

/// Placement over the shutter. `center`: what TransformType::RotateAboutCenter turns about, object space.
std::vector<Mat4f> matrices_over_shutter(const ShapeCommon& common, Shutter shutter,
                                         Vec3f center) {
    if (common.matrix.empty() || common.matrix.n == 0) return {Mat4f{}};
    // A matrix array of n elements and one key means n keys, too: that is how they are written.
    const std::size_t n = std::size_t{common.matrix.n} * common.matrix.n_keys;
    const std::vector<Mat4f> keys =
        turning_keys(std::span<const Mat4f>(common.matrix.data, n), common.transform_type, center);
    return keys_over_shutter<Mat4f>(
        keys, {common.motion_start, common.motion_end}, shutter,
        [](const Mat4f& a, const Mat4f& b, float t) { return lerp(a, b, t); });
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
    for (std::size_t i = 0; i < n; ++i)
        out.push_back(at(inner, i) * at(outer, i));
    return out;
}

bool shows_nothing(const TriangleMesh& g) { return g.indices.empty() || g.positions.empty(); }
bool shows_nothing(const SphereList& g) { return g.radii.empty() || g.centers.empty(); }
bool shows_nothing(const CurveList& g) { return g.segments.empty(); }
bool shows_nothing(const PointList& g) { return g.index.empty(); }
bool shows_nothing(const SimpleShape& /*g*/) { return false; }

std::vector<float> blend_numbers(const std::vector<float>& a, const std::vector<float>& b,
                                 float t) {
    std::vector<float> out(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        out[i] = std::lerp(a[i], b[i], t);
    return out;
}

/// What options say about subdivision.
struct FinenessLimits {
    bool none = false;  ///< ignore_subdivision
    std::int32_t most = 255;
    NodeRef dicing_camera;  ///< of meshes that name none
};

/// The parameters of a shape after what options say about subdivision: a copy if they differ from what is written.
class LimitedBlock {
  public:
    LimitedBlock(const NodeInstance& node, const FinenessLimits& limits) : block_(node.block()) {
        const ParamInfo* steps = node.type().find("subdiv_iterations");
        const ParamInfo* camera = node.type().find("subdiv_dicing_camera");
        if (steps == nullptr || camera == nullptr) return;
        copy_.resize(node.type().block_size / sizeof(Unit) + 1);
        std::memcpy(copy_.data(), block_, node.type().block_size);
        auto* bytes = reinterpret_cast<std::byte*>(copy_.data());
        auto* n = reinterpret_cast<std::uint8_t*>(bytes + steps->offset);
        *n = static_cast<std::uint8_t>(std::clamp(limits.none ? 0 : limits.most, 0, int{*n}));
        auto* ref = reinterpret_cast<NodeRef*>(bytes + camera->offset);
        if (!*ref) *ref = limits.dicing_camera;
        block_ = bytes;
    }
    [[nodiscard]] const void* get() const { return block_; }

  private:
    struct alignas(16) Unit {
        std::byte bytes[16];
    };
    const void* block_;
    std::vector<Unit> copy_;
};

}  // namespace

void Compiler::make_shapes() {
    for (const auto& node : graph_.nodes())
        if (node->kind() == NodeKind::Shape && node->type().shape_common != nullptr)
            place_shape(*node);
}

std::unique_ptr<ShapeGeometry> Compiler::geometry_of(const NodeInstance& node) {
    if (node.type().make_geometry == nullptr) return nullptr;
    CompileContext context(*this, &node, node.name());
    const FinenessLimits limits{option("ignore_subdivision", false),
                                option<std::int32_t>("max_subdivisions", 255),
                                option<NodeRef>("subdiv_dicing_camera", {})};
    const LimitedBlock block(node, limits);
    std::unique_ptr<ShapeGeometry> geometry = node.type().make_geometry(block.get(), context);
    if (!geometry || geometry->instance_of) return geometry;
    if (std::visit([](const auto& g) { return shows_nothing(g); }, geometry->data)) return nullptr;
    displace(node, *geometry);
    return geometry;
}

void Compiler::resample_motion(ShapeGeometry& geometry, MotionRange range) const {
    const Shutter shutter = shutter_of(scene_->settings);
    const auto resample = [&](std::vector<std::vector<Vec3f>>& keys) {
        if (keys.size() < 2) return;
        keys = keys_over_shutter<std::vector<Vec3f>>(
            keys, range, shutter,
            [](const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, float t) {
                std::vector<Vec3f> out(a.size());
                for (std::size_t i = 0; i < a.size(); ++i)
                    out[i] = blend_points(a[i], b[i], t);
                return out;
            });
    };
    const auto resample_numbers = [&](std::vector<std::vector<float>>& keys) {
        if (keys.size() > 1)
            keys = keys_over_shutter<std::vector<float>>(keys, range, shutter, blend_numbers);
    };
    if (auto* mesh = std::get_if<TriangleMesh>(&geometry.data)) {
        resample(mesh->positions);
        resample(mesh->normals);
    } else if (auto* spheres = std::get_if<SphereList>(&geometry.data)) {
        resample(spheres->centers);
    } else if (auto* curves = std::get_if<CurveList>(&geometry.data)) {
        resample(curves->points);
        resample_numbers(curves->radii);
    } else if (auto* points = std::get_if<PointList>(&geometry.data)) {
        resample(points->centers);
        resample_numbers(points->radii);
    }
}

const ShapeGeometry* Compiler::shared_geometry(const NodeInstance& node) {
    if (const auto known = geometry_by_node_.find(&node); known != geometry_by_node_.end())
        return known->second;
    std::unique_ptr<ShapeGeometry> geometry = geometry_of(node);
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (geometry) resample_motion(*geometry, {common.motion_start, common.motion_end});
    const ShapeGeometry* out = geometry.get();
    scene_->services->prepare(node);
    if (geometry) scene_->geometries.push_back(std::move(geometry));
    return geometry_by_node_[&node] = out;
}

/// The matrices of a shape and of the instances around it, given from the outermost inward, over the shutter.
std::vector<Mat4f> Compiler::placement_of(const std::vector<const ShapeCommon*>& moved_by,
                                          const ShapeGeometry& geometry) const {
    Vec3f center;
    if (std::any_of(moved_by.begin(), moved_by.end(),
                    [](const ShapeCommon* c) { return turns_about_center(*c); }))
        center = center_of(geometry);
    std::vector<Mat4f> out{Mat4f{}};
    for (std::size_t i = moved_by.size(); i-- > 0;)
        out = compose(out, matrices_over_shutter(*moved_by[i], shutter_of(scene_->settings),
                                                 out[0].point(center)));
    return out;
}

void Compiler::place_shape(const NodeInstance& node) {
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (common.visibility == 0) return;
    // Follow instances to the shape that has geometry; nested ones are flattened.
    std::vector<const ShapeCommon*> moved_by;  // from the outermost inward
    moved_by.push_back(&common);
    const NodeInstance* source = &node;
    const ShapeGeometry* geometry = shared_geometry(node);
    for (int depth = 0; geometry != nullptr && geometry->instance_of; ++depth) {
        if (depth >= kMaxInstanceDepth)
            return diagnostics_.error(Code::CyclicLink,
                                      "instances refer to each other more than " +
                                          std::to_string(kMaxInstanceDepth) + " deep",
                                      node.where("node"));
        source = geometry->instance_of.node;
        if (source->type().shape_common == nullptr)
            return diagnostics_.error(Code::LinkType,
                                      "\"" + source->name().str() + "\" is a " +
                                          source->type().name.str() + ", not a shape",
                                      node.where("node"));
        if (geometry->inherit_xform)
            moved_by.push_back(source->type().shape_common(source->block()));
        geometry = shared_geometry(*source);
    }
    if (geometry == nullptr) return;
    const std::vector<Mat4f> placement = placement_of(moved_by, *geometry);

    SceneObject object;
    object.geometry = geometry;
    object.world_from_object = placement;
    for (const Mat4f& m : placement) {
        bool invertible = false;
        object.object_from_world.push_back(m.inverse(&invertible));
        if (!invertible || !m.finite()) {
            diagnostics_.warning(
                Code::ShapeBad,
                fmt::format(
                    "the matrix of \"{}\" flattens it or is not finite; the shape is left out",
                    node.name().view()),
                node.where("matrix"));
            return;
        }
    }
    // What an instance does not write it takes from its source, but for its own visibility.
    const ShapeCommon& base = *source->type().shape_common(source->block());
    const auto own = [&](const char* param) -> const ShapeCommon& {
        return node.is_set(param) ? common : base;
    };
    object.shaders = shaders_of(node, *source);
    object.lights = lights_of(node.is_set("use_light_group") ? node : *source);
    object.shadow_lights = shadow_lights_of(node.is_set("use_shadow_group") ? node : *source);
    object.name = node.name();
    object.node = &node;
    object.services = scene_->services.get();
    if (const auto found = bumps_.find(source); found != bumps_.end())
        object.bumps = found->second;
    object.id = own("id").id != 0 ? own("id").id : hash_name(node.name().view());
    object.visibility = common.visibility;
    object.sidedness = own("sidedness").sidedness;
    object.matte = own("matte").matte;
    object.invert_normals = own("invert_normals").invert_normals;
    object.receive_shadows = own("receive_shadows").receive_shadows;
    object.self_shadows = own("self_shadows").self_shadows;
    object.may_be_transparent =
        std::any_of(object.shaders.begin(), object.shaders.end(),
                    [](const ShaderProgram* p) { return p->may_be_transparent; });
    object.may_tint_shadows =
        std::any_of(object.shaders.begin(), object.shaders.end(),
                    [](const ShaderProgram* p) { return p->may_tint_shadows; });
    if (add_volume(node, *source, object, own("step_size").step_size)) return;
    scene_->objects.push_back(std::move(object));
}

std::vector<const ShaderProgram*> Compiler::shaders_of(const NodeInstance& node,
                                                       const NodeInstance& source) {
    Array<NodeRef> refs = source.type().shape_common(source.block())->shader;
    if (node.is_set("shader")) refs = node.type().shape_common(node.block())->shader;
    NodeRef over;
    if (graph_.options() != nullptr) over = graph_.options()->get<NodeRef>("shader_override");
    if (over) refs = {&over, 1, 1};
    const std::string label = object_label_of(node, source);
    std::vector<const ShaderProgram*> out;
    for (const NodeRef& ref : refs.first_key()) {
        const ShaderProgram* program = ref ? program_for(*ref.node, {{}, label}) : nullptr;
        out.push_back(program != nullptr ? program : default_shader(label));
    }
    if (out.empty()) out.push_back(default_shader(label));
    for (const ShaderProgram* program : out)
        add_surface_shader(program);
    return out;
}

/// The user data lpe_label, which an instance takes from its source unless it has its own.
std::string Compiler::object_label_of(const NodeInstance& node, const NodeInstance& source) {
    const UserData* data = node.find_user_data("lpe_label");
    if (data == nullptr) data = source.find_user_data("lpe_label");
    if (data == nullptr || data->n == 0) return "";
    const auto refuse = [&](const std::string& problem, std::string hint) {
        diagnostics_.error(Code::ObjectLabel, problem, data->where, std::move(hint));
        return std::string{};
    };
    if (data->type != ParamType::String || data->user_class != UserDataClass::Constant)
        return refuse("lpe_label of \"" + node.name().str() + "\" is no label",
                      "declare lpe_label constant STRING");
    std::string label = data->values<Name>()[0].str();
    if (label.find('\'') != std::string::npos)
        return refuse("the object label \"" + label + "\" has a quote in it",
                      "expressions write it between quotes: 'hero'");
    const std::vector<std::string>& groups = scene_->summary.light_groups;
    if (std::find(groups.begin(), groups.end(), label) != groups.end() || label == "default")
        return refuse("the object label \"" + label + "\" is also a light group",
                      "rename one of them: an expression could not tell them apart");
    for (const char* reserved : {"coat", "sheen", "hair"})
        if (label == reserved)
            return refuse("the object label \"" + label + "\" is that of a lobe",
                          "coat, sheen and hair mean lobes; choose another");
    return label;
}

void Compiler::add_surface_shader(const ShaderProgram* program) {
    if (!surface_shaders_.insert(const_cast<ShaderProgram*>(program)).second) return;
    for (const ShaderProgram* part : program->parts)
        add_surface_shader(part);
}

const LightSampler* Compiler::lights_of(const NodeInstance& node) {
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (!common.use_light_group) return scene_->light_samplers[0].get();
    std::vector<std::uint32_t> subset;
    for (const NodeRef& ref : common.light_group.first_key())
        for (const std::uint32_t light : indices_of_light(ref))
            subset.push_back(light);
    std::sort(subset.begin(), subset.end());
    subset.erase(std::unique(subset.begin(), subset.end()), subset.end());
    const LightSampler*& sampler = samplers_by_group_[subset];
    if (sampler == nullptr) {
        std::vector<const Light*> lights;
        for (const SceneLight& light : scene_->lights)
            lights.push_back(light.light.get());
        scene_->light_samplers.push_back(std::make_unique<LightSampler>(lights, subset));
        sampler = scene_->light_samplers.back().get();
    }
    return sampler;
}

std::vector<bool> Compiler::shadow_lights_of(const NodeInstance& node) {
    const ShapeCommon& common = *node.type().shape_common(node.block());
    if (!common.use_shadow_group) return {};
    std::vector<bool> out(scene_->lights.size(), false);
    for (const NodeRef& ref : common.shadow_group.first_key())
        for (const std::uint32_t light : indices_of_light(ref))
            out[light] = true;
    if (std::all_of(out.begin(), out.end(), [](bool casts) { return casts; })) return {};
    // What hides such a light from light samples is not what hides it from rays that would meet it.
    for (std::size_t i = 0; i < out.size(); ++i)
        if (!out[i]) scene_->lights[i].samples_only = true;
    return out;
}

}  // namespace lightsieve
