// user_data_rgb: a colour that shapes carry, by name.
#include "nodes/state/user_data.h"

namespace lightsieve {
namespace {

struct UserDataRgb : UserDataNode<Color> {
    static NodeType describe() {
        Describe<UserDataRgb> d("user_data_rgb", NodeKind::Shader,
                                "User data of the shape as a colour.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const {
        ShaderValue v;
        return find_user_value(at, attribute, v) ? v.rgb : fallback;
    }
};

}  // namespace

NodeType node_user_data_rgb() { return UserDataRgb::describe(); }

}  // namespace lightsieve
