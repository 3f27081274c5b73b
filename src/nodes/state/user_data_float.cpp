// user_data_float: a number that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataFloat : UserDataNode<float> {
    static NodeType describe() {
        Describe<UserDataFloat> d("user_data_float", NodeKind::Shader,
                                  "User data of the shape as a number.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] float eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? average(v.rgb) : fallback;
    }
};

}  // namespace

NodeType node_user_data_float() { return UserDataFloat::describe(); }

}  // namespace lightsieve
