// Builds a `NodeType` from a plain parameter struct: one line a parameter, one a lobe.
//
//     struct Lambert { float Kd = 0.7F; static NodeType describe(); void eval(const ShadePoint&, ClosureSet&) const; };
//     NodeType Lambert::describe() {
//         Describe<Lambert> d("lambert", NodeKind::Shader, "Ideal diffuse reflection.");
//         d.param("Kd", &Lambert::Kd, "Weight of the diffuse lobe.").range(0, 1);
//         return d.done();
//     }
//
// `done()` finds the functions that the struct has: eval, prepare, reads_coordinates, make_light, make_light_filter,
// make_geometry, make_camera, make_filter, make_driver, make_imager, make_color_spaces, edit_scene, possible_texts. Types and offsets come from the member pointers: nothing is written twice.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "scene/node_type.h"

namespace lightsieve {

namespace describe_detail {

template <class M>
struct IsArray : std::false_type {};
template <class E>
struct IsArray<Array<E>> : std::true_type {
    using Element = E;
};

template <class M>
struct IsLazy : std::false_type {};
template <class E>
struct IsLazy<Lazy<E>> : std::true_type {
    using Element = E;
};

template <class M>
constexpr ParamType param_type() {
    if constexpr (std::is_same_v<M, bool>)
        return ParamType::Bool;
    else if constexpr (std::is_same_v<M, std::uint8_t>)
        return ParamType::Byte;
    else if constexpr (std::is_enum_v<M>)
        return ParamType::Enum;
    else if constexpr (std::is_same_v<M, std::int32_t>)
        return ParamType::Int;
    else if constexpr (std::is_same_v<M, std::uint32_t>)
        return ParamType::UInt;
    else if constexpr (std::is_same_v<M, float>)
        return ParamType::Float;
    else if constexpr (std::is_same_v<M, Color>)
        return ParamType::Rgb;
    else if constexpr (std::is_same_v<M, Rgba>)
        return ParamType::Rgba;
    else if constexpr (std::is_same_v<M, Vec3f>)
        return ParamType::Vector;
    else if constexpr (std::is_same_v<M, Vec2f>)
        return ParamType::Vector2;
    else if constexpr (std::is_same_v<M, Name>)
        return ParamType::String;
    else if constexpr (std::is_same_v<M, Mat4f>)
        return ParamType::Matrix;
    else if constexpr (std::is_same_v<M, NodeRef>)
        return ParamType::Node;
    else {
        static_assert(std::is_same_v<M, ShaderRef>, "not a parameter type");
        return ParamType::Closure;
    }
}

inline ShaderValue to_value(float v) { return {{v, v, v}, v}; }
inline ShaderValue to_value(std::int32_t v) { return to_value(static_cast<float>(v)); }
inline ShaderValue to_value(bool v) { return to_value(v ? 1.0F : 0.0F); }
inline ShaderValue to_value(Color v) { return {v, 1}; }
inline ShaderValue to_value(Vec2f v) { return {{v.x, v.y, 0}, 1}; }
inline ShaderValue to_value(Vec3f v) { return {{v.x, v.y, v.z}, 1}; }
inline ShaderValue to_value(Rgba v) { return v; }
template <class R>
constexpr OutputType output_type() {
    if constexpr (std::is_same_v<R, float> || std::is_same_v<R, std::int32_t> ||
                  std::is_same_v<R, bool>)
        return OutputType::Float;
    else if constexpr (std::is_same_v<R, Color>)
        return OutputType::Rgb;
    else if constexpr (std::is_same_v<R, Vec3f> || std::is_same_v<R, Vec2f>)
        return OutputType::Vector;
    else if constexpr (std::is_same_v<R, Name>)
        return OutputType::String;
    else if constexpr (std::is_same_v<R, Mat4f>)
        return OutputType::Matrix;
    else
        return OutputType::Rgba;
}

}  // namespace describe_detail

/// Adds details to the parameter that was described last.
class ParamBuilder {
  public:
    explicit ParamBuilder(ParamInfo& info) : info_(info) {}
    /// Sensible values; others are accepted.
    ParamBuilder& range(float low, float high) { return set_range(low, high, false); }
    /// Values outside make no sense: clamped with a warning.
    ParamBuilder& hard_range(float low, float high) { return set_range(low, high, true); }
    ParamBuilder& unit(std::string text) {
        info_.unit = std::move(text);
        return *this;
    }
    /// Names of an enumeration's values 0, 1, 2, ...
    ParamBuilder& names(std::vector<std::string> enumerators) {
        info_.enumerators = std::move(enumerators);
        return *this;
    }
    /// Accepted without effect: it steers only Arnold's own sampling or its host applications.
    ParamBuilder& ignored() {
        info_.ignored = true;
        return *this;
    }
    /// Accepted, but any value other than the default is reported as not supported yet.
    ParamBuilder& pending() {
        info_.pending = true;
        return *this;
    }

  private:
    ParamBuilder& set_range(float low, float high, bool hard) {
        info_.low = low;
        info_.high = high;
        info_.hard_range = hard;
        return *this;
    }
    ParamInfo& info_;
};

template <class T>
class Describe {
    static_assert(std::is_trivially_copyable_v<T>, "parameter structs are copied byte by byte");

  public:
    Describe(const char* name, NodeKind kind, std::string doc) {
        type_.name = name;
        type_.kind = kind;
        type_.doc = std::move(doc);
        type_.block_size = sizeof(T);
        type_.block_align = alignof(T);
    }

    template <class Owner, class M>
        requires std::derived_from<T, Owner>
    ParamBuilder param(const char* name, M Owner::* member, std::string doc) {
        return add(name, defaults_.*member, std::move(doc));
    }
    /// The same for a part of a member: `of(defaults)` gives it by reference. For nodes with many inputs of one kind:
    ///
    ///     d.part("input" + n, [i](Switch& p) -> Rgba& { return p.input[i]; }, "...");
    template <class Of>
    ParamBuilder part(const std::string& name, const Of& of, std::string doc) {
        return add(name, of(defaults_), std::move(doc));
    }

    /// Declares lobe number `index`; indices count from 0 in the order of declaration.
    void lobe(int index, EventKind kind, EventLobe lobe, const char* label, std::string doc) {
        type_.lobes.push_back({index, kind, lobe, label, std::move(doc)});
    }
    /// Declares lobe number `index`: subsurface scattering, event TD.
    void lobe_below_surface(int index, std::string doc) {
        lobe(index, EventKind::Transmission, EventLobe::Diffuse, "", std::move(doc));
        type_.lobes.back().below_surface = true;
    }

    /// The shader's result depends on ShadePoint::ray_type.
    void reads_ray_type() { type_.reads_ray_type = true; }
    /// The shader says what fills a volume.
    void fills_volumes() { type_.fills_volumes = true; }

    [[nodiscard]] NodeType done() {
        type_.default_block.resize(sizeof(T));
        std::memcpy(type_.default_block.data(), &defaults_, sizeof(T));
        add_shading();
        if constexpr (requires(const T& t) { t.reads_coordinates(); })
            type_.reads_coordinates = [](const void* block) {
                return static_cast<const T*>(block)->reads_coordinates();
            };
        if constexpr (requires(T& t, NodeContext& c) { t.prepare(c); })
            type_.prepare = [](void* block, NodeContext& c) {
                static_cast<T*>(block)->prepare(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_light(c); })
            type_.make_light = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_light(c);
            };
        if constexpr (requires(const T& t, NodeContext& c, const LightPlace& p) {
                          t.make_light_filter(c, p);
                      })
            type_.make_light_filter = [](const void* block, NodeContext& c, const LightPlace& p) {
                return static_cast<const T*>(block)->make_light_filter(c, p);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.possible_texts(c); })
            type_.possible_texts = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->possible_texts(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_geometry(c); })
            type_.make_geometry = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_geometry(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_camera(c); })
            type_.make_camera = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_camera(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_filter(c); })
            type_.make_filter = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_filter(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_driver(c); })
            type_.make_driver = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_driver(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_imager(c); })
            type_.make_imager = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_imager(c);
            };
        if constexpr (requires(const T& t, NodeContext& c) { t.make_color_spaces(c); })
            type_.make_color_spaces = [](const void* block, NodeContext& c) {
                return static_cast<const T*>(block)->make_color_spaces(c);
            };
        if constexpr (requires(const T& t, OperatorContext& c) { t.edit_scene(c); })
            type_.edit_scene = [](const void* block, OperatorContext& c) {
                static_cast<const T*>(block)->edit_scene(c);
            };
        if constexpr (std::is_convertible_v<const T*, const ShapeCommon*>)
            type_.shape_common = [](const void* block) -> const ShapeCommon* {
                return static_cast<const T*>(block);
            };
        if constexpr (std::is_convertible_v<const T*, const LightCommon*>)
            type_.light_common = [](const void* block) -> const LightCommon* {
                return static_cast<const T*>(block);
            };
        return std::move(type_);
    }

  private:
    template <class M>
    ParamBuilder add(const std::string& name, const M& value, std::string doc) {
        using namespace describe_detail;
        ParamInfo info;
        info.name = name;
        info.doc = std::move(doc);
        info.offset = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&value) -
                                               reinterpret_cast<const std::byte*>(&defaults_));
        if constexpr (IsArray<M>::value) {
            info.is_array = true;
            info.type = param_type<typename IsArray<M>::Element>();
        } else if constexpr (IsLazy<M>::value) {
            static_assert(std::is_standard_layout_v<M>, "the value lies first");
            info.type = param_type<typename IsLazy<M>::Element>();
            info.lazy_offset = info.offset + offsetof(M, link);
        } else {
            info.type = param_type<M>();
            if constexpr (std::is_enum_v<M>) static_assert(sizeof(M) == sizeof(std::int32_t));
        }
        type_.params.push_back(std::move(info));
        return ParamBuilder(type_.params.back());
    }

    void add_shading() {
        if constexpr (requires(const T& t, const ShadePoint& at, ClosureSet& out) {
                          t.eval(at, out);
                      }) {
            type_.eval_closure = [](const void* block, const ShadePoint& at, ClosureSet& out) {
                static_cast<const T*>(block)->eval(at, out);
            };
            type_.output = OutputType::Closure;
            // A node may also compute with colours (add, multiply): then it can drive parameters too.
            if constexpr (requires(const T& t, const ShadePoint& at) { t.value(at); }) {
                type_.eval_value = [](const void* block, const ShadePoint& at) {
                    return describe_detail::to_value(static_cast<const T*>(block)->value(at));
                };
                type_.output =
                    describe_detail::output_type<decltype(std::declval<const T&>().value(
                        std::declval<const ShadePoint&>()))>();
            }
        } else if constexpr (requires(const T& t, const ShadePoint& at) { t.eval(at); }) {
            using Result =
                decltype(std::declval<const T&>().eval(std::declval<const ShadePoint&>()));
            type_.output = describe_detail::output_type<Result>();
            const auto eval = [](const void* block, const ShadePoint& at) {
                return static_cast<const T*>(block)->eval(at);
            };
            if constexpr (std::is_same_v<Result, Name>)
                type_.eval_text = eval;
            else if constexpr (std::is_same_v<Result, Mat4f>)
                type_.eval_matrix = eval;
            else
                type_.eval_value = [](const void* block, const ShadePoint& at) {
                    return describe_detail::to_value(static_cast<const T*>(block)->eval(at));
                };
        }
    }

    T defaults_{};
    NodeType type_;
};

}  // namespace lightsieve
