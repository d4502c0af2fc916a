// Parameters of a type. They are declared once, for the XML check, --set, `forage types` and the
// documentation.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace forage {

enum class ParameterKind { boolean, real, integer, text };

using ParameterValue = std::variant<bool, double, int, std::string>;

/// The closed interval that the type's author recommends. Values outside it are legal in a file (the original
/// does not check ranges when it loads one) and give a warning.
struct ParameterRange {
    double low;
    double high;
};

/// One parameter of a type: its meaning, and access to it in an object of that type.
struct Parameter {
    std::string name;   ///< as written in files
    std::string label;  ///< as shown to users
    std::string doc;    ///< one sentence
    std::string unit;   ///< empty when dimensionless
    ParameterKind kind;
    ParameterValue default_value;
    std::optional<ParameterRange> range;
    bool is_path = false;           ///< whether it names a file, relative to the file that sets the parameter
    bool is_time_constant = false;  ///< whether a process decays with it, so that cycles must be shorter
    bool at_start = false;  ///< whether it is read only when the run starts, instead of in each update
    std::function<void(void*, const ParameterValue&)> set;
    std::function<ParameterValue(const void*)> get;
    std::size_t offset = 0, size = 0;  ///< place and size of the member, bytes
};

/// Reads `text` as a value of `kind`: "true" or "false", a number in C notation whatever the locale, or any
/// text. Empty when `text` is not such a value; NaN and infinities do not count as numbers.
std::optional<ParameterValue> parse_parameter(ParameterKind kind, std::string_view text);

/// The value of `kind` that `text` was probably meant to be ("True", " 1", "0,5"); empty when it already is a
/// value, or is not similar to one.
std::string corrected(ParameterKind kind, std::string_view text);

/// Whether `value` is a number outside `range`.
bool outside(const ParameterValue& value, const std::optional<ParameterRange>& range);

/// The shortest text that is read back as the same value.
std::string to_text(const ParameterValue& value);

/// The words for a kind in messages: "a number", "true or false", ...
std::string_view describe(ParameterKind kind);

/// Completes the declaration of a parameter: `.label(..).range(..).doc(..)`.
class ParameterBuilder {
  public:
    ParameterBuilder(std::vector<Parameter>& all, std::size_t index) : all_(all), index_(index) {}
    ParameterBuilder& label(std::string text) { return all_[index_].label = std::move(text), *this; }
    ParameterBuilder& doc(std::string text) { return all_[index_].doc = std::move(text), *this; }
    ParameterBuilder& unit(std::string text) { return all_[index_].unit = std::move(text), *this; }
    ParameterBuilder& path() { return all_[index_].is_path = true, *this; }
    ParameterBuilder& at_start() { return all_[index_].at_start = true, *this; }
    /// A time constant in s: one of less than two cycles gives a warning.
    ParameterBuilder& time_constant() { return all_[index_].is_time_constant = true, unit("s"); }
    ParameterBuilder& range(double low, double high) {
        return all_[index_].range = ParameterRange{low, high}, *this;
    }

  private:
    std::vector<Parameter>& all_;
    std::size_t index_;
};

namespace detail {

template <class M>
inline constexpr bool is_parameter = std::is_same_v<M, bool> || std::is_same_v<M, double> ||
                                     std::is_same_v<M, int> || std::is_same_v<M, std::string>;

template <class M>
constexpr ParameterKind kind_of() {
    if constexpr (std::is_same_v<M, bool>)
        return ParameterKind::boolean;
    else if constexpr (std::is_same_v<M, double>)
        return ParameterKind::real;
    else if constexpr (std::is_same_v<M, int>)
        return ParameterKind::integer;
    else {
        static_assert(is_parameter<M>, "a parameter is a bool, double, int or std::string");
        return ParameterKind::text;
    }
}

/// The parameter of T to which `path` leads: a member pointer, or several when the member is part of a
/// member. Its default is the value in a default-constructed object, so that it is written only in the
/// member's initializer.
template <class T, class... Path>
Parameter make_parameter(std::string name, Path... path) {
    const auto member = [path...](auto& object) -> auto& { return (object.*....*path); };
    using M = std::remove_cvref_t<decltype(member(std::declval<T&>()))>;
    Parameter p;
    p.label = name;
    p.name = std::move(name);
    p.kind = kind_of<M>();
    if constexpr (is_parameter<M>) {  // otherwise kind_of() says what is wrong, in one line
        const T defaults{};
        p.default_value = ParameterValue(member(defaults));
        p.offset = static_cast<std::size_t>(reinterpret_cast<const char*>(&member(defaults)) -
                                            reinterpret_cast<const char*>(&defaults));
        p.size = sizeof(M);
        p.set = [member](void* object, const ParameterValue& v) {
            member(*static_cast<T*>(object)) = std::get<M>(v);
        };
        p.get = [member](const void* object) {
            return ParameterValue(member(*static_cast<const T*>(object)));
        };
    }
    return p;
}

}  // namespace detail
}  // namespace forage
