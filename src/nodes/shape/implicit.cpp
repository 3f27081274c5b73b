// implicit: surfaces where a field has one value, known by name only.
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

enum class Solver : std::int32_t { Uniform, Levelset };

struct Implicit : ShapeNode {
    Solver solver = Solver::Uniform;
    float threshold = 0;
    std::uint32_t samples = 10;
    Name field_channel;
    Vec3f min{-0.5F, -0.5F, -0.5F}, max{0.5F, 0.5F, 0.5F};

    static NodeType describe() {
        Describe<Implicit> d("implicit", NodeKind::Shape,
                             "A surface of equal values; not supported: the shape is left out.");
        describe_shape_common(d);
        const char* without_effect = "Without effect: the shape is left out.";
        d.param("solver", &Implicit::solver, without_effect)
            .names({"uniform", "levelset"})
            .ignored();
        d.param("threshold", &Implicit::threshold, without_effect).ignored();
        d.param("samples", &Implicit::samples, without_effect).ignored();
        d.param("field_channel", &Implicit::field_channel, without_effect).ignored();
        d.param("min", &Implicit::min, without_effect).ignored();
        d.param("max", &Implicit::max, without_effect).ignored();
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        context.diagnostics().warning(Code::ParamPending,
                                      "implicit surfaces are not supported; the shape is left out",
                                      context.where("solver"), "export it as a polymesh");
        return nullptr;
    }
};

}  // namespace

NodeType node_implicit() { return Implicit::describe(); }

}  // namespace lightsieve
