// string_replace: replaces a part of all texts of the selected nodes, of file names for example.
#include "nodes/operator/operator_common.h"
#include "scene/ass_write.h"

namespace lightsieve {
namespace {

struct StringReplace : SelectingOperator {
    Name match, replace;

    static NodeType describe() {
        Describe<StringReplace> d("string_replace", NodeKind::Operator,
                                  "Replaces a part of every text of the selected nodes.");
        describe_selecting_operator(d);
        d.param("match", &StringReplace::match, "What is replaced, letter by letter.");
        d.param("replace", &StringReplace::replace, "What comes in its place.");
        return d.done();
    }

    void edit_scene(OperatorContext& context) const {
        cook_inputs(context);
        if (!enable || match.empty()) return;
        for (NodeInstance* node : select(context))
            for (const ParamInfo& param : node->type().params) {
                if (param.type != ParamType::String || param.is_array) continue;
                const std::string before = node->get<Name>(param.name).str();
                const std::string after = replaced(before);
                if (after != before) context.set(*node, param.name.view(), quote_ass(after));
            }
    }

  private:
    [[nodiscard]] std::string replaced(const std::string& text) const {
        std::string out;
        std::size_t at = 0;
        for (std::size_t found; (found = text.find(match.view(), at)) != std::string::npos;) {
            out += text.substr(at, found - at) + replace.str();
            at = found + match.view().size();
        }
        return out + text.substr(at);
    }
};

}  // namespace

NodeType node_string_replace() { return StringReplace::describe(); }

}  // namespace lightsieve
