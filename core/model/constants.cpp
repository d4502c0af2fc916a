#include "core/model/constants.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/model/arrays.h"
#include "core/model/lookup.h"
#include "core/model/parts.h"

namespace forage::model {
namespace {

/// What ends a formula whose constant has a mistake of its own.
struct FollowsFromConstant {};
/// What ends all formulas of constants that depend on each other.
struct Circle {
    std::vector<const Constant*> constants;
};

std::vector<std::string> names_in(const System& system, const Process* process) {
    std::vector<std::string> out;
    const auto add = [&](const std::vector<Constant>& all) {
        for (const auto& c : all)
            if (!contains(out, c.name)) out.push_back(c.name);
    };
    for (; process; process = outer(system, *process)) add(process->constants);
    add(system.constants);
    out.emplace_back("dt");
    return out;
}

const Constant* named(const std::vector<Constant>& all, std::string_view name) {
    return find_by(all, name, &Constant::name);
}

/// The constant of the system that a name says, or "Process.name" for one of a process.
std::pair<const Constant*, const Process*> find_in(const System& system, std::string_view name) {
    if (const auto* found = named(system.constants, name)) return {found, nullptr};
    const auto dot = name.rfind('.');
    if (dot == name.npos) return {};
    for (const int i : items_named(system.processes, name.substr(0, dot)))
        if (const auto* found = named(system.processes[i].constants, name.substr(dot + 1)))
            return {found, &system.processes[i]};
    return {};
}

/// Calls f(struct) with everything in a connection whose numbers may have formulas.
template <class F>
void each_with_formulas(Connection& c, F f) {
    const auto variant = [&](auto& alternatives) {
        std::visit(
            [&](auto& one) {
                if constexpr (requires { one.formulas; }) f(one);
            },
            alternatives);
    };
    std::visit(
        [&](auto& pattern) {
            if constexpr (requires { pattern.source; }) variant(pattern.source), variant(pattern.target);
        },
        c.pattern);
    f(c.arborization);
    variant(c.arborization.shape), variant(c.attenuation.form), variant(c.delay.form);
}

/// Calls f(struct, process) with everything in the items of a system whose numbers may have formulas. The
/// constants of `process` hold there; it is null where only those of the system do.
template <class F>
void each_with_formulas(System& system, F f) {
    for (auto& p : system.processes)
        for (auto& g : p.groups)
            if (auto* rect = std::get_if<RectTopology>(&g.topology)) f(*rect, &p);
    const GroupIndex groups(system);
    for (auto& c : system.connections) {
        const Process* process = scope_of(c, groups);
        each_with_formulas(c, [&](auto& s) { f(s, process); });
    }
}

/// Calls f(setting, process) with all parameters of a system.
template <class F>
void each_setting(System& system, F f) {
    const GroupIndex groups(system);
    for (auto& p : system.processes) {
        if (p.module)
            for (auto& s : p.module->settings) f(s, &p);
        for (auto& g : p.groups)
            for (auto* all : {&g.neuron.settings, &g.neuron.defaults})
                for (auto& s : *all) f(s, &p);
    }
    for (auto& c : system.connections)
        if (c.synapse)
            for (auto* all : {&c.synapse->settings, &c.synapse->defaults})
                for (auto& s : *all) f(s, scope_of(c, groups));
}

/// Whether a text has this word.
bool has_word(std::string_view text, std::string_view word) {
    const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    for (auto at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const auto end = at + word.size();
        if ((at == 0 || !in_name(text[at - 1])) && (end == text.size() || !in_name(text[end]))) return true;
    }
    return false;
}

/// The parameters of a declared type that have formulas, and the constants that its equations name.
std::vector<Setting> defaults_of(const TypeDeclaration& type, const System& system, const Process* process) {
    std::vector<Setting> out;
    for (const auto& c : type.constants)
        if (in_braces(c.value)) out.push_back({c.name, c.value, c.name_at, c.value_at});
    for (const auto& name : names_in(system, process))
        if (!named(type.constants, name) &&
            std::ranges::any_of(type.equations, [&](const PlacedText& e) { return has_word(e.text, name); }))
            out.push_back({name, "{" + name + "}", {}, {}});
    return out;
}

/// Finds the defaults of declared types in all their uses.
void set_defaults(System& system) {
    const auto set = [&](TypeUse& use, const std::vector<TypeDeclaration>& declared, const Process* process) {
        const auto* type = find_by(declared, use.type, &TypeDeclaration::name);
        use.defaults = type ? defaults_of(*type, system, process) : std::vector<Setting>();
    };
    for (auto& p : system.processes)
        for (auto& g : p.groups) set(g.neuron, system.neuron_types, &p);
    if (system.synapse_types.empty()) return;
    const GroupIndex groups(system);
    for (auto& c : system.connections)
        if (c.synapse) set(*c.synapse, system.synapse_types, scope_of(c, groups));
}

/// Gives a number the value of its formula. Reports one that it cannot have.
template <class Struct>
void set_number(Struct& s, NumberFormula<Struct>& f, double v, Diagnostics& diagnostics) {
    const auto wrong = [&](std::string_view why) {
        diagnostics.error(f.at, fmt::format("{} = '{}' is {:.15g}, {}", f.attribute, f.text, v, why));
    };
    if (!std::isfinite(v)) return wrong("which is not a finite number");
    if (std::holds_alternative<int Struct::*>(f.member) && v != std::trunc(v))
        return wrong("which is not a whole number");
    if (v < f.low || v > f.high)
        return wrong(fmt::format("which is not from {:.15g} to {:.15g}", f.low, f.high));
    std::visit([&]<class T>(T Struct::*member) { s.*member = static_cast<T>(v); }, f.member);
    f.value = v, f.computed = true;
}

/// Computes the numbers of a struct. Returns whether all of them have a value.
template <class Struct>
bool compute_numbers(Constants& constants, Struct& s, const Process* process, Diagnostics& diagnostics) {
    std::erase_if(s.formulas, [&](const auto& f) { return !f.holds(s); });  // edited since
    for (auto& f : s.formulas) try {
            if (const auto v = constants.value(f.text, process)) set_number(s, f, *v, diagnostics);
        } catch (const FormulaError& e) {
            diagnostics.error(inside(f.at, e.at), fmt::format("{} = '{}': {}", f.attribute, f.text, e.what()),
                              e.hint);
        }
    return std::ranges::all_of(s.formulas, [](const auto& f) { return f.computed; });
}

}  // namespace

const Process* scope_of(const Connection& connection, const GroupIndex& groups) {
    const System& system = groups.system();
    const Process* source = groups.find(connection.source).process;
    for (; source; source = outer(system, *source)) {
        const Process* target = groups.find(connection.target).process;
        while (target && target != source) target = outer(system, *target);
        if (target) return source;
    }
    return nullptr;
}

Location inside(Location value, std::size_t offset) {
    if (value.column > 0) value.column += static_cast<int>(offset);
    return value;
}

Constants::Defined Constants::find(std::string_view name, const Process* process) const {
    for (; process; process = outer(system_, *process))
        if (const Constant* own = named(process->constants, name)) return {own, process};
    return {named(system_.constants, name), nullptr};
}

const Process* Constants::scope_of(const Constant& constant, const Process* process) const {
    return constant.given ? outer(system_, *process) : process;
}

double Constants::value_of(const Defined& defined) {
    if (const auto it = known_.find(defined.constant); it != known_.end()) {
        if (!it->second) throw FollowsFromConstant();
        return *it->second;
    }
    auto& out = known_[defined.constant];
    open_.push_back(defined.constant);
    try {
        out = evaluate(defined.constant->value, scope_of(*defined.constant, defined.process));
        if (!std::isfinite(*out)) out.reset();
    } catch (const FormulaError&) {  // check() reports it
    } catch (...) {
        open_.pop_back();
        throw;
    }
    open_.pop_back();
    if (!out) throw FollowsFromConstant();
    return *out;
}

std::optional<double> Constants::value(std::string_view text, const Process* process) {
    try {
        return evaluate(text, process);
    } catch (const FollowsFromConstant&) {
    } catch (const Circle&) {
    }
    return std::nullopt;
}

double Constants::evaluate(std::string_view text, const Process* process) {
    if (!in_braces(text)) {
        if (const auto number = parse_number<double>(text)) return *number;
        const std::string meant = corrected(ParameterKind::real, text);
        throw FormulaError(
            0, no_number(text),
            meant.empty() ? "a formula stands in braces: {2 * x}" : fmt::format("did you mean '{}'?", meant));
    }
    const auto inner = text.substr(1, text.size() - 2);
    try {
        return Formula(inner).value([&](const std::string& name, std::size_t at) {
            const auto defined = find(name, process);
            if (defined.constant) {
                const auto open = std::ranges::find(open_, defined.constant);
                if (open == open_.end()) return value_of(defined);
                throw Circle{{open, open_.end()}};
            }
            if (name != "dt")
                throw FormulaError(at, fmt::format("there is no constant '{}'", name),
                                   suggest(name, names_in(system_, process)));
            if (!dt_)
                throw FormulaError(at, "cylesPerSecond cannot depend on dt, which is 1 / cylesPerSecond");
            return *dt_;
        });
    } catch (const FormulaError& e) {
        throw FormulaError(e.at + 1, e.what(), e.hint);
    }
}

std::optional<double> Constants::value_of(std::string_view name) {
    const auto [constant, process] = find_in(system_, name);
    return constant ? value(constant->value, scope_of(*constant, process)) : std::nullopt;
}

void Constants::check(Diagnostics& diagnostics) {
    check(system_.constants, nullptr, diagnostics);
    for (const auto& p : system_.processes) check(p.constants, &p, diagnostics);
}

void Constants::check(const std::vector<Constant>& all, const Process* process, Diagnostics& diagnostics) {
    std::map<std::string_view, const Constant*> seen;
    for (const auto& c : all) {
        if (!is_formula_name(c.name) || c.name == "dt")
            diagnostics.error(
                c.name_at, fmt::format("a constant cannot be called '{}'", c.name),
                "letters, digits and _, not first a digit, and no word of formulas such as 'if' or 'dt'");
        if (const auto [it, fresh] = seen.emplace(c.name, &c); !fresh)
            diagnostics.error(
                c.name_at,
                fmt::format("the constant '{}' is already defined on line {}", c.name, it->second->at.line),
                "remove one of them");
        const bool swapped = c.minimum && c.maximum && *c.minimum > *c.maximum;
        if (swapped)
            diagnostics.error(c.at, fmt::format("the minimum of '{}' is larger than its maximum", c.name));
        open_ = {&c};
        try {
            const double v = evaluate(c.value, scope_of(c, process));
            const auto wrong = [&](std::string_view why) {
                diagnostics.error(c.value_at,
                                  in_braces(c.value)
                                      ? fmt::format("{} = {} is {}, {}", c.name, c.value, to_text(v), why)
                                      : fmt::format("{} = {}, {}", c.name, c.value, why));
            };
            if (!std::isfinite(v))
                wrong("which is not a finite number");
            else if (!swapped && c.minimum && v < *c.minimum)
                wrong(fmt::format("less than its minimum {}", to_text(*c.minimum)));
            else if (!swapped && c.maximum && v > *c.maximum)
                wrong(fmt::format("more than its maximum {}", to_text(*c.maximum)));
        } catch (const FormulaError& e) {
            diagnostics.error(inside(c.value_at, e.at),
                              fmt::format("{} = '{}': {}", c.name, c.value, e.what()), e.hint);
        } catch (const FollowsFromConstant&) {
        } catch (const Circle& circle) {
            if (circle.constants.front() == &c && !in_circles_.contains(&c)) {
                std::string names;
                for (const auto* each : circle.constants)
                    names += each->name + ", ", in_circles_.insert(each);
                diagnostics.error(c.value_at, fmt::format("constants depend on each other in a circle: {}{}",
                                                          names, c.name));
            }
        }
        open_.clear();
    }
}

bool compute(System& system, Diagnostics& diagnostics) {
    load_arrays(system);
    Constants before(system, std::nullopt);
    compute_numbers(before, system, nullptr, diagnostics);
    Constants constants(system);
    constants.check(diagnostics);
    bool complete = true;
    each_with_formulas(system, [&](auto& s, const Process* process) {
        complete = compute_numbers(constants, s, process, diagnostics) && complete;
    });
    set_defaults(system);
    each_setting(system, [&](Setting& s, const Process* process) {
        s.computed.clear();
        if (!in_braces(s.value)) return;
        try {
            if (const auto v = constants.value(s.value, process); v && std::isfinite(*v))
                s.computed = to_text(*v);
        } catch (const FormulaError&) {  // validate() reports it, if the parameter is a number
        }
    });
    return complete;
}

void compute(System& system) {
    Diagnostics unread;
    compute(system, unread);
}

bool agree(const std::vector<Constant>& a, const std::vector<Constant>& b) {
    return std::ranges::all_of(b, [&](const Constant& c) {
        const auto* same = named(a, c.name);
        return !same || same->value == c.value;
    });
}

bool has_all(const std::vector<Constant>& all, const std::vector<Constant>& wanted) {
    return agree(all, wanted) &&
           std::ranges::all_of(wanted, [&](const Constant& c) { return named(all, c.name); });
}

void write_out_formulas(System& system) {
    Constants constants(system);
    const GroupIndex groups(system);
    for (auto& p : system.processes)
        for (auto& g : p.groups)
            for (auto& i : g.neuron.initial) write_out(i, constants, &p);
    for (auto& c : system.connections)
        if (c.synapse)
            for (auto& i : c.synapse->initial) write_out(i, constants, scope_of(c, groups));
    each_with_formulas(system, [](auto& s, const Process*) { s.formulas.clear(); });
    system.formulas.clear();
    each_setting(system, [](Setting& s, const Process*) {
        if (!s.computed.empty()) s.value = std::exchange(s.computed, {});
    });
    system.constants.clear();
    for (auto& p : system.processes) p.constants.clear();
}

void settle_constants(System& system) {
    compute(system);
    Constants constants(system);
    const GroupIndex groups(system);
    for (auto& c : system.connections) {
        if (groups.find(c.source).process == groups.find(c.target).process || !scope_of(c, groups)) continue;
        each_with_formulas(c, [](auto& s) { s.formulas.clear(); });
        if (!c.synapse) continue;
        for (auto& i : c.synapse->initial) write_out(i, constants, scope_of(c, groups));
        for (auto& s : c.synapse->settings)
            if (!s.computed.empty()) s.value = std::exchange(s.computed, {});
    }
    std::vector<std::vector<Constant>> settled;
    for (const auto& p : system.processes) {
        auto& all = settled.emplace_back(p.constants);
        const Process* owner = &p;
        for (auto& c : all)
            if (c.given)
                c.value = to_text(constants.value(c.value, outer(system, p)).value_or(0)), c.given = false;
        while ((owner = outer(system, *owner)))
            for (Constant c : owner->constants)
                if (!named(all, c.name)) {
                    c.value = to_text(
                        constants.value(c.value, c.given ? outer(system, *owner) : owner).value_or(0));
                    c.given = false;
                    all.push_back(std::move(c));
                }
    }
    for (std::size_t i = 0; i < settled.size(); ++i) system.processes[i].constants = std::move(settled[i]);
}

const Constant* find_constant(const System& system, std::string_view name) {
    return find_in(system, name).first;
}
Constant* find_constant(System& system, std::string_view name) {
    return const_cast<Constant*>(find_constant(std::as_const(system), name));
}

std::vector<std::string> constant_names(const System& system) {
    auto out = names_of(system.constants);
    for (const auto& p : system.processes)
        for (const auto& c : p.constants) out.push_back(fmt::format("{}.{}", trim(p.name), c.name));
    return out;
}

}  // namespace forage::model
