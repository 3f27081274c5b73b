// user_data_rgba: a colour with alpha that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataRgba : UserDataNode<Rgba> {
    static NodeType describe() {
        Describe<UserDataRgba> d("user_data_rgba", NodeKind::Shader,
                                 "User data of the shape as a colour with alpha.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] Rgba eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? v : fallback;
    }
};

}  // namespace

NodeType node_user_data_rgba() { return UserDataRgba::describe(); }

}  // namespace lightsieve
