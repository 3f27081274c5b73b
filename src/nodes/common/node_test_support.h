// For tests: one node with parameters set by name, and surroundings that answer with plain values.
//
// No scene file and no graph, so that a node's test needs the node alone.
#pragma once

#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/describe.h"
#include "scene/node_context.h"
#include "scene/shape.h"

namespace lightsieve {

/// A node's surroundings; links and the frame are set by the test.
class TestContext final : public NodeContext {
  public:
    [[nodiscard]] Diagnostics& diagnostics() override { return diagnostics_; }
    [[nodiscard]] SourceSpan where(Name param) const override {
        auto text = std::make_shared<const SourceText>(SourceText{"test.ass", param.str()});
        return {text, 0, text->text.size()};
    }
    [[nodiscard]] Name node_name() const override { return "tested"; }
    [[nodiscard]] ColorInput color_input(Name) override {
        if (!shader) return ColorInput(kWhite);
        return {&shader, [](const void* program, const ShadePoint& at) {
                    return ShaderValue{(*static_cast<const Shader*>(program))(at), 1};
                }};
    }
    [[nodiscard]] bool is_linked(Name param) const override {
        return linked.contains(param.str());
    }
    [[nodiscard]] std::vector<Name> possible_texts(Name param) override {
        const auto found = texts.find(param.str());
        return found == texts.end() ? std::vector<Name>{} : found->second;
    }
    [[nodiscard]] TextureCache& textures() override {
        report_bug("no textures in this test", __FILE__, __LINE__, "");
    }
    [[nodiscard]] std::optional<std::string> find_asset(std::string_view) const override {
        return std::nullopt;
    }
    [[nodiscard]] bool ignore_missing_textures() const override { return false; }
    [[nodiscard]] Frame frame() const override { return size; }
    [[nodiscard]] std::unique_ptr<ShapeGeometry> geometry_of(NodeRef, Mat4f&) override {
        return nullptr;
    }

    /// Reports of that code.
    [[nodiscard]] std::size_t count(Code code) const {
        std::size_t n = 0;
        for (const Error& item : diagnostics_.items())
            n += item.code == code ? 1 : 0;
        return n;
    }

    using Shader = std::function<Color(const ShadePoint&)>;
    Shader shader;  ///< what drives colours; none: they are white
    std::set<std::string> linked;
    std::map<std::string, std::vector<Name>> texts;  ///< for possible_texts, by parameter
    Frame size{160, 120, 1};

  private:
    Diagnostics diagnostics_;
};

/// A parameter block with values set by name; a wrong name or type stops the test.
class TestNode {
  public:
    explicit TestNode(NodeType type)
        : type_(std::move(type)),
          block_(
              static_cast<std::byte*>(::operator new[](type_.block_size, std::align_val_t{16}))) {
        std::memcpy(block_.get(), type_.default_block.data(), type_.block_size);
    }

    template <class T>
    TestNode& set(const char* param, T value) {
        std::memcpy(at<T>(param), &value, sizeof(T));
        return *this;
    }
    /// Enumerations by their integer.
    TestNode& set_enum(const char* param, std::int32_t value) {
        const ParamInfo* info = type_.find(param);
        LIGHTSIEVE_ASSERT(info != nullptr && info->type == ParamType::Enum, std::string(param));
        std::memcpy(block_.get() + info->offset, &value, sizeof(value));
        return *this;
    }
    /// `values` are all keys, one after the other.
    template <class E>
    TestNode& set_array(const char* param, std::vector<E> values, std::uint32_t n_keys = 1) {
        auto kept = std::make_shared<std::vector<E>>(std::move(values));
        kept_.push_back(kept);
        return set(param, Array<E>{kept->data(), static_cast<std::uint32_t>(kept->size()) / n_keys,
                                   n_keys});
    }
    template <class T>
    [[nodiscard]] T get(const char* param) const {
        T value;
        std::memcpy(&value, const_cast<TestNode*>(this)->at<T>(param), sizeof(T));
        return value;
    }

    [[nodiscard]] const NodeType& type() const { return type_; }
    [[nodiscard]] void* block() { return block_.get(); }
    [[nodiscard]] const void* block() const { return block_.get(); }

  private:
    template <class T>
    std::byte* at(const char* param) {
        using namespace describe_detail;
        const ParamInfo* info = type_.find(param);
        LIGHTSIEVE_ASSERT(info != nullptr, std::string("no parameter ") + param);
        bool fits = false;
        if constexpr (IsArray<T>::value)
            fits = info->is_array && info->type == param_type<typename IsArray<T>::Element>();
        else
            fits = !info->is_array && info->type == param_type<T>();
        LIGHTSIEVE_ASSERT(fits, std::string("wrong type for ") + param);
        return block_.get() + info->offset;
    }
    struct FreeBlock {
        void operator()(std::byte* p) const { ::operator delete[](p, std::align_val_t{16}); }
    };

    NodeType type_;
    std::unique_ptr<std::byte[], FreeBlock> block_;
    std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace lightsieve
