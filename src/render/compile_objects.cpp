// Shapes that have arrived in the world: shaders, lights, labels, matrices. See shape_leaf.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/accel.h"
#include "render/compiler.h"
#include "render/shade_services.h"

namespace lightsieve {
namespace {

/// FNV-1a: ids of shapes without one are a stable function of their names.
std::uint32_t hash_name(std::string_view name) {
    std::uint32_t h = 2166136261U;
    for (const char c : name)
        h = (h ^ static_cast<unsigned char>(c)) * 16777619U;
    return h;
}

/// Whether rays survive the way into object space.
bool can_be_undone(const Mat4f& object_from_world) {
    const auto& m = object_from_world.m;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t column = 0; column < 3; ++column)
            if (!(std::abs(m[row][column]) <= (row < 3 ? kMaxMagnification : kMaxUndoneShift)))
                return false;
    return true;
}

/// Whether parts of a shape were drawn wider than they are, and are to be made transparent.
bool was_widened(const ShapeGeometry& geometry) {
    return std::visit(
        [](const auto& g) {
            if constexpr (requires { g.own_radii; })
                return !g.own_radii.empty();
            else
                return false;
        },
        geometry.data);
}

}  // namespace

void Compiler::place(ShapeLeaf&& leaf) {
    if (leaf.visibility == 0) return;
    SceneObject object;
    if (!set_placement(leaf, object)) return;
    object.geometry = leaf.geometry;
    const ShaderList& shaders = shaders_of(leaf);
    object.shaders = shaders.programs;
    object.may_be_transparent = shaders.may_be_transparent || was_widened(*leaf.geometry);
    object.may_tint_shadows = shaders.may_tint_shadows;
    object.reads_coordinates = shaders.reads_coordinates;
    object.lights =
        leaf.use_light_group ? lights_of(leaf.light_group) : scene_->light_samplers[0].get();
    object.shadow_lights = leaf.use_shadow_group ? shadow_lights_of(leaf.shadow_group) : nullptr;
    object.lineage = leaf.lineage;
    object.instance = leaf.instance;
    object.services = scene_->services.get();
    if (const auto found = bumps_.find(leaf.shape); found != bumps_.end())
        object.bumps = found->second;
    object.name = leaf.name;
    object.id = leaf.id != 0 ? leaf.id : hash_name(leaf.name.view());
    object.visibility = leaf.visibility;
    object.sidedness = leaf.sidedness;
    object.matte = leaf.matte;
    object.invert_normals = leaf.invert_normals;
    object.receive_shadows = leaf.receive_shadows;
    object.self_shadows = leaf.self_shadows;
    if (add_volume(leaf, object)) return;
    scene_->objects.push_back(object);
}

/// Matrices and their inverses; false with a warning if there are none.
bool Compiler::set_placement(const ShapeLeaf& leaf, SceneObject& object) {
    const std::size_t n = leaf.placement.size();
    const std::span<Mat4f> inverse = scene_->matrices.allocate_array<Mat4f>(n);
    for (std::size_t i = 0; i < n; ++i) {
        bool invertible = false;
        inverse[i] = leaf.placement[i].inverse(&invertible);
        if (invertible && leaf.placement[i].finite() && can_be_undone(inverse[i])) continue;
        diagnostics_.warning(Code::ShapeBad,
                             fmt::format("the matrix of \"{}\" flattens it, shrinks it to nothing "
                                         "or is not finite; the shape is left out",
                                         leaf.outermost->name().view()),
                             leaf.outermost->where("matrix"));
        return false;
    }
    const std::span<Mat4f> place = scene_->matrices.allocate_array<Mat4f>(n);
    std::copy(leaf.placement.begin(), leaf.placement.end(), place.begin());
    object.world_from_object = place;
    object.object_from_world = inverse;
    object.in_place = n == 1 && place[0] == Mat4f{};
    return true;
}

auto Compiler::shaders_of(const ShapeLeaf& leaf) -> const ShaderList& {
    Array<NodeRef> refs = leaf.shaders;
    NodeRef over;
    if (graph_.options() != nullptr) over = graph_.options()->get<NodeRef>("shader_override");
    if (over) refs = {&over, 1, 1};
    // Instances name the same shader at many places.
    const void* key = refs.n == 1 ? static_cast<const void*>(refs[0].node) : refs.data;
    const auto [known, added] = shader_lists_.try_emplace({key, refs.n, leaf.label.id()});
    if (!added) return *known->second;
    ShaderList& out = scene_->shader_lists.emplace_back();
    known->second = &out;
    const std::string label = leaf.label.str();
    for (const NodeRef& ref : refs.first_key()) {
        const ShaderProgram* program = ref ? program_for(*ref.node, {{}, label}) : nullptr;
        out.programs.push_back(program != nullptr ? program : default_shader(label));
    }
    if (out.programs.empty()) out.programs.push_back(default_shader(label));
    for (const ShaderProgram* program : out.programs) {
        add_surface_shader(program);
        out.may_be_transparent |= program->may_be_transparent;
        out.may_tint_shadows |= program->may_tint_shadows;
        out.reads_coordinates |= program->reads_coordinates();
    }
    return out;
}

/// Where nobody looks at uv and tangents, they are not worked out.
void Compiler::find_coordinate_readers() {
    const auto is_uv = [](const PlannedLayer& layer) { return layer.source == LayerSource::Uv; };
    const bool everywhere =
        !scene_->aov_shaders.empty() ||
        std::any_of(scene_->plan.layers.begin(), scene_->plan.layers.end(), is_uv);
    for (SceneObject& object : scene_->objects) {
        object.reads_coordinates |= object.bumps != nullptr;
        // Outputs get uv, too, but change no frame: the noise of a picture does not depend on what is asked for.
        object.wants_uv = object.reads_coordinates || everywhere;
    }
    scene_->reads_footprints =
        std::any_of(scene_->shaders.begin(), scene_->shaders.end(),
                    [](const auto& program) { return program->reads_coordinates(); });
}

/// The user data lpe_label; empty if the node has none.
Name Compiler::object_label_of(const NodeInstance& node) {
    const UserData* data = node.find_user_data("lpe_label");
    if (data == nullptr || data->n == 0) return {};
    const auto refuse = [&](const std::string& problem, std::string hint) {
        diagnostics_.error(Code::ObjectLabel, problem, data->where, std::move(hint));
        return Name{};
    };
    if (data->type != ParamType::String || data->user_class != UserDataClass::Constant)
        return refuse("lpe_label of \"" + node.name().str() + "\" is no label",
                      "declare lpe_label constant STRING");
    const std::string label = data->values<Name>()[0].str();
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

/// Indices of the lights in a group, each once.
std::vector<std::uint32_t> Compiler::light_indices(const Array<NodeRef>& group) const {
    std::vector<std::uint32_t> out;
    for (const NodeRef& ref : group.first_key())
        for (const std::uint32_t light : indices_of_light(ref))
            out.push_back(light);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

const LightSampler* Compiler::lights_of(const Array<NodeRef>& group) {
    const std::vector<std::uint32_t> subset = light_indices(group);
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

const std::vector<bool>* Compiler::shadow_lights_of(const Array<NodeRef>& group) {
    const std::vector<std::uint32_t> subset = light_indices(group);
    if (subset.size() == scene_->lights.size()) return nullptr;
    const std::vector<bool>*& out = shadow_lights_by_group_[subset];
    if (out != nullptr) return out;
    std::vector<bool>& casts = scene_->shadow_lights.emplace_back(scene_->lights.size(), false);
    for (const std::uint32_t i : subset)
        casts[i] = true;
    // What hides such a light from light samples is not what hides it from rays that would meet it.
    for (std::size_t i = 0; i < casts.size(); ++i)
        if (!casts[i]) scene_->lights[i].samples_only = true;
    return out = &casts;
}

}  // namespace lightsieve
