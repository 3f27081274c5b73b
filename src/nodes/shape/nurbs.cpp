// nurbs: spline surfaces, known by name only.
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Nurbs : ShapeNode {
    std::int32_t degree_u = 3, degree_v = 3, tesselate_u = 5, tesselate_v = 5;
    Array<float> knots_u, knots_v;
    Array<float> cvs;
    bool smoothing = true;

    static NodeType describe() {
        Describe<Nurbs> d("nurbs", NodeKind::Shape,
                          "A spline surface; not supported: the shape is left out.");
        describe_shape_common(d);
        const char* without_effect = "Without effect: the shape is left out.";
        d.param("degree_u", &Nurbs::degree_u, without_effect).ignored();
        d.param("degree_v", &Nurbs::degree_v, without_effect).ignored();
        d.param("knots_u", &Nurbs::knots_u, without_effect).ignored();
        d.param("knots_v", &Nurbs::knots_v, without_effect).ignored();
        d.param("cvs", &Nurbs::cvs, without_effect).ignored();
        d.param("tesselate_u", &Nurbs::tesselate_u, without_effect).ignored();
        d.param("tesselate_v", &Nurbs::tesselate_v, without_effect).ignored();
        d.param("smoothing", &Nurbs::smoothing, without_effect).ignored();
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        context.diagnostics().warning(
            Code::ParamPending, "nurbs surfaces are not supported; the shape is left out",
            context.where("cvs"),
            "export it as a polymesh, with subdivision if it must be smooth");
        return nullptr;
    }
};

}  // namespace

NodeType node_nurbs() { return Nurbs::describe(); }

}  // namespace lightsieve
