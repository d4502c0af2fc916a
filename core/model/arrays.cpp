#include "core/model/arrays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/base/named_file.h"
#include "core/model/lookup.h"

namespace forage::model {
namespace {

/// What a value says.
struct Distribution {
    enum Kind { constant, normal, uniform } kind = constant;
    double a = 0, b = 0;  ///< the value; mean and deviation; low and high
};

/// The distribution that a text says; empty when a constant that it uses has no value. Throws FormulaError.
std::optional<Distribution> distribution(const std::string& text, Constants& constants,
                                         const Process* scope) {
    constexpr const char* forms = "normal(mean, deviation) or uniform(low, high)";
    const auto number = [&](std::string_view part, std::size_t offset) -> std::optional<double> {
        try {
            const auto v = constants.value(part, scope);
            if (v && !std::isfinite(*v))
                throw FormulaError(0, fmt::format("it is {}, not a finite number", *v));
            return v;
        } catch (const FormulaError& e) {
            throw FormulaError(offset + e.at, e.what(), e.hint);
        }
    };
    const auto open = text.find('(');
    if (open == text.npos || text.starts_with('{')) {
        const auto v = number(trim(text), 0);
        return v ? std::optional(Distribution{Distribution::constant, *v}) : std::nullopt;
    }
    const std::vector<std::string> names{"normal", "uniform"};
    const auto name = trim(std::string_view(text).substr(0, open));
    const auto which = std::ranges::find(names, name);
    if (which == names.end())
        throw FormulaError(
            0, fmt::format("there is no distribution '{}'", name),
            nearest(name, names).empty() ? fmt::format("it is {}", forms) : suggest(name, names));
    const auto comma = text.find(','), close = text.rfind(')');
    if (comma == text.npos || close == text.npos || close < comma || !trim(text.substr(close + 1)).empty())
        throw FormulaError(open, "two numbers in parentheses are needed", forms);
    Distribution out{which == names.begin() ? Distribution::normal : Distribution::uniform};
    // A formula may have commas: the arguments are divided at the first one outside braces.
    std::size_t middle = comma;
    for (std::size_t at = open, depth = 0; at < close; ++at) {
        if (text[at] == '{') ++depth;
        if (text[at] == '}' && depth > 0) --depth;
        if (text[at] == ',' && depth == 0) {
            middle = at;
            break;
        }
    }
    const auto argument = [&](std::size_t from, std::size_t to) {
        const std::string_view part = std::string_view(text).substr(from, to - from);
        const auto inner = trim(part);
        return number(inner, inner.empty() ? from : static_cast<std::size_t>(inner.data() - text.data()));
    };
    const auto a = argument(open + 1, middle), b = argument(middle + 1, close);
    if (!a || !b) return std::nullopt;
    out.a = *a, out.b = *b;
    if (out.kind == Distribution::normal && out.b < 0)
        throw FormulaError(middle + 1, "a standard deviation is at least 0");
    if (out.kind == Distribution::uniform && out.b < out.a)
        throw FormulaError(open + 1, fmt::format("{} is more than {}", to_text(out.a), to_text(out.b)),
                           "uniform(low, high)");
    return out;
}

}  // namespace

void load_arrays(System& system) {
    std::map<std::tuple<std::string, Array::Form, std::string>, std::shared_ptr<const Array>> known;
    each_array(system.processes, system.connections, [&]<class T>(T& item) {
        if (item.array) return;
        Array::Form form = Array::Form::matrix;
        std::string column;
        if constexpr (requires { item.column; }) {
            column = item.column;
            if (!column.empty()) form = Array::Form::column;
        } else {
            if (item.is_list) form = Array::Form::list;
            if (item.file.empty() && !item.text.empty())
                item.array.array =
                    Array::parse(std::string_view(item.text).substr(item.text.find_first_not_of(" \t\r\n")),
                                 form, item.text_at);
        }
        if (item.file.empty()) return;
        const auto path = resolved(item.file, item.file_at);
        auto& array = known[{path, form, column}];
        if (!array) array = Array::read(path, form, column);
        item.array.array = array;
    });
}

std::set<std::string> array_files(const System& system) {
    std::set<std::string> out;
    each_array(system.processes, system.connections, [&](const auto& item) {
        if (!item.file.empty()) out.insert(resolved(item.file, item.file_at));
    });
    return out;
}

bool ArrayCheck::is_sound(const std::string& file, const Location& file_at, const ArrayHandle& array) {
    if (!file.empty() && !find_file(resolved(file, file_at), file_at, out_)) return false;
    if (!array) {
        out_.error(file_at, "these numbers have not been read", "model::load_arrays() reads them");
        return false;
    }
    if (reported_.insert(array.array.get()).second)
        for (const auto& fault : array->faults()) out_.add(fault);
    return array->faults().empty();
}

void ArrayCheck::shape(const Array& array, const Location& at, std::size_t rows, std::size_t columns) {
    const bool row = array.is_vector() && rows == 1 && array.rows() == columns;  // of one target
    const bool grid = columns == 1 && array.rows() * array.columns() == rows;    // cells, row by row
    if (row || grid || (array.rows() == rows && array.columns() == columns)) return;
    const std::string is = fmt::format("{}{} x {} numbers, not {} x {}",
                                       array.path().empty() ? "" : fmt::format("'{}' has ", array.path()),
                                       array.rows(), array.columns(), rows, columns);
    const bool turned = array.rows() == columns && array.columns() == rows;
    out_.error(at, is,
               turned         ? "rows are target cells, and columns are source cells: transpose it"
               : columns == 1 ? "one number for each cell of the group"
                              : fmt::format("a row for each target cell, and a column for each source cell{}",
                                            array.columns() == 3 || array.columns() == 4
                                                ? "; for a list of source, target, weight: form=\"list\""
                                                : ""));
}

void ArrayCheck::list(const Array& array, int sources, int targets) {
    if (array.columns() < 3 || array.columns() > 4)
        return out_.error(array.place(array.rows()),
                          fmt::format("a list has 3 or 4 columns, not {}", array.columns()),
                          "source, target, weight and perhaps delay; without form=\"list\", it is a matrix");
    constexpr int max_reported = 20;
    const auto numbers = array.numbers();
    std::unordered_map<std::size_t, std::size_t> seen;  // rows by pair of cells
    int reported = 0;
    for (std::size_t row = 0; row < array.rows() && reported < max_reported; ++row) {
        const double* v = &numbers[row * array.columns()];
        const auto wrong = [&](std::string message, std::string hint) {
            if (array.place(row).line == 0) message = fmt::format("row {}: {}", row, message);
            out_.error(array.place(row), std::move(message), std::move(hint));
            ++reported;
            return false;
        };
        const auto whole = [&](double n, int end, const char* what) {
            if (n == std::trunc(n) && n >= 0 && n < end) return true;
            return wrong(fmt::format("there is no {} cell {:.15g}", what, n),
                         fmt::format("the {}'s cells are 0 to {}", what, end - 1));
        };
        if (std::any_of(v, v + array.columns(), [](double n) { return std::isnan(n); })) {
            wrong("a number is left out", "remove the row");
            continue;
        }
        if (!whole(v[0], sources, "source") || !whole(v[1], targets, "target")) continue;
        if (array.columns() == 4 && (v[3] != std::trunc(v[3]) || v[3] < 0 || v[3] > max_delay))
            wrong(fmt::format("a delay of {:.15g} cycles is not possible", v[3]),
                  fmt::format("delays are whole numbers from 0 to {}", max_delay));
        const auto pair = static_cast<std::size_t>(v[0]) * static_cast<std::size_t>(targets) +
                          static_cast<std::size_t>(v[1]);
        if (const auto [first, fresh] = seen.emplace(pair, row); !fresh)
            wrong(fmt::format("source {} and target {} have a synapse already: {}", v[0], v[1],
                              array.row_name(first->second)),
                  "add the weights, and remove one of the rows");
    }
}

void ArrayCheck::weights(const Connection& c, const SynapseType* type, int sources, int targets) {
    const auto& w = std::get<Weights>(c.pattern);
    if (w.file.empty() == w.text.empty())
        out_.error(w.at,
                   w.file.empty() ? "these weights have no numbers"
                                  : "<Weights> has both a file and rows of numbers",
                   w.file.empty() ? "name a file, <Weights file=\"w.npy\"/>, or write rows of numbers into it"
                                  : "remove one of them");
    else if (is_sound(w.file, w.file_at, w.array) && sources > 0 && targets > 0) {
        if (w.is_list)
            list(*w.array.array, sources, targets);
        else
            shape(*w.array.array, w.file.empty() ? w.text_at : w.file_at, static_cast<std::size_t>(targets),
                  static_cast<std::size_t>(sources));
    }
    const auto needless = [&](const Location& at, const char* what, const char* why) {
        out_.error(at, fmt::format("a connection with <Weights> has no {}", what), why);
    };
    if (!(c.arborization == Arborization()))
        needless(c.arborization.at, "<Arborization>",
                 "remove it: the weights say which cells have a synapse");
    if (!(c.attenuation == DistanceFunction()))
        needless(c.attenuation.at, "<AttenuationFunction>",
                 "remove it: the weights say how strong synapses are");
    if (w.is_list && w.array && w.array->columns() == 4 && !(c.delay == DistanceFunction()))
        needless(c.delay.at, "<DelayFunction> when its list has delays", "remove it, or the fourth column");
    else if (!std::holds_alternative<UniformFunction>(c.delay.form) &&
             !std::holds_alternative<RandomFunction>(c.delay.form))
        needless(c.delay.at, "delay by distance",
                 "use FunUniform or FunRandom, or a list of source, target, weight, delay");
    if (!type || type->has_gain) return;
    std::vector<std::string> states;
    for (const auto& s : type->states)
        if (!s.output) states.push_back(s.name);
    if (std::ranges::find(states, "weight") == states.end())
        out_.error(
            synapse_of(c).at, fmt::format("{} has no state 'weight' that <Weights> could set", type->name),
            type->declared ? "call the state of the type that <Weights> fill 'weight'"
                           : "leave out <Synapse>, or use a type that has one, such as synapseHebbian");
    if (c.synapse)
        for (const auto& i : c.synapse->initial)
            if (i.state == "weight")
                out_.error(i.at, "<Weights> say with what the state 'weight' begins", "remove this element");
}

void ArrayCheck::value(const Initial& i, const Process* scope) {
    try {
        distribution(i.value, constants_, scope);
    } catch (const FormulaError& e) {
        out_.error(inside(i.value_at, e.at), fmt::format("'{}': {}", i.value, e.what()), e.hint);
    }
}

void ArrayCheck::initial(const TypeUse& use, const std::vector<std::string>& states,
                         const std::vector<std::string>& parameters, const Process* scope, std::size_t rows,
                         std::size_t columns) {
    std::map<std::string_view, int> first_line;
    for (const auto& i : use.initial) {
        if (std::ranges::find(states, i.state) == states.end())
            out_.error(i.state_at,
                       fmt::format("{} has no state '{}' that begins with a value", use.type, i.state),
                       std::ranges::find(parameters, i.state) != parameters.end()
                           ? fmt::format("'{}' is a parameter, which is the same in all cells; a state of a "
                                         "type in the file that no equation changes can differ",
                                         i.state)
                       : states.empty() ? fmt::format("{} keeps no numbers", use.type)
                                        : suggest(i.state, states));
        else if (const auto [it, fresh] = first_line.emplace(i.state, i.at.line); !fresh)
            out_.error(i.state_at,
                       fmt::format("state '{}' is given twice, first on line {}", i.state, it->second),
                       "remove one of them");
        if (i.value.empty() == i.file.empty()) {
            out_.error(i.at,
                       fmt::format("the state '{}' has {}", i.state,
                                   i.file.empty() ? "neither a value nor a file" : "both a value and a file"),
                       "give it 'value' or 'file'");
            continue;
        }
        if (i.file.empty() && !i.column.empty())
            out_.error(i.column_at, "a column needs a file", "add file=\"cells.csv\"");
        if (i.file.empty()) {
            value(i, scope);
        } else if (is_sound(i.file, i.file_at, i.array) && rows * columns > 0) {
            shape(*i.array.array, i.file_at, rows, columns);
            if (columns > 1 || i.array->left_out() == 0) continue;
            const auto numbers = i.array->numbers();
            const auto at = static_cast<std::size_t>(
                std::ranges::find_if(numbers, [](double n) { return std::isnan(n); }) - numbers.begin());
            out_.error(i.array->place(at / i.array->columns()),
                       fmt::format("cell {} has no number for the state '{}'", at, i.state),
                       "each cell needs one");
        }
    }
}

bool is_drawn(const Initial& i, Constants& constants, const Process* scope) {
    if (i.array) return false;
    const auto from = distribution(i.value, constants, scope);
    return from && from->kind != Distribution::constant;
}

std::vector<double> initial_values(const Initial& i, Constants& constants, const Process* scope,
                                   const RandomStream& stream, std::size_t count,
                                   std::span<const std::size_t> index) {
    if (i.array) {
        auto all = i.array->numbers();
        if (index.empty()) return all;
        std::vector<double> out;
        out.reserve(count);
        for (const std::size_t at : index) out.push_back(all[at]);
        return out;
    }
    const auto from = distribution(i.value, constants, scope).value_or(Distribution());
    std::vector<double> out(count, from.a);
    if (from.kind == Distribution::constant) return out;
    const bool normal = from.kind == Distribution::normal;
    if (normal)
        stream.normal(0, out);
    else
        stream.uniform(0, out);
    for (double& v : out) v = from.a + (normal ? from.b : from.b - from.a) * v;
    return out;
}

void write_out(Initial& i, Constants& constants, const Process* scope) {
    if (i.value.find('{') == std::string::npos) return;
    try {
        const auto d = distribution(i.value, constants, scope);
        if (!d) return;
        i.value = d->kind == Distribution::constant
                      ? to_text(d->a)
                      : fmt::format("{}({}, {})", d->kind == Distribution::normal ? "normal" : "uniform",
                                    to_text(d->a), to_text(d->b));
    } catch (const FormulaError&) {  // validate() reports it
    }
}

void refuse_extensions(const System& system, Diagnostics& diagnostics) {
    for (const auto* all : {&system.neuron_types, &system.synapse_types})
        for (const auto& type : *all)
            diagnostics.error(type.at,
                              fmt::format("plain iqr has no types in a file, such as '{}'", type.name),
                              "a file for the original names types that it knows");
    for (const auto& c : system.connections) {
        if (!c.input.empty())
            diagnostics.error(c.input_at, "plain iqr has three inputs, of which type= names one");
        if (!c.state.empty()) diagnostics.error(c.state_at, "connections of plain iqr transmit the output");
    }
    each_array(system.processes, system.connections, [&]<class T>(const T& item) {
        if constexpr (std::is_same_v<T, Weights>)
            diagnostics.error(item.at, "plain iqr has no weights of single synapses",
                              "a file for the original needs a pattern and one weight per connection");
        else
            diagnostics.error(item.at,
                              fmt::format("plain iqr has no initial value of the state '{}'", item.state),
                              "in a file for the original, states begin as their type says");
    });
}

}  // namespace forage::model
