#include "nodes/all_nodes.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <string>

#include "lpe/match.h"
#include "python/layers.h"
#include "python/text.h"
#include "scene/node_type.h"
#include "scene/registry.h"

namespace nb = nanobind;

namespace lightsieve::python {
namespace {

/// One value of a block, read byte by byte because blocks are only bytes here.
template <class T>
T read(const std::byte* at) {
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

nb::object matrix(const Mat4f& m) {
    nb::list rows;
    for (const auto& row : m.m)
        rows.append(nb::make_tuple(row[0], row[1], row[2], row[3]));
    return nb::tuple(rows);
}

nb::object value_at(const ParamInfo& param, const std::byte* at) {
    switch (param.type) {
        case ParamType::Bool: return nb::cast(read<bool>(at));
        case ParamType::Byte: return nb::cast(static_cast<int>(read<std::uint8_t>(at)));
        case ParamType::Int: return nb::cast(read<std::int32_t>(at));
        case ParamType::UInt: return nb::cast(read<std::uint32_t>(at));
        case ParamType::Float: return nb::cast(read<float>(at));
        case ParamType::Rgb: {
            const auto c = read<Color>(at);
            return nb::make_tuple(c.r, c.g, c.b);
        }
        case ParamType::Rgba: {
            const auto c = read<Rgba>(at);
            return nb::make_tuple(c.rgb.r, c.rgb.g, c.rgb.b, c.a);
        }
        case ParamType::Vector: {
            const auto v = read<Vec3f>(at);
            return nb::make_tuple(v.x, v.y, v.z);
        }
        case ParamType::Vector2: {
            const auto v = read<Vec2f>(at);
            return nb::make_tuple(v.x, v.y);
        }
        case ParamType::String: return nb::cast(read<Name>(at).view());
        case ParamType::Enum:
            return nb::cast(
                param.enumerators.at(static_cast<std::size_t>(read<std::int32_t>(at))));
        case ParamType::Matrix: return matrix(read<Mat4f>(at));
        case ParamType::Node:
        case ParamType::Closure: break;
    }
    return nb::none();
}

nb::object default_of(const NodeType& type, const ParamInfo& param) {
    const std::byte* at = type.default_block.data() + param.offset;
    if (!param.is_array) return value_at(param, at);
    // All Array<T> have one layout; the element type only steps through the data.
    const auto array = read<Array<std::byte>>(at);
    nb::list out;
    for (std::size_t i = 0; i < array.n; ++i)
        out.append(value_at(param, array.data + i * type_size(param.type)));
    return out;
}

std::string_view output_text(OutputType output) {
    switch (output) {
        case OutputType::Float: return "FLOAT";
        case OutputType::Vector: return "VECTOR";
        case OutputType::Rgb: return "RGB";
        case OutputType::Rgba: return "RGBA";
        case OutputType::Closure: return "CLOSURE";
        case OutputType::String: return "STRING";
        case OutputType::Matrix: return "MATRIX";
        case OutputType::None: break;
    }
    return "";
}

nb::dict describe(const NodeType& type, const ParamInfo& param) {
    nb::dict out;
    out["name"] = param.name.view();
    out["type"] = type_text(param.type);
    out["array"] = param.is_array;
    out["default"] = default_of(type, param);
    out["doc"] = param.doc;
    out["unit"] = param.unit;
    out["low"] = param.low;
    out["high"] = param.high;
    out["hard_range"] = param.hard_range;
    out["enumerators"] = param.enumerators;
    out["status"] = param.ignored ? "ignored" : param.pending ? "pending" : "supported";
    return out;
}

nb::dict describe(const LobeInfo& lobe) {
    Event event{lobe.kind, lobe.lobe, {}};
    if (!lobe.label.empty()) event.labels.push_back(lobe.label);
    nb::dict out;
    out["event"] = lpe::print_event(event);
    out["label"] = lobe.label;
    out["doc"] = lobe.doc;
    return out;
}

nb::dict describe(const NodeType& type) {
    nb::list params, lobes;
    for (const ParamInfo& param : type.params)
        params.append(describe(type, param));
    for (const LobeInfo& lobe : type.lobes)
        lobes.append(describe(lobe));
    nb::dict out;
    out["name"] = type.name.view();
    out["kind"] = kind_text(type.kind);
    out["doc"] = type.doc;
    out["output"] = output_text(type.output);
    out["params"] = params;
    out["lobes"] = lobes;
    return out;
}

}  // namespace

void add_nodes(nb::module_& module) {
    module.def(
        "nodes",
        [] {
            Registry registry;
            add_all_nodes(registry);
            nb::list out;
            for (const NodeType* type : registry.all())
                out.append(describe(*type));
            return out;
        },
        nb::sig("def nodes() -> list[dict[str, typing.Any]]"),
        "Every node type with its parameters and lobes, by name.");
}

}  // namespace lightsieve::python
