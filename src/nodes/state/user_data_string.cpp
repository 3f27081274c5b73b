// user_data_string: a text that shapes carry, by name.
#include <algorithm>

#include "nodes/state/user_data.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct UserDataString : UserDataNode<Name> {
    static NodeType describe() {
        Describe<UserDataString> d("user_data_string", NodeKind::Shader,
                                   "User data of the shape as a text.");
        describe_user_data(d);
        return d.done();
    }
    [[nodiscard]] Name eval(const ShadePoint& at) const {
        Name out;
        return at.services != nullptr && at.services->user_text(at, attribute, out) ? out
                                                                                    : fallback;
    }
    [[nodiscard]] std::vector<Name> possible_texts(NodeContext& context) const {
        std::vector<Name> out = context.user_texts(attribute);
        out.push_back(fallback);
        return out;
    }
};

}  // namespace

NodeType node_user_data_string() { return UserDataString::describe(); }

}  // namespace lightsieve
