// passthrough: a shader as it is; others are evaluated beside it, for the AOVs that they write.
#include <array>
#include <string>

#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

constexpr std::size_t kBeside = 20;

struct Passthrough {
    ShaderRef passthrough;
    std::array<ShaderRef, kBeside> eval_beside;
    Vec3f normal;

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const {
        // What they look like goes nowhere; what they write stays.
        ClosureSet unseen;
        for (const ShaderRef& beside : eval_beside) {
            if (!beside) continue;
            unseen.begin(at.wo, Frame::from_z_x(at.normal, at.tangent));
            beside.closures(at, unseen);
        }
        passthrough.closures(at, out);
    }
};

NodeType Passthrough::describe() {
    Describe<Passthrough> d("passthrough", NodeKind::Shader,
                            "A shader as it is, with others evaluated beside it.");
    d.param("passthrough", &Passthrough::passthrough, "The shader.");
    for (std::size_t i = 0; i < kBeside; ++i)
        d.part(
            "eval" + std::to_string(i + 1),
            [=](Passthrough& p) -> ShaderRef& { return p.eval_beside[i]; },
            "Evaluated for what it writes.");
    d.param("normal", &Passthrough::normal, "Evaluated for what it writes.").ignored();
    return d.done();
}

}  // namespace

NodeType node_passthrough() { return Passthrough::describe(); }

}  // namespace lightsieve
