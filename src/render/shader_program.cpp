#include "render/shader_program.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "core/arena.h"
#include "core/error.h"
#include "scene/value.h"

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

/// Writes a linked value into a parameter, as Arnold converts types.
void store_value(std::byte* at, const ShaderProgram::Patch& p, const ShaderValue& v,
                 OutputType from) {
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

/// Where an array parameter keeps its data pointer: every Array<T> begins with it.
std::byte*& array_data(std::byte* param) { return *reinterpret_cast<std::byte**>(param); }

}  // namespace

ShaderProgram::ShaderProgram(const NodeType& type, const std::byte* block)
    : type_(&type),
      block_(static_cast<std::byte*>(
          ::operator new[](type.block_size, std::align_val_t{kBlockAlign}))),
      scratch_size_(type.block_size) {
    LIGHTSIEVE_ASSERT(type.block_align <= kBlockAlign, type.name.str());
    std::memcpy(block_.get(), block, type.block_size);
}

void ShaderProgram::add_link(const ParamInfo& param, std::int32_t element, Patch patch) {
    patch.type = param.type;
    if (param.lazy_offset != 0) {
        auto& link = *reinterpret_cast<LazyLink*>(block_.get() + param.lazy_offset);
        if (link.links == nullptr) {
            lazy_.push_back(std::make_shared<LazyPatches>());
            link.links = lazy_.back().get();
            link.apply = [](const void* links, void* value, const ShadePoint& at) {
                for (const Patch& p : *static_cast<const LazyPatches*>(links))
                    apply(p, static_cast<std::byte*>(value), at);
            };
        }
        // The block was made by add_link, so the list is one of ours.
        patch.offset = 0;
        const_cast<LazyPatches*>(static_cast<const LazyPatches*>(link.links))->push_back(patch);
        return;
    }
    patch.offset = param.offset;
    if (param.is_array && element >= 0) {
        const auto& values =
            *reinterpret_cast<const Array<std::byte>*>(block_.get() + param.offset);
        if (static_cast<std::uint32_t>(element) >= values.n) return;
        const auto known = std::find_if(arrays_.begin(), arrays_.end(), [&](const LinkedArray& a) {
            return a.offset == param.offset;
        });
        patch.array = static_cast<int>(known - arrays_.begin());
        patch.offset = static_cast<std::size_t>(element) * type_size(param.type);
        if (known == arrays_.end()) {
            const std::size_t n_bytes =
                std::size_t{values.n} * values.n_keys * type_size(param.type);
            const std::size_t place =
                (scratch_size_ + kBlockAlign - 1) / kBlockAlign * kBlockAlign;
            arrays_.push_back({param.offset, n_bytes, place});
            scratch_size_ = place + n_bytes;
        }
    }
    patches_.push_back(patch);
}

bool ShaderProgram::reads_coordinates() const {
    if (is_linked() || type_->reads_coordinates == nullptr) return true;
    return type_->reads_coordinates(block()) ||
           std::any_of(parts.begin(), parts.end(),
                       [](const ShaderProgram* part) { return part->reads_coordinates(); });
}

void ShaderProgram::share_links(const ShaderProgram& other) {
    patches_ = other.patches_;
    arrays_ = other.arrays_;
    lazy_ = other.lazy_;
    scratch_size_ = other.scratch_size_;
}

void ShaderProgram::apply(const Patch& p, std::byte* at, const ShadePoint& point) {
    const OutputType from = p.source->type().output;
    if (from == OutputType::String) {
        if (p.type == ParamType::String) store(at, p.source->text(point));
    } else if (from == OutputType::Matrix) {
        if (p.type == ParamType::Matrix) store(at, p.source->matrix(point));
    } else if (p.type != ParamType::String && p.type != ParamType::Matrix) {
        store_value(at, p, p.source->value(point), from);
    }
}

void ShaderProgram::patch(std::byte* copy, const ShadePoint& at) const {
    std::memcpy(copy, block_.get(), type_->block_size);
    for (const LinkedArray& array : arrays_) {
        std::byte*& data = array_data(copy + array.offset);
        std::memcpy(copy + array.place, data, array.n_bytes);
        data = copy + array.place;
    }
    for (const Patch& p : patches_) {
        std::byte* target =
            p.array < 0 ? copy : copy + arrays_[static_cast<std::size_t>(p.array)].place;
        apply(p, target + p.offset, at);
    }
}

template <class Body>
auto ShaderProgram::with_block(const ShadePoint& at, const Body& body) const {
    if (patches_.empty()) return body(static_cast<const void*>(block_.get()));
    const Scratch copy(scratch_size_);
    patch(copy.bytes(), at);
    return body(static_cast<const void*>(copy.bytes()));
}

ShaderValue ShaderProgram::value(const ShadePoint& at) const {
    if (type_->eval_value == nullptr) return {kBlack, 1};
    return with_block(at, [&](const void* block) { return type_->eval_value(block, at); });
}

Name ShaderProgram::text(const ShadePoint& at) const {
    if (type_->eval_text == nullptr) return {};
    return with_block(at, [&](const void* block) { return type_->eval_text(block, at); });
}

Mat4f ShaderProgram::matrix(const ShadePoint& at) const {
    if (type_->eval_matrix == nullptr) return {};
    return with_block(at, [&](const void* block) { return type_->eval_matrix(block, at); });
}

void ShaderProgram::closures(const ShadePoint& at, ClosureSet& out) const {
    // A shader of shaders goes on with its own lobes afterwards.
    const std::span<const LobeRecord> outer = out.records();
    const IndirectFactors outer_indirect = out.indirect();
    out.set_records(records);
    out.set_indirect({});
    if (type_->eval_closure == nullptr)
        out.emit(0, value(at).rgb);
    else
        with_block(at, [&](const void* block) { type_->eval_closure(block, at, out); });
    out.set_records(outer);
    out.set_indirect(outer_indirect);
}

}  // namespace lightsieve
