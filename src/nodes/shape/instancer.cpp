// instancer: other shapes many times over, without a node for each. Flattened when the scene is compiled.
#include <fmt/format.h>

#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Instancer : ShapeNode, InstanceList {
    Array<bool> instance_opaque;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const;

  private:
    [[nodiscard]] bool has_sources(NodeContext& context) const;
    void check_lengths(NodeContext& context) const;
};

NodeType Instancer::describe() {
    Describe<Instancer> d("instancer", NodeKind::Shape,
                          "Other shapes many times over, each instance with a matrix of its own. "
                          "User data called instance_NAME, an array with a value for each "
                          "instance, is seen by shaders as NAME.");
    describe_shape_common(d);
    d.param("nodes", &Instancer::nodes, "Shapes, instances or procedurals that are placed.");
    d.param("node_idxs", &Instancer::node_idxs,
            "For each instance which of the nodes it places, counted from 0; none: the first.");
    d.param("instance_matrix", &Instancer::instance_matrix,
            "Placement of each instance in the instancer's space; several motion keys one after "
            "the other.");
    d.param("instance_motion_start", &Instancer::instance_motion_start,
            "Time of the first key of instance_matrix; none: motion_start.")
        .unit("frames");
    d.param("instance_motion_end", &Instancer::instance_motion_end,
            "Time of the last key of instance_matrix; none: motion_end.")
        .unit("frames");
    d.param("instance_visibility", &Instancer::instance_visibility,
            "Ray types that see the instance, instead of what the placed shape says.");
    d.param("instance_sidedness", &Instancer::instance_sidedness,
            "Ray types that see both sides, instead of what the placed shape says.");
    d.param("instance_shader", &Instancer::instance_shader,
            "Shader of the instance, instead of the placed shape's.");
    d.param("instance_inherit_xform", &Instancer::instance_inherit_xform,
            "The placed shape's own matrix is applied first.");
    d.param("instance_matte", &Instancer::instance_matte, "Instead of the placed shape's matte.");
    d.param("instance_invert_normals", &Instancer::instance_invert_normals,
            "Instead of the placed shape's invert_normals.");
    d.param("instance_receive_shadows", &Instancer::instance_receive_shadows,
            "Instead of the placed shape's receive_shadows.");
    d.param("instance_self_shadows", &Instancer::instance_self_shadows,
            "Instead of the placed shape's self_shadows.");
    d.param("instance_opaque", &Instancer::instance_opaque,
            "Deprecated; opacity of the shader decides.")
        .ignored();
    d.param("instance_id", &Instancer::instance_id, "Value of the AOV ID.");
    d.param("instance_use_light_group", &Instancer::instance_use_light_group,
            "Only the lights of instance_light_group illuminate the instance.");
    d.param("instance_light_group", &Instancer::instance_light_group,
            "Lights for instance_use_light_group, the same for all instances.");
    d.param("instance_use_shadow_group", &Instancer::instance_use_shadow_group,
            "The instance casts shadows in the lights of instance_shadow_group only.");
    d.param("instance_shadow_group", &Instancer::instance_shadow_group,
            "Lights for instance_use_shadow_group, the same for all instances.");
    return d.done();
}

bool Instancer::has_sources(NodeContext& context) const {
    const auto refuse = [&](const std::string& problem, const char* param, std::string hint) {
        context.diagnostics().warning(Code::ShapeBad, problem + "; nothing is placed",
                                      context.where(param), std::move(hint));
        return false;
    };
    const bool any = std::any_of(nodes.data, nodes.data + nodes.n,
                                 [](const NodeRef& node) { return static_cast<bool>(node); });
    if (!any) return refuse("the instancer has no nodes", "nodes", "name shapes in \"nodes\"");
    if (instance_matrix.empty())
        return refuse("the instancer has no instance_matrix", "instance_matrix",
                      "give a matrix for each instance");
    return true;
}

/// Arrays that are neither for each instance nor for all.
void Instancer::check_lengths(NodeContext& context) const {
    const std::uint32_t n = size();
    const auto check = [&](const char* param, std::uint32_t given) {
        if (given <= 1 || given == n) return;
        context.diagnostics().warning(
            Code::ShapeBad, fmt::format("{} has {} values for {} instances", param, given, n),
            context.where(param),
            given < n ? "the last one stands for the rest" : "those beyond are left out");
    };
    check("node_idxs", node_idxs.n);
    check("instance_visibility", instance_visibility.n);
    check("instance_sidedness", instance_sidedness.n);
    check("instance_shader", instance_shader.n);
    check("instance_inherit_xform", instance_inherit_xform.n);
    check("instance_matte", instance_matte.n);
    check("instance_invert_normals", instance_invert_normals.n);
    check("instance_receive_shadows", instance_receive_shadows.n);
    check("instance_self_shadows", instance_self_shadows.n);
    check("instance_id", instance_id.n);
    check("instance_use_light_group", instance_use_light_group.n);
    check("instance_use_shadow_group", instance_use_shadow_group.n);
    check("instance_motion_start", instance_motion_start.n);
    check("instance_motion_end", instance_motion_end.n);
}

std::unique_ptr<ShapeGeometry> Instancer::make_geometry(NodeContext& context) const {
    if (!has_sources(context)) return nullptr;
    check_lengths(context);
    const std::uint32_t known = std::min(size(), node_idxs.n);
    const auto bad = std::find_if(node_idxs.data, node_idxs.data + known,
                                  [&](std::uint32_t i) { return i >= nodes.n; });
    if (bad != node_idxs.data + known)
        context.diagnostics().warning(
            Code::ShapeBad,
            fmt::format("instance {} asks for node {} of {}: such instances are left out",
                        bad - node_idxs.data, *bad, nodes.n),
            context.where("node_idxs"), "indices count from 0");
    auto out = std::make_unique<ShapeGeometry>();
    out->instances = this;
    return out;
}

}  // namespace

NodeType node_instancer() { return Instancer::describe(); }

}  // namespace lightsieve
