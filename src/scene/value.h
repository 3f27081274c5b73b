// The types of parameters: as a scene file names them, and as a node's parameter block holds them.
//
// Every block member is trivially copyable, so that a shader with linked parameters works on a byte copy of its
// block. Strings are interned; array data belongs to the node instance and the block only points to it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/matrix.h"
#include "core/name.h"
#include "core/vec.h"

namespace lightsieve {

enum class ParamType : std::uint8_t {
    Bool,     ///< bool
    Byte,     ///< std::uint8_t
    Int,      ///< std::int32_t
    UInt,     ///< std::uint32_t
    Float,    ///< float
    Rgb,      ///< Color
    Rgba,     ///< Rgba
    Vector,   ///< Vec3f (also written POINT)
    Vector2,  ///< Vec2f (also written POINT2)
    String,   ///< Name
    Enum,     ///< an enum class over std::int32_t
    Matrix,   ///< Mat4f
    Node,     ///< NodeRef: another node, by name
    Closure,  ///< ShaderRef: a shader whose closures are taken over
};

/// The type as .ass files write it, e.g. "VECTOR2".
[[nodiscard]] std::string_view type_text(ParamType type);
/// Bytes of one value in a block.
[[nodiscard]] std::size_t type_size(ParamType type);

class ClosureSet;    // bsdf/closure.h
class NodeInstance;  // scene/graph.h
struct ShadePoint;   // scene/shade_point.h

/// A reference to another node; null if the parameter is empty or NULL.
struct NodeRef {
    const NodeInstance* node = nullptr;
    explicit operator bool() const { return node != nullptr; }
    friend bool operator==(NodeRef, NodeRef) = default;
};

/// A reference to a shader whose closures a closure shader takes over (mix_shader.shader1).
struct ShaderRef {
    const NodeInstance* node = nullptr;
    /// Filled in when the shader network is compiled; null if nothing is linked.
    const void* program = nullptr;
    void (*run)(const void* program, const ShadePoint& at, ClosureSet& out) = nullptr;

    explicit operator bool() const { return program != nullptr; }
    /// Adds the shader's closures, with the set's scale; nothing if none is linked.
    void closures(const ShadePoint& at, ClosureSet& out) const {
        if (program != nullptr) run(program, at, out);
    }
    friend bool operator==(ShaderRef, ShaderRef) = default;
};

/// How a `Lazy` parameter finds what is linked to it; filled in when the shader network is compiled.
struct LazyLink {
    const void* links = nullptr;  ///< null: nothing is linked
    /// Writes the linked values, or components, over `value`, which holds what the file says.
    void (*apply)(const void* links, void* value, const ShadePoint& at) = nullptr;
};

/// A parameter that its node asks for itself: never (switch_rgba), often (bump2d), at another point (uv_transform). Plain
/// parameters are found once, before `eval`. Read and described as a T.
template <class T>
struct Lazy {
    T value{};  ///< what the file says, or the default
    LazyLink link;

    [[nodiscard]] bool linked() const { return link.links != nullptr; }
    [[nodiscard]] T at(const ShadePoint& point) const {
        T out = value;
        if (link.links != nullptr) link.apply(link.links, &out, point);
        return out;
    }
};

/// An array parameter: `n_keys` motion keys of `n` elements each, key after key. The node instance owns the data.
template <class T>
struct Array {
    const T* data = nullptr;
    std::uint32_t n = 0;       ///< elements a key
    std::uint32_t n_keys = 1;  ///< motion keys; at least 1

    [[nodiscard]] bool empty() const { return n == 0; }
    [[nodiscard]] std::span<const T> key(std::uint32_t k) const {
        return {data + std::size_t{k} * n, n};
    }
    [[nodiscard]] std::span<const T> first_key() const { return {data, n}; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data[i]; }
};

}  // namespace lightsieve
