// Plain values and vectors of them to bytes and back, as this machine holds them in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace lightsieve {

class ByteWriter {
  public:
    template <class T>
        requires std::is_trivially_copyable_v<T>
    void put(const T& value) {
        append(&value, sizeof(T));
    }
    /// The length, then the elements.
    template <class T>
        requires std::is_trivially_copyable_v<T>
    void put(const std::vector<T>& values) {
        put(static_cast<std::uint64_t>(values.size()));
        append(values.data(), values.size() * sizeof(T));
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(const void* data, std::size_t size) {
        const std::size_t before = bytes_.size();
        bytes_.resize(before + size);
        if (size > 0) std::memcpy(bytes_.data() + before, data, size);
    }
    std::vector<std::byte> bytes_;
};

/// Reads what a ByteWriter wrote. After the first read past the end every read fails and changes nothing.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : left_(bytes) {}

    template <class T>
        requires std::is_trivially_copyable_v<T>
    bool get(T& value) {
        if (!has(sizeof(T))) return false;
        std::memcpy(static_cast<void*>(&value), left_.data(), sizeof(T));
        left_ = left_.subspan(sizeof(T));
        return true;
    }
    /// size  that the vector must have
    template <class T>
        requires std::is_trivially_copyable_v<T>
    bool get(std::vector<T>& values, std::size_t size) {
        std::uint64_t n = 0;
        if (!get(n) || n != size || !has(size * sizeof(T))) return good_ = false;
        values.resize(size);
        if (size > 0)
            std::memcpy(static_cast<void*>(values.data()), left_.data(), size * sizeof(T));
        left_ = left_.subspan(size * sizeof(T));
        return true;
    }
    /// Everything was there, and nothing is left.
    [[nodiscard]] bool done() const { return good_ && left_.empty(); }

  private:
    bool has(std::size_t size) { return good_ = good_ && left_.size() >= size; }
    std::span<const std::byte> left_;
    bool good_ = true;
};

}  // namespace lightsieve
