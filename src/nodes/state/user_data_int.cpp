// user_data_int: a whole number that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataInt : UserDataNode<std::int32_t> {
    static NodeType describe() {
        Describe<UserDataInt> d("user_data_int", NodeKind::Shader,
                                "User data of the shape as a whole number.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] std::int32_t eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? int_from(v.rgb.r) : fallback;
    }
};

}  // namespace

NodeType node_user_data_int() { return UserDataInt::describe(); }

}  // namespace lightsieve
