#include "scene/value_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "scene/ass_packed.h"
#include "scene/ass_write.h"

namespace lightsieve {
namespace {

/// Numbers on one line of an array.
constexpr std::size_t kNumbersPerLine = 12;

template <class T>
T load(const std::byte* data) {
    T value;
    std::memcpy(&value, data, sizeof(T));
    return value;
}

std::string floats_text(const std::byte* data, std::size_t n) {
    std::string out;
    for (std::size_t i = 0; i < n; ++i) {
        if (i > 0) out += ' ';
        out += float_text(load<float>(data + i * sizeof(float)));
    }
    return out;
}

std::string node_text(const std::byte* data) {
    const auto* node = load<const NodeInstance*>(data);
    return node == nullptr ? "NULL" : quote_ass(node->name().view());
}

}  // namespace

std::string float_text(float value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

std::string value_text(ParamType type, const std::byte* data, const ParamInfo* info) {
    switch (type) {
        case ParamType::Bool: return load<std::uint8_t>(data) != 0 ? "on" : "off";
        case ParamType::Byte: return std::to_string(load<std::uint8_t>(data));
        case ParamType::UInt: return std::to_string(load<std::uint32_t>(data));
        case ParamType::Int: return std::to_string(load<std::int32_t>(data));
        case ParamType::String: return quote_ass(load<Name>(data).view());
        case ParamType::Node:
        case ParamType::Closure: return node_text(data);
        case ParamType::Enum: {
            const auto index = load<std::int32_t>(data);
            const bool named = info != nullptr && index >= 0 &&
                               static_cast<std::size_t>(index) < info->enumerators.size();
            return named ? quote_ass(info->enumerators[static_cast<std::size_t>(index)])
                         : std::to_string(index);
        }
        default: return floats_text(data, component_count(type));
    }
}

std::string array_text(ParamType type, const std::byte* data, std::size_t n, std::size_t n_keys,
                       const ParamInfo* info, std::string_view indent) {
    std::string out = std::to_string(n) + " " + std::to_string(n_keys) + " " +
                      std::string(type_text(type == ParamType::Closure ? ParamType::Node : type));
    const std::size_t per_line = std::max<std::size_t>(1, kNumbersPerLine / component_count(type));
    for (std::size_t i = 0; i < n * n_keys; ++i) {
        if (i % per_line == 0)
            (out += '\n') += indent;
        else
            out += ' ';
        out += value_text(type, data + i * type_size(type), info);
    }
    return out;
}

}  // namespace lightsieve
