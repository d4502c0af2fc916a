#include "core/observe/manipulation_spec.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/text_file.h"
#include "core/model/lookup.h"
#include "core/observe/cell.h"
#include "core/observe/pattern_file.h"

namespace forage::observe {
namespace {

using Spec = model::ManipulationSpec;
using model::trim;

/// A name may hold parentheses, too.
bool looks_like_a_cell(std::string_view text) {
    return !text.empty() && text.find_first_not_of("0123456789., \t+-") == text.npos;
}

/// Where "(x,y)=value ..." begins.
std::size_t first_cell(std::string_view text) {
    for (auto open = text.find('('); open != text.npos; open = text.find('(', open + 1))
        if (const auto close = text.find(")=", open);
            close != text.npos && looks_like_a_cell(text.substr(open + 1, close - open - 1)))
            return open;
    return text.npos;
}

std::uint64_t amount(std::string_view option, std::string_view text) {
    const auto value = parse_parameter(ParameterKind::integer, trim(text));
    if (!value || std::get<int>(*value) < 1)
        throw std::invalid_argument(fmt::format("'{}' needs a whole number, at least 1", option));
    return static_cast<std::uint64_t>(std::get<int>(*value));
}

void parse_option(std::string_view option, Spec& out) {
    const auto blank = std::min(option.find(' '), option.size());
    const std::string_view name = option.substr(0, blank), rest = trim(option.substr(blank));
    if (name == "every")
        out.every = amount(name, rest);
    else if (name == "step")
        out.step = amount(name, rest);
    else if (name == "times")
        out.times = amount(name, rest);
    else if (name == "backwards" && rest.empty())
        out.backwards = true;
    else if (name == "from" && !rest.empty())
        out.from = {std::string(rest)};
    else if (name == "until" && !rest.empty())
        out.until = {std::string(rest)};
    else
        throw std::invalid_argument(fmt::format(
            "'{}' is none of every N, step N, times N, backwards, from WHEN, until WHEN", option));
}

/// Takes one "(x,y)=value" off the beginning of a list; returns what is wrong with it.
std::string take_cell(std::string_view& list, std::pair<int, int>& place, double& value) {
    const auto close = list.find(")=");
    const auto end = std::min(list.find_first_of(" \t\r\n", close == list.npos ? 0 : close), list.size());
    if (!list.starts_with("(") || close == list.npos)
        return fmt::format("'{}' is no cell with a value", escaped(list.substr(0, end)));
    const auto cell = parse_cell(list.substr(1, close - 1));
    if (!cell) return fmt::format("'{}' is no cell", escaped(list.substr(0, close + 1)));
    const auto word = list.substr(close + 2, end - close - 2);
    const auto number = parse_parameter(ParameterKind::real, word);
    if (!number) return no_number(word);
    place = *cell, value = std::get<double>(*number);
    list = trim(list.substr(end));
    return {};
}

void add_cells(const Spec& w, std::string_view what, const engine::Layout& s, int group,
               std::vector<double>& pattern, Diagnostics& diagnostics) {
    std::string_view rest = trim(w.cells.text);
    do {
        std::pair<int, int> place;
        double value = 0;
        Location at = w.cells.at;
        if (at.file) at.column += static_cast<int>(rest.data() - w.cells.text.data());
        if (const auto wrong = take_cell(rest, place, value); !wrong.empty()) {
            diagnostics.error(at, fmt::format("{}: {}", what, wrong),
                              "a list of cells with values is written '(1,1)=0.5 (2,1)=1'");
            return;
        }
        if (const auto index = find_cell(s, group, place.first, place.second, what, diagnostics, at))
            pattern[static_cast<std::size_t>(*index)] = value;
    } while (!rest.empty());
}

bool same_settings(const Spec& a, const Spec& b) {
    return a.mode == b.mode && a.every == b.every && a.step == b.step && a.times == b.times &&
           a.backwards == b.backwards && a.from.text == b.from.text && a.until.text == b.until.text;
}

}  // namespace

Spec parse_manipulation(Spec::Mode mode, std::string_view text) {
    Spec out;
    out.mode = mode, out.text = text;
    std::string_view head = text.substr(0, text.find(';'));
    for (auto at = text.find(';'); at != text.npos;) {
        const auto end = std::min(text.find(';', at + 1), text.size());
        parse_option(trim(text.substr(at + 1, end - at - 1)), out);
        at = end == text.size() ? text.npos : end;
    }
    head = trim(head);
    if (const auto cell = first_cell(head); cell != head.npos) {
        out.group = {std::string(trim(head.substr(0, cell)))}, out.cells = {std::string(head.substr(cell))};
    } else if (const auto equals = head.rfind('='); equals != head.npos && equals > 0) {
        out.group = {std::string(trim(head.substr(0, equals)))};
        out.patterns = {std::string(trim(head.substr(equals + 1)))};
    } else {
        throw std::invalid_argument(fmt::format(
            "'{}' is neither 'Process/Group(x,y)=value' nor 'Process/Group=FILE' with a list of patterns",
            head));
    }
    return out;
}

int manipulated_group(const model::Expression& group, std::string_view what, const engine::Layout& s,
                      Diagnostics& diagnostics) {
    const auto column = find_column(s, group.text, what, diagnostics, group.at);
    if (!column) return -1;
    if (column->state == s.groups[column->group].type.output()) return column->group;
    diagnostics.error(group.at,
                      fmt::format("{} '{}': only the activity of a group can be changed", what, group.text),
                      "leave out the state");
    return -1;
}

std::vector<std::unique_ptr<Manipulation>> make_manipulations(const std::vector<Spec>& wishes,
                                                              const engine::Layout& s, bool trials,
                                                              Diagnostics& diagnostics) {
    struct Made {
        const Spec* wish;
        Manipulation::Settings settings;
    };
    std::vector<Made> all;
    for (const auto& w : wishes) {
        static constexpr const char* names[] = {"clamp", "add", "multiply"};
        const std::string what = (w.group.at.file ? "" : "--") + std::string(names[static_cast<int>(w.mode)]);
        const int group = manipulated_group(w.group, what, s, diagnostics);
        const auto condition = [&](const model::Expression& when) {
            return when.empty() ? std::nullopt
                                : parse_condition(s, trials, when.text, what,
                                                           diagnostics, when.at);
        };
        Manipulation::Settings settings;
        settings.group = group;
        settings.mode = static_cast<Manipulation::Mode>(w.mode);
        settings.every = w.every, settings.step = w.step, settings.times = w.times;
        settings.backwards = w.backwards;
        settings.from = condition(w.from), settings.until = condition(w.until);
        if (group < 0) continue;
        if (!w.patterns.empty()) {
            settings.patterns = read_patterns(w.patterns.text, s.groups[group].shape, diagnostics);
            if (!settings.patterns.empty()) all.push_back({&w, std::move(settings)});
            continue;
        }
        Made* same = nullptr;
        for (auto& other : all)
            if (!other.wish->cells.empty() && other.settings.group == group && same_settings(*other.wish, w))
                same = &other;
        if (!same) {
            const double untouched = settings.mode == Manipulation::Mode::multiply ? 1 : 0;
            settings.patterns.emplace_back(static_cast<std::size_t>(s.groups[group].shape.cells), untouched);
            same = &all.emplace_back(Made{&w, std::move(settings)});
        }
        add_cells(w, what, s, group, same->settings.patterns.front(), diagnostics);
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Made& a, const Made& b) { return a.wish->mode < b.wish->mode; });
    std::vector<std::unique_ptr<Manipulation>> out;
    for (auto& m : all) out.push_back(std::make_unique<Manipulation>(std::move(m.settings)));
    return out;
}

}  // namespace forage::observe
