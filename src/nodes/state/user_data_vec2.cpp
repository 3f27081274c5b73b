// user_data_vec2: two numbers that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataVec2 : UserDataNode<Vec2f> {
    static NodeType describe() {
        Describe<UserDataVec2> d("user_data_vec2", NodeKind::Shader,
                                 "User data of the shape as two numbers.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] Vec2f eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? Vec2f{v.rgb.r, v.rgb.g} : fallback;
    }
};

}  // namespace

NodeType node_user_data_vec2() { return UserDataVec2::describe(); }

}  // namespace lightsieve
