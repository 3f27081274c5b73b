// composite: one colour on another, both premultiplied by their alphas.
#include "nodes/color/composite_ops.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

/// "over" in composite_ops().
constexpr std::int32_t kOver = 27;
enum class Operation : std::int32_t {};
enum class AlphaOperation : std::int32_t { Same, A, B };

struct Composite {
    Rgba A{{0, 0, 0}, 0}, B{{0, 0, 0}, 0};
    Operation operation{kOver};
    AlphaOperation alpha_operation = AlphaOperation::Same;

    static NodeType describe() {
        Describe<Composite> d("composite", NodeKind::Shader,
                              "One colour on another, both premultiplied by their alphas.");
        d.param("A", &Composite::A, "The colour above.");
        d.param("B", &Composite::B, "The colour below.");
        d.param("operation", &Composite::operation, "How they are put together.")
            .names(composite_op_names());
        d.param("alpha_operation", &Composite::alpha_operation,
                "Alpha: by the same operation, or that of one of them.")
            .names({"same", "A", "B"});
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint&) const {
        const std::size_t i =
            std::min(static_cast<std::size_t>(operation), composite_ops().size() - 1);
        const CompositeOp& op = composite_ops()[i];
        const auto put = [&](float a, float b) { return op.channel(a, b, A.a, B.a); };
        const float alpha = alpha_operation == AlphaOperation::A   ? A.a
                            : alpha_operation == AlphaOperation::B ? B.a
                                                                   : put(A.a, B.a);
        return {{put(A.rgb.r, B.rgb.r), put(A.rgb.g, B.rgb.g), put(A.rgb.b, B.rgb.b)}, alpha};
    }
};

}  // namespace

NodeType node_composite() { return Composite::describe(); }

}  // namespace lightsieve
