// osl: a shader in the Open Shading Language. Its source is not executed here: every use is reported, and stands for the value
// that the source gives its first output before anything is computed, or black.
#include <cctype>
#include <cstdlib>

#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shade_point.h"

namespace lightsieve {
namespace {

/// Reads what follows `=` in `output color Col = color(1, 0.5, 0)` or `output float x = 3`.
class InitialValue {
  public:
    explicit InitialValue(std::string_view code) : text_(code) {}

    [[nodiscard]] Color find() const {
        std::size_t at = text_.find("output");
        if (at == std::string::npos) return {};
        const std::size_t end = text_.find_first_of(",){", at), equals = text_.find('=', at);
        if (equals == std::string::npos || equals > end) return {};
        at = equals + 1;
        Color out;
        int n = 0;
        bool inside = false;  // of color(...)
        while (n < 3 && at < text_.size() && text_[at] != ';' && text_[at] != ')') {
            if (text_[at] == ',' && !inside) break;
            inside = inside || text_[at] == '(';
            char* after = nullptr;
            const float v = std::strtof(text_.c_str() + at, &after);
            const auto next = static_cast<std::size_t>(after - text_.c_str());
            if (next > at && starts_number(text_[at])) {
                out[n++] = v;
                at = next;
            } else {
                ++at;
            }
        }
        return n == 1 ? Color::grey(out.r) : out;
    }

  private:
    static bool starts_number(char c) {
        return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.' ||
               c == ' ';
    }
    std::string text_;
};

struct Osl {
    Name code, shadername, includepath;
    Color value;  ///< found by prepare()

    static NodeType describe() {
        Describe<Osl> d(
            "osl", NodeKind::Shader,
            "A shader in the Open Shading Language, which is not executed: the initial "
            "value of its first output stands for it.");
        d.param("code", &Osl::code, "Source of the shader.");
        d.param("shadername", &Osl::shadername, "Name of a compiled shader.").ignored();
        d.param("includepath", &Osl::includepath, "Folders of the source's headers.").ignored();
        return d.done();
    }
    void prepare(NodeContext& context) {
        value = InitialValue(code.view()).find();
        context.diagnostics().warning(Code::ParamPending,
                                      "the source of osl \"" + context.node_name().str() +
                                          "\" is not executed: one colour stands for it",
                                      context.where("code"),
                                      "bake it to a texture in the program that wrote the scene");
    }
    [[nodiscard]] Color eval(const ShadePoint&) const { return value; }
};

}  // namespace

NodeType node_osl() { return Osl::describe(); }

}  // namespace lightsieve
