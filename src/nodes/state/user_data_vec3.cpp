// user_data_vec3: three numbers that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataVec3 : UserDataNode<Vec3f> {
    static NodeType describe() {
        Describe<UserDataVec3> d("user_data_vec3", NodeKind::Shader,
                                 "User data of the shape as three numbers.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? Vec3f{v.rgb.r, v.rgb.g, v.rgb.b} : fallback;
    }
};

}  // namespace

NodeType node_user_data_vec3() { return UserDataVec3::describe(); }

}  // namespace lightsieve
