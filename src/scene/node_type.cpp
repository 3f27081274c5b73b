#include "scene/node_type.h"

#include <array>

namespace lightsieve {
namespace {

struct TypeRow {
    std::string_view text;
    std::size_t size;
};
/// In the order of ParamType.
constexpr std::array<TypeRow, 14> kTypes{{
    {"BOOL", sizeof(bool)},
    {"BYTE", sizeof(std::uint8_t)},
    {"INT", sizeof(std::int32_t)},
    {"UINT", sizeof(std::uint32_t)},
    {"FLOAT", sizeof(float)},
    {"RGB", sizeof(Color)},
    {"RGBA", sizeof(Rgba)},
    {"VECTOR", sizeof(Vec3f)},
    {"VECTOR2", sizeof(Vec2f)},
    {"STRING", sizeof(Name)},
    {"ENUM", sizeof(std::int32_t)},
    {"MATRIX", sizeof(Mat4f)},
    {"NODE", sizeof(NodeRef)},
    {"CLOSURE", sizeof(ShaderRef)},
}};

/// In the order of NodeKind.
constexpr std::array<std::string_view, 11> kKinds{
    "options", "camera",       "shape",    "light",         "shader", "filter",
    "driver",  "light filter", "operator", "color manager", "imager"};

}  // namespace

std::string_view type_text(ParamType type) {
    return kTypes.at(static_cast<std::size_t>(type)).text;
}
std::size_t type_size(ParamType type) { return kTypes.at(static_cast<std::size_t>(type)).size; }
std::string_view kind_text(NodeKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

const ParamInfo* NodeType::find(Name param) const {
    for (const ParamInfo& info : params)
        if (info.name == param) return &info;
    return nullptr;
}

}  // namespace lightsieve
