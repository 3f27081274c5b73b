// log: logarithm of each channel.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

struct Log {
    Color input{1, 1, 1};
    Color base{2.7182818F, 2.7182818F, 2.7182818F};

    static NodeType describe() {
        Describe<Log> d("log", NodeKind::Shader, "Logarithm of each channel to any base.");
        d.param("input", &Log::input, "What the logarithm is taken of; 0 or less gives 0.");
        d.param("base", &Log::base, "The base; e: the natural logarithm.");
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint&) const {
        Color out;
        for (int c = 0; c < 3; ++c)
            if (input[c] > 0 && base[c] > 0 && base[c] != 1)
                out[c] = std::log(input[c]) / std::log(base[c]);
        return out;
    }
};

}  // namespace

NodeType node_log() { return Log::describe(); }

}  // namespace lightsieve
