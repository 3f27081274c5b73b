// shuffle: a colour with its channels in another order.
#include "nodes/math/math_node.h"

namespace lightsieve {
namespace {

enum class Channel : std::int32_t { R, G, B, A };

struct Shuffle {
    Color color{1, 1, 1};
    float alpha = 1;
    Channel channel_r = Channel::R, channel_g = Channel::G, channel_b = Channel::B,
            channel_a = Channel::A;
    bool negate_r = false, negate_g = false, negate_b = false, negate_a = false;

    static NodeType describe();
    [[nodiscard]] Rgba eval(const ShadePoint&) const;
};

NodeType Shuffle::describe() {
    Describe<Shuffle> d("shuffle", NodeKind::Shader,
                        "A colour and an alpha with their channels in any order.");
    d.param("color", &Shuffle::color, "Red, green and blue.");
    d.param("alpha", &Shuffle::alpha, "The alpha channel.");
    const std::vector<std::string> channels{"R", "G", "B", "A"};
    d.param("channel_r", &Shuffle::channel_r, "What becomes red.").names(channels);
    d.param("channel_g", &Shuffle::channel_g, "What becomes green.").names(channels);
    d.param("channel_b", &Shuffle::channel_b, "What becomes blue.").names(channels);
    d.param("channel_a", &Shuffle::channel_a, "What becomes alpha.").names(channels);
    d.param("negate_r", &Shuffle::negate_r, "Red becomes 1 minus itself.");
    d.param("negate_g", &Shuffle::negate_g, "Green becomes 1 minus itself.");
    d.param("negate_b", &Shuffle::negate_b, "Blue becomes 1 minus itself.");
    d.param("negate_a", &Shuffle::negate_a, "Alpha becomes 1 minus itself.");
    return d.done();
}

Rgba Shuffle::eval(const ShadePoint&) const {
    const auto of = [&](Channel c, bool negated) {
        const float v = c == Channel::A ? alpha : color[static_cast<int>(c)];
        return negated ? 1 - v : v;
    };
    return {{of(channel_r, negate_r), of(channel_g, negate_g), of(channel_b, negate_b)},
            of(channel_a, negate_a)};
}

}  // namespace

NodeType node_shuffle() { return Shuffle::describe(); }

}  // namespace lightsieve
