// ginstance: another shape once more, elsewhere. Instances of instances are flattened when the scene is compiled.
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Ginstance : ShapeNode {
    NodeRef node;
    bool inherit_xform = true;

    static NodeType describe() {
        Describe<Ginstance> d(
            "ginstance", NodeKind::Shape,
            "Another shape once more; parameters that are written override those of the source.");
        describe_shape_common(d);
        d.param("node", &Ginstance::node, "The shape, or another instance.");
        d.param("inherit_xform", &Ginstance::inherit_xform,
                "The source's matrix is applied before the instance's own.");
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        if (!node) {
            context.diagnostics().error(Code::InvalidValue, "the instance has no source",
                                        context.where("node"),
                                        "give \"node\" the name of a shape");
            return nullptr;
        }
        auto out = std::make_unique<ShapeGeometry>();
        out->instance_of = node;
        out->inherit_xform = inherit_xform;
        return out;
    }
};

}  // namespace

NodeType node_ginstance() { return Ginstance::describe(); }

}  // namespace lightsieve
