#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>

#include "volmesh/memory.hh"

namespace maille::volmesh {

/// A long array of plain values that grows well: large ones move by remapping their pages, so that nothing is
/// copied and there are never two of them, and `grow` leaves new values unset. Otherwise as std::vector.
template <class T>
class Column {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= memory_alignment);

  public:
    using value_type = T;

    Column() = default;
    Column(const Column& other) { assign(std::span<const T>(other.data(), other.size())); }
    Column(Column&& other) noexcept { swap(other); }
    Column& operator=(Column other) noexcept {
        swap(other);
        return *this;
    }
    ~Column() { release_memory(data_, capacity_ * sizeof(T)); }

    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }
    T* begin() { return data_; }
    T* end() { return data_ + size_; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }

    /// To so many values, of which the new ones are not set.
    void grow(std::size_t n) {
        if (n > capacity_) reserve(std::max(n, capacity_ + capacity_ / 2));
        size_ = n;
    }
    void resize(std::size_t n, const T& value) {
        const std::size_t before = size_;
        const T copy = value;
        grow(n);
        if (n > before) std::uninitialized_fill(data_ + before, data_ + n, copy);
    }
    void push_back(const T& value) { resize(size_ + 1, value); }
    void assign(std::size_t n, const T& value) {
        clear();
        resize(n, value);
    }
    void assign(std::span<const T> values) {
        grow(values.size());
        std::uninitialized_copy(values.begin(), values.end(), data_);
    }
    void clear() { size_ = 0; }
    /// Gives the memory behind the last value back, as far as it is much; growing takes it again.
    void trim() { give_back_memory(data_, size_ * sizeof(T), capacity_ * sizeof(T)); }
    void swap(Column& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

  private:
    void reserve(std::size_t n) {
        data_ = static_cast<T*>(resized_memory(data_, capacity_ * sizeof(T), n * sizeof(T)));
        capacity_ = n;
    }

    T* data_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace maille::volmesh
