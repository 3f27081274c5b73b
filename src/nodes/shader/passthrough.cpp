// passthrough: a shader as it is; others are evaluated beside it, for the AOVs that they write.
#include <array>
#include <string>

#include "nodes/closure/closure_common.h"

namespace lightsieve {
namespace {

constexpr std::size_t kBeside = 20;

struct Passthrough {
    ShaderRef passthrough;
    std::array<Lazy<Color>, kBeside> eval_beside;
    Vec3f normal;

    static NodeType describe();
    void eval(const ShadePoint& at, ClosureSet& out) const {
        for (const Lazy<Color>& beside : eval_beside)
            if (beside.linked()) (void)beside.at(at);
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
            [=](Passthrough& p) -> Lazy<Color>& { return p.eval_beside[i]; },
            "Evaluated for what it writes.");
    d.param("normal", &Passthrough::normal, "Evaluated for what it writes.").ignored();
    return d.done();
}

}  // namespace

NodeType node_passthrough() { return Passthrough::describe(); }

}  // namespace lightsieve
