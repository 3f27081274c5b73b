#include "render/shader_program.h"

#include <cmath>
#include <cstring>
#include <new>

#include "core/arena.h"
#include "core/error.h"

namespace lightsieve {
namespace {

/// Parameter structs hold nothing that needs more.
constexpr std::size_t kBlockAlign = 16;

float component_of(const ShaderValue& v, int i) {
    return i == 0 ? v.rgb.r : i == 1 ? v.rgb.g : i == 2 ? v.rgb.b : v.a;
}

template <class T>
void store(std::byte* at, T value) {
    std::memcpy(at, &value, sizeof(T));
}

/// A linked float that is not finite becomes 0: one bad texel must not darken a picture.
float finite(float v) { return std::isfinite(v) ? v : 0; }

std::int32_t to_int(float v) {
    constexpr float kLargest = 2147483520.0F;  // largest float below 2^31
    return static_cast<std::int32_t>(std::lround(std::fmin(std::fmax(v, -kLargest), kLargest)));
}

/// Writes one number into a scalar parameter. Colours as floats: the mean of the channels.
void store_scalar(std::byte* at, ParamType type, float v) {
    switch (type) {
        case ParamType::Bool: return store(at, v != 0);
        case ParamType::Byte:
            return store(at, static_cast<std::uint8_t>(std::fmin(std::fmax(v, 0.0F), 255.0F)));
        case ParamType::Int:
        case ParamType::Enum: return store(at, to_int(v));
        case ParamType::UInt:
            return store(at,
                         static_cast<std::uint32_t>(std::fmin(std::fmax(v, 0.0F), 4294967040.0F)));
        default: return store(at, v);
    }
}

/// Memory for one patched block, given back when the evaluation ends: networks nest, so the arena works as a stack.
class Scratch {
  public:
    explicit Scratch(std::size_t size)
        : mark_(arena().mark()),
          bytes_(static_cast<std::byte*>(arena().allocate(size, kBlockAlign))) {}
    ~Scratch() { arena().release(mark_); }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    [[nodiscard]] std::byte* bytes() const { return bytes_; }

  private:
    static Arena& arena() {
        static thread_local Arena per_thread;
        return per_thread;
    }
    Arena::Mark mark_;
    std::byte* bytes_;
};

int n_components(ParamType type) {
    switch (type) {
        case ParamType::Rgb:
        case ParamType::Vector: return 3;
        case ParamType::Rgba: return 4;
        case ParamType::Vector2: return 2;
        default: return 1;
    }
}

void store_value(std::byte* block, const ShaderProgram::Patch& p, const ShaderValue& v,
                 OutputType from) {
    std::byte* at = block + p.offset;
    const bool scalar_source = p.source_component >= 0;
    // A colour that drives a float gives the mean of its channels.
    const float mean = from == OutputType::Float ? v.rgb.r : average(v.rgb);
    const float one = finite(scalar_source ? component_of(v, p.source_component) : mean);
    const int n = n_components(p.type);
    if (n == 1) return store_scalar(at, p.type, one);
    if (p.component >= 0) {
        if (p.component < n)
            store(at + static_cast<std::size_t>(p.component) * sizeof(float), one);
        return;
    }
    for (int i = 0; i < n; ++i) {
        const float x = scalar_source ? one : finite(component_of(v, i));
        store(at + static_cast<std::size_t>(i) * sizeof(float),
              scalar_source && i == 3 ? 1.0F : x);
    }
}

}  // namespace

ShaderProgram::ShaderProgram(const NodeType& type, const std::byte* block)
    : type_(&type),
      block_(static_cast<std::byte*>(
          ::operator new[](type.block_size, std::align_val_t{kBlockAlign}))) {
    LIGHTSIEVE_ASSERT(type.block_align <= kBlockAlign, type.name.str());
    std::memcpy(block_.get(), block, type.block_size);
}

void ShaderProgram::patch(std::byte* copy, const ShadePoint& at) const {
    std::memcpy(copy, block_.get(), type_->block_size);
    for (const Patch& p : patches_)
        store_value(copy, p, p.source->value(at), p.source->type().output);
}

ShaderValue ShaderProgram::value(const ShadePoint& at) const {
    if (type_->eval_value == nullptr) return {kBlack, 1};
    if (patches_.empty()) return type_->eval_value(block_.get(), at);
    const Scratch copy(type_->block_size);
    patch(copy.bytes(), at);
    return type_->eval_value(copy.bytes(), at);
}

void ShaderProgram::closures(const ShadePoint& at, ClosureSet& out) const {
    // A shader of shaders goes on with its own lobes afterwards.
    const std::span<const LobeRecord> outer = out.records();
    const IndirectFactors outer_indirect = out.indirect();
    out.set_records(records);
    out.set_indirect({});
    if (type_->eval_closure == nullptr) {
        out.emit(0, value(at).rgb);
    } else if (patches_.empty()) {
        type_->eval_closure(block_.get(), at, out);
    } else {
        const Scratch copy(type_->block_size);
        patch(copy.bytes(), at);
        type_->eval_closure(copy.bytes(), at, out);
    }
    out.set_records(outer);
    out.set_indirect(outer_indirect);
}

}  // namespace lightsieve
