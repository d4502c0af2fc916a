// Archives: the bytes of a checkpoint.
//
// A module type with members in addition to its parameters declares
//
//     void checkpoint(Archive& archive) { archive(weights_, step_, open_); }
//
// and this one list serves both to write and to read them. It need not name members that start() computes
// from the ports and the parameters. modules/adaptive_layer/module.h is an example.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace forage {

/// A checkpoint does not fit the object into which it is read.
class __attribute__((visibility("default"))) ArchiveError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Writes values, or reads them back in the same order: numbers, booleans, enumerations, strings, vectors,
/// deques, arrays, maps, pairs, optional values, Eigen's matrices and arrays, and objects with a member
/// `checkpoint(Archive&)`. The bytes are those of little-endian memory; equal values give equal bytes.
class Archive {
  public:
    /// How NaN values are written. Their sign and payload may depend on the processor.
    enum class Nan { as_it_is, all_the_same };

    /// An archive that writes.
    explicit Archive(Nan nan = Nan::as_it_is) : same_nan_(nan == Nan::all_the_same) {}
    /// Takes bytes in the order in which they are written.
    using Sink = std::function<void(std::string_view)>;
    /// An archive that writes into `sink`, and keeps nothing.
    explicit Archive(Sink sink) : sink_(std::move(sink)) {}
    /// An archive that reads `bytes`, which must outlive it.
    explicit Archive(std::string_view bytes) : left_(bytes), loading_(true) {}

    bool loading() const { return loading_; }
    const std::string& bytes() const { return bytes_; }  ///< written so far
    std::string_view left() const { return left_; }      ///< not read yet

    /// Writes or reads the values, in order. Throws ArchiveError when there is nothing left to read.
    template <class... T>
    void operator()(T&... values) {
        (value(values), ...);
    }

    /// Writes or reads `count` numbers.
    template <class T>
    void numbers(T* first, std::size_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (count == 0) return;  // `first` may be null
        if (loading_) {
            std::memcpy(static_cast<void*>(first), take(count, sizeof(T)), count * sizeof(T));
            return;
        }
        const std::string_view written(reinterpret_cast<const char*>(first), count * sizeof(T));
        if (sink_) return sink_(written);
        bytes_ += written;
        if constexpr (std::is_floating_point_v<T>)
            if (same_nan_) write_same_nan(first, count);
    }

    /// Writes a value that cannot change, or checks it: throws ArchiveError with the name `what` when the
    /// value in the archive differs.
    template <class T>
    void same(const T& here, std::string_view what) {
        T there = here;
        (*this)(there);
        if (!(there == here))
            throw ArchiveError("the checkpoint is of something else: " + std::string(what) + " differs");
    }

  private:
    static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

    /// Sizes of WebAssembly, which has 32 bits, are written as those of others, so that digests are equal.
    /// They are `long` there; where they are `int`, every int would be written as if it were a size.
    static_assert(sizeof(std::size_t) == 8 || !std::is_same_v<std::size_t, std::uint32_t>,
                  "sizes have a type of their own");
    template <class T>
    static constexpr bool narrow = sizeof(T) < 8 &&
                                   (std::is_same_v<T, std::size_t> || std::is_same_v<T, std::ptrdiff_t>);

    /// Replaces every NaN among the `count` numbers that were written last.
    template <class T>
    void write_same_nan(const T* first, std::size_t count) {
        constexpr T nan = std::numeric_limits<T>::quiet_NaN();
        char* written = bytes_.data() + bytes_.size() - count * sizeof(T);
        for (std::size_t i = 0; i < count; ++i)
            if (std::isnan(first[i])) std::memcpy(written + i * sizeof(T), &nan, sizeof(T));
    }

    const char* take(std::size_t count, std::size_t size) {
        if (count > left_.size() / size) throw ArchiveError("the checkpoint ends too early");
        const char* at = left_.data();
        left_.remove_prefix(count * size);
        return at;
    }
    std::size_t count(std::size_t here) {
        auto n = static_cast<std::uint64_t>(here);
        value(n);
        // Each element takes at least one byte, so a wrong count cannot allocate too much memory.
        if (loading_ && n > left_.size()) throw ArchiveError("the checkpoint ends too early");
        return static_cast<std::size_t>(n);
    }

    template <class T>
    void value(T& v) {
        if constexpr (requires { v.checkpoint(*this); }) {
            v.checkpoint(*this);
        } else if constexpr (std::is_same_v<T, bool>) {
            auto byte = static_cast<std::uint8_t>(v);
            numbers(&byte, 1);
            v = byte != 0;
        } else if constexpr (narrow<T>) {
            auto wide = static_cast<std::int64_t>(v);
            numbers(&wide, 1);
            v = static_cast<T>(wide);
        } else if constexpr (std::is_base_of_v<Eigen::PlainObjectBase<T>, T>) {
            matrix(v);
        } else {
            static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>,
                          "give the type a member checkpoint(Archive&)");
            numbers(&v, 1);
        }
    }
    template <class T>
    void elements(T& all) {
        using Element = typename T::value_type;
        all.resize(count(all.size()));
        if constexpr (std::is_arithmetic_v<Element> && !narrow<Element> && requires { all.data(); })
            numbers(all.data(), all.size());
        else
            for (auto& v : all) value(v);
    }
    void value(std::string& v) { elements(v); }
    template <class T>
    void value(std::vector<T>& v) {
        static_assert(!std::is_same_v<T, bool>, "use std::vector<char>");
        elements(v);
    }
    template <class T>
    void value(std::deque<T>& v) {
        elements(v);
    }
    template <class T, std::size_t N>
    void value(std::array<T, N>& v) {
        for (auto& each : v) value(each);
    }
    template <class T, std::size_t N>
    void value(T (&v)[N]) {
        for (auto& each : v) value(each);
    }
    template <class A, class B>
    void value(std::pair<A, B>& v) {
        value(v.first), value(v.second);
    }
    template <class T>
    void value(std::optional<T>& v) {
        bool there = v.has_value();
        value(there);
        if (there && !v) v.emplace();
        if (!there) v.reset();
        if (v) value(*v);
    }
    template <class Key, class T, class... More>
    void value(std::map<Key, T, More...>& v) {
        std::size_t n = count(v.size());
        if (!loading_) {
            for (auto& [key, each] : v) {
                Key copy = key;
                value(copy), value(each);
            }
            return;
        }
        for (v.clear(); n > 0; --n) {
            Key key{};
            value(key);
            value(v[key]);
        }
    }
    template <class T>
    void matrix(T& v) {
        auto rows = static_cast<std::int64_t>(v.rows()), columns = static_cast<std::int64_t>(v.cols());
        value(rows), value(columns);
        if (loading_) {
            const auto most = static_cast<std::int64_t>(left_.size() / sizeof(typename T::Scalar));
            if (rows < 0 || columns < 0 || (rows > 0 && columns > most / rows))
                throw ArchiveError("the checkpoint ends too early");
            v.resize(rows, columns);
        }
        numbers(v.data(), static_cast<std::size_t>(v.size()));
    }

    std::string bytes_;
    Sink sink_;
    std::string_view left_;
    bool loading_ = false, same_nan_ = false;
};

}  // namespace forage
