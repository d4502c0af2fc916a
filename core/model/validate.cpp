#include "core/model/validate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/exception_message.h"
#include "core/base/named_file.h"
#include "core/base/separated.h"
#include "core/base/sequence.h"
#include "core/model/arrays.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "core/model/original_types.h"
#include "core/model/parts.h"

namespace forage::model {
namespace {

const Parameter* find_parameter(const std::vector<Parameter>& parameters, std::string_view name) {
    return find_by(parameters, name, &Parameter::name);
}

std::string in_brackets(std::string_view sentence) {
    if (sentence.ends_with('.')) sentence.remove_suffix(1);
    return sentence.empty() ? "" : fmt::format(" ({})", sentence);
}

/// What to say about a use of a type that is not known. `kind` is "neuron", "synapse" or "module".
Diagnostic unknown_type(std::string_view kind, const TypeUse& use, const std::vector<std::string>& known,
                        const Registry& registry) {
    const std::string& name = use.type;
    const auto error = [&](std::string message, std::string hint) {
        return Diagnostic{Severity::error, use.at, std::move(message), std::move(hint), {}, {}};
    };
    if (const auto* original = find_missing_original_type(name))
        return error(fmt::format("Forage does not have the original's {}: {}", name, original->reason),
                     std::string(original->hint));
    const char* other = registry.neuron(name)    ? "neuron"
                        : registry.synapse(name) ? "synapse"
                        : registry.module(name)  ? "module"
                                                 : nullptr;
    if (other)
        return error(fmt::format("there is no {} type '{}'", kind, name),
                     fmt::format("'{}' is a {} type", name, other));
    std::string hint = suggest(name, known);
    if (!registry.unloaded.empty()) {
        const auto& [folder, how] = registry.unloaded.front();
        return error(
            fmt::format(
                "there is no {} type '{}' in Forage; it may be that of a plugin in '{}', which is not loaded",
                kind, name, folder),
            hint.starts_with("did you mean") ? hint + " " + how : how);
    }
    if (!hint.starts_with("did you mean"))
        hint +=
            "; if it comes from a plugin: --plugin PATH, or its .so in a folder 'plugins' beside the system";
    return error(fmt::format("there is no {} type '{}'", kind, name), hint);
}

class Validator {
  public:
    Validator(const System& system, const Registry& registry, Diagnostics& out, Environment* environment)
        : system_(system),
          registry_(registry),
          out_(out),
          environment_(environment),
          constants_(system),
          arrays_(constants_, out),
          groups_(system) {}

    void run() {
        unique_ids();
        count_lost_ids();
        ambiguous_paths();
        check_rate();
        for (const auto& process : system_.processes) {
            scope_ = &process;
            for (const auto& group : process.groups) check_group(group);
            if (process.module) check_module(process);
        }
        for (const auto& connection : system_.connections) {
            scope_ = scope_of(connection, groups_);
            check_connection(connection);
        }
        for (const auto& [parameter, unusual] : unusual_)
            out_.warning(unusual.where,
                         unusual.count == 1 ? unusual.message
                                            : fmt::format("{}, one of {} such values in this file",
                                                          unusual.message, unusual.count),
                         unusual.hint);
    }

  private:
    void unique_ids() {
        std::map<std::string_view, const Location*> seen;
        const auto see = [&](const std::string& id, const Location& at, std::string_view what) {
            if (id.empty())
                return out_.error(at, fmt::format("the id of this {} is empty", what),
                                  "give it one that nothing else in the file has");
            const auto [it, fresh] = seen.emplace(id, &at);
            if (fresh) return;
            ++repeated_ids_;
            const auto& first = *it->second;
            const bool same_file = !first.file || !at.file || first.file->path == at.file->path;
            out_.error(at,
                       fmt::format("the id '{}' of this {} is already used {}on line {}", id, what,
                                   same_file ? "" : fmt::format("in '{}' ", first.file->path), first.line),
                       same_file ? "ids are unique over the whole file"
                                 : "ids are unique over a system and the files of its linked processes");
        };
        for (const auto& p : system_.processes) {
            see(p.id, p.at, "process");
            for (const auto& g : p.groups) see(g.id, g.at, "group");
            for (const auto& c : p.canvas_comments) see(c.id, c.at, "comment");
        }
        for (const auto& c : system_.canvas_comments) see(c.id, c.at, "comment");
        for (const auto& c : system_.connections) see(c.id, c.at, "connection");
    }

    /// When ids are repeated, references to others may lead nowhere for that reason only.
    void count_lost_ids() {
        std::set<std::string_view> lost;
        const auto look = [&](const std::string& id) {
            if (!groups_.find(id).group) lost.insert(id);
        };
        for (const auto& c : system_.connections) look(c.source), look(c.target);
        for (const auto& p : system_.processes)
            if (p.module)
                for (const auto* references : {&p.module->inputs, &p.module->outputs})
                    for (const auto& r : *references)
                        if (!r.target.empty()) look(r.target);
        follows_from_repeated_ = std::ssize(lost) <= repeated_ids_;
    }

    void ambiguous_paths() {
        std::map<std::string, const Group*> first;
        for (const auto& p : system_.processes)
            for (const auto& g : p.groups) {
                const std::string path = fmt::format("{}/{}", trim(p.name), trim(g.name));
                const auto [it, fresh] = first.emplace(path, &g);
                if (!fresh && it->second->id != g.id)
                    out_.warning(g.at, fmt::format("there is already a group '{}'", path),
                                 fmt::format("rename one of them; until then, this one is called '{0}#{1}', "
                                             "and the first one '{0}#{2}'",
                                             path, g.id, it->second->id));
            }
    }

    /// A cycle is neither so long nor so short that times in cycles and in seconds lose their meaning.
    void check_rate() {
        const double rate = system_.cycles_per_second;
        if (rate != 0 && !(rate >= 1e-6 && rate <= 1e6))
            out_.error(system_.at, fmt::format("cylesPerSecond = {} is not possible", to_text(rate)),
                       "cycles in a second, from 1e-6 to 1000000; 0 counts as 25");
    }

    /// The parameter that is probably meant by `name`, which may be a label.
    static const Parameter* probably(std::string_view name, const std::vector<Parameter>& parameters,
                                     const std::vector<std::string>& known) {
        for (const auto& p : parameters)
            if (nearest(name, {&p.label, 1}) == p.label && !p.label.empty() && p.label.size() == name.size())
                return &p;
        return find_parameter(parameters, nearest(name, known));
    }

    void check_settings(const TypeUse& use, const std::vector<Parameter>& parameters) {
        const auto known = names_of(parameters);
        std::map<std::string_view, int> first_line;
        for (const auto& s : use.settings) {
            const Parameter* p = find_parameter(parameters, s.name);
            if (!p) {
                std::string hint = suggest(s.name, known);
                if (const Parameter* meant = probably(s.name, parameters, known))
                    hint = fmt::format("did you mean '{}'{}?", meant->name, in_brackets(meant->doc));
                else if (known.empty())
                    hint = fmt::format("{} has no parameters", use.type);
                out_.unknown(s.name_at, fmt::format("{} has no parameter '{}'", use.type, s.name), hint);
                continue;
            }
            if (const auto [it, fresh] = first_line.emplace(p->name, s.name_at.line); !fresh)
                out_.error(s.name_at,
                           fmt::format("parameter '{}' is given twice, first on line {}", s.name, it->second),
                           "remove one of them");
            if (p->kind != ParameterKind::text && in_braces(s.value) && !check_formula(s, *p)) continue;
            const auto value = parse_parameter(p->kind, s.in_force(p->kind));
            if (!value) {
                const std::string meant = corrected(p->kind, s.value);
                out_.error(
                    s.value_at, fmt::format("{} = '{}' is not {}", p->name, s.value, describe(p->kind)),
                    !meant.empty() ? fmt::format("did you mean '{}'?", meant)
                                   : fmt::format("{}{} is {}, {} by default", p->name, in_brackets(p->doc),
                                                 describe(p->kind), to_text(p->default_value)));
                continue;
            }
            if (p->is_time_constant)
                check_time_constant(p->name, p->doc, std::get<double>(*value), seconds_per_cycle(system_),
                                    s.value_at, out_);
            if (s.value_at.file &&
                outside(*value, p->range))  // values without a file were checked when they were set
                note_unusual(s, *p);
        }
    }

    /// Whether a formula has a value that its parameter can take. Reports what is wrong.
    bool check_formula(const Setting& s, const Parameter& p) {
        try {
            const auto v = constants_.value(s.value, scope_);
            if (v && std::isfinite(*v) && parse_parameter(p.kind, to_text(*v))) return true;
            if (v)  // otherwise a constant has no value
                out_.error(s.value_at, fmt::format("{} = '{}' is {}, not {}", p.name, s.value, to_text(*v),
                                                   describe(p.kind)));
        } catch (const FormulaError& e) {
            out_.error(inside(s.value_at, e.at), fmt::format("{} = '{}': {}", p.name, s.value, e.what()),
                       e.hint);
        }
        return false;
    }

    /// Collects values outside of the usual range: a system may have hundreds of them.
    void note_unusual(const Setting& s, const Parameter& p) {
        const auto hint = fmt::format("{} ({}) is meant for {} to {}; the value is used as it is", p.name,
                                      p.label, to_text(p.range->low), to_text(p.range->high));
        auto& unusual = unusual_[{s.value_at.file ? s.value_at.file->path : std::string(), hint}];
        if (unusual.count++ > 0) return;
        unusual.where = s.value_at, unusual.hint = hint;
        unusual.message = fmt::format("{} = {} is outside its usual range", p.name, s.in_force(p.kind));
    }

    /// The location of the setting that a type's check() names, or that of the use as a whole.
    static Location place_of(const Diagnostic& d, const TypeUse& use) {
        Location at = use.at;
        for (const auto& s : use.settings)
            if (s.name == d.parameter) at = s.value_at;
        return at;
    }

    /// Lets a neuron or synapse type check its parameters.
    template <class Type>
    void check_with_type(const TypeUse& use, const Type& type, std::string_view whose) {
        if (!type.check) return;
        Diagnostics found;
        try {
            const auto object = type.make();
            apply(use, type.parameters, object->parameters());
            if (type.set_dt) type.set_dt(object->parameters(), seconds_per_cycle(system_));
            type.check(object->parameters(), found);
        } catch (...) {
            return out_.error(use.at, fmt::format("{} failed to check its parameters: {}", type.name,
                                                  current_exception_message()));
        }
        for (Diagnostic d : found.all()) {
            d.where = place_of(d, use);
            // A value from the command line has no location that would show the item.
            if (!d.where.file) d.message = fmt::format("'{}': {}", whose, d.message);
            out_.add(std::move(d));
        }
    }

    void check_group(const Group& group) {
        if (const NeuronType* type = registry_.neuron(group.neuron.type)) {
            check_settings(group.neuron, type->parameters);
            check_with_type(group.neuron, *type, trim(group.name));
            arrays_.initial(group.neuron, names_of(type->states), names_of(type->parameters), scope_,
                            cells_of(&group), 1);
        } else {
            out_.add(unknown_type("neuron", group.neuron, names(registry_.neurons()), registry_));
        }
        check_topology(group);
    }

    /// The number of cells of a group; 0 when it is not known.
    static std::size_t cells_of(const Group* group) {
        if (!group) return 0;
        const GroupShape size = shape(group->topology);
        const bool is_sound = size.width >= 1 && size.height >= 1 &&
                              static_cast<long long>(size.width) * size.height <= max_extent;
        return is_sound ? static_cast<std::size_t>(size.cells) : 0;
    }

    void check_topology(const Group& group) {
        const auto* sparse = std::get_if<SparseTopology>(&group.topology);
        if (sparse)
            for (const auto& p : sparse->points)
                if (p.x < 1 || p.y < 1)
                    out_.unknown(p.at, fmt::format("there is no cell at x = {}, y = {}", p.x, p.y),
                                 "cells count from 1");
        const GroupShape size = shape(group.topology);
        if (size.width < 1 || size.height < 1)
            out_.error(group.at, fmt::format("group '{}' has no cells", group.name),
                       "width and height start at 1");
        else if (static_cast<long long>(size.width) * size.height > max_extent)
            out_.error(group.at,
                       fmt::format("group '{}' is too large: {} x {}", group.name, size.width, size.height),
                       fmt::format("{} have an extent of at most {} cells",
                                   sparse ? "the points of a group" : "groups", max_extent));
    }

    void check_module(const Process& process) {
        const ModuleUse& use = *process.module;
        const ModuleType* type = registry_.module(use.type);
        if (!type) {
            auto unknown = unknown_type("module", use, names(registry_.modules()), registry_);
            if (!process.module_enabled)
                unknown.severity = Severity::warning, unknown.message += "; the module is disabled";
            return out_.add(std::move(unknown));
        }
        check_settings(use, type->parameters);
        ModulePorts ports;
        ports.process = process.name;
        ports.environment = environment_;
        check_ports(process, *type, use.inputs, false, ports.inputs);
        check_ports(process, *type, use.outputs, true, ports.outputs);
        // All modules report their errors, but each of them checks only what has no other error.
        check_with_type(use, *type, ports, process.module_enabled, out_.errors() == found_by_modules_);
    }

    void check_ports(const Process& process, const ModuleType& type,
                     const std::vector<CrossReference>& references, bool outputs,
                     std::vector<ModulePorts::Group>& found) {
        const ModuleUse& use = *process.module;
        const bool enabled = process.module_enabled;
        const std::string_view holder = outputs ? "OutputToGroup" : "InputFromGroup";
        std::vector<ModulePort> ports;
        for (const auto& port : type.ports)
            if (port.is_output == outputs) ports.push_back(port);
        const auto known = names_of(ports);
        std::map<std::string_view, int> first_line;
        std::vector<std::string_view>
            meant;  // ports that misspelt references mean; they are not reported as missing
        for (const auto& r : references) {
            if (const auto [it, fresh] = first_line.emplace(r.name, r.at.line); !fresh) {
                out_.error(
                    r.at,
                    fmt::format("cross reference '{}' is given twice, first on line {}", r.name, it->second),
                    "remove one of them");
                continue;
            }
            if (type.any_ports) {
                ModulePort port;
                port.name = r.name;
                ports.push_back(port);
            } else if (!contains(known, r.name)) {
                meant.push_back(nearest(r.name, known));
                out_.unknown(
                    r.at, fmt::format("{} has no cross reference '{}' in {}", use.type, r.name, holder),
                    known.empty() ? fmt::format("it has none in {}", holder) : suggest(r.name, known));
            }
            if (!r.target.empty() && !groups_.find(r.target).group && !is_open_port(system_, r.target) &&
                !follows_from_repeated_)
                out_.error(r.at,
                           fmt::format("cross reference '{}' leads to '{}', which is not the id of a group",
                                       r.name, r.target),
                           near_id(r.target));
        }
        for (const auto& port : ports) {
            const auto it = std::ranges::find(references, port.name, &CrossReference::name);
            const bool set = it != references.end() && !it->target.empty();
            found.push_back({port.name, {}, {}});
            if (!set) {
                const bool misspelt = it == references.end() && contains(meant, port.name);
                if (enabled && !port.optional && !(misspelt && !out_.lenient))
                    out_.add({Severity::error,
                              it == references.end() ? use.at : it->at,
                              fmt::format("the cross reference '{}' of {} is not set", port.name, use.type),
                              fmt::format("in {}, give it the id of a group for: {}", holder,
                                          port.label.empty() ? port.name : port.label),
                              {},
                              port.name});
                continue;
            }
            const auto entry = groups_.find(it->target);
            if (!entry.group) continue;
            found.back().path =
                std::string(trim(entry.process->name)) + "/" + std::string(trim(entry.group->name));
            found.back().shape = shape(entry.group->topology);
            if (outputs && enabled) check_single_writer(process, *it, found.back().path);
        }
    }

    /// A group receives the sum of all outputs that lead to it, which is rarely meant.
    void check_single_writer(const Process& process, const CrossReference& output, const std::string& path) {
        const auto [it, fresh] = writers_.emplace(output.target, Writer{&process, &output, path});
        if (fresh) return;
        const auto& other = it->second.process;
        const bool same = other == &process;
        const Severity severity = same || out_.lenient ? Severity::warning : Severity::error;
        found_by_modules_ += severity == Severity::error;
        out_.add(
            {severity,
             output.at,
             fmt::format("'{}' writes to '{}', to which '{}' of {} writes, too", output.name, path,
                         it->second.output->name,
                         same ? "the same module" : fmt::format("the module of '{}'", trim(other->name))),
             "give each output a group of its own; connections can add their activities",
             {},
             {}});
    }

    /// Checks the sizes of a module's groups and, when they are right, lets an enabled module check itself.
    void check_with_type(const ModuleUse& use, const ModuleType& type, const ModulePorts& ports, bool enabled,
                         bool alone) {
        Diagnostics found;
        found.lenient = out_.lenient;
        try {
            const auto module = type.make();
            apply(use, type.parameters, module->parameters());
            check_sizes(type, ports, module->parameters(), found);
            if (enabled && alone && !found.failed()) module->check(ports, found);
        } catch (const FileError& e) {
            ++found_by_modules_;
            return report(e, out_);
        } catch (...) {
            return out_.error(use.at, fmt::format("{} failed to check its parameters: {}", type.name,
                                                  current_exception_message()));
        }
        for (Diagnostic d : found.all()) {
            d.where = place_of(d, use);
            if (!enabled) d.severity = Severity::warning, d.message += "; the module is disabled";
            for (const auto* references : {&use.inputs, &use.outputs})
                for (const auto& r : *references)
                    if (r.name == d.port) d.where = r.at;
            found_by_modules_ += d.severity == Severity::error;
            out_.add(std::move(d));
        }
    }

    void check_connection(const Connection& c) {
        const auto source = end(c, c.source, c.source_at, "source");
        const auto target = end(c, c.target, c.target_at, "target");
        const auto type_of = [&](const Group* g) { return g ? registry_.neuron(g->neuron.type) : nullptr; };
        if (const NeuronType* type = type_of(source); type && !c.state.empty())
            if (const auto known = names_of(type->states); !contains(known, c.state))
                out_.error(c.state_at, fmt::format("{} has no state '{}'", type->name, c.state),
                           suggest(c.state, known));
        if (const NeuronType* type = type_of(target); type && !c.input.empty()) {
            if (!contains(type->inputs, c.input))
                out_.error(c.input_at, fmt::format("{} has no further input '{}'", type->name, c.input),
                           type->inputs.empty() ? "a declared type has 'input NAME' among its equations"
                                                : suggest(c.input, type->inputs));
            if (c.kind != InputKind::excitatory)
                out_.error(c.input_at,
                           fmt::format("connection '{}' is {} and has the input '{}'", trim(c.name),
                                       name_of(c.kind), c.input),
                           "leave out the type; equations say how the input acts");
        } else if (type) {
            if (!type->reads[static_cast<std::size_t>(c.kind)])
                out_.warning(c.at, fmt::format("connection '{}' has no effect: {} reads no {} input", c.name,
                                               type->name, name_of(c.kind)));
        }
        if (const auto writer = writers_.find(c.target); writer != writers_.end())
            out_.warning(
                c.at,
                fmt::format("connection '{}' leads to '{}', to which the module of process '{}' writes: its "
                            "cells get the sum of both",
                            trim(c.name), writer->second.path, trim(writer->second.process->name)),
                "lead it to another group, unless the sum is meant");
        const bool weighted = std::holds_alternative<Weights>(c.pattern);
        const auto& use = synapse_of(c);
        const SynapseType* type = registry_.synapse(use.type);
        if (type) {
            check_settings(use, type->parameters);
            check_with_type(use, *type, trim(c.name));
            check_feedback(use, *type, target);
            std::vector<std::string> states;  // the output is computed before anything reads it
            for (const auto& s : type->states)
                if (!s.output) states.push_back(s.name);
            arrays_.initial(use, states, names_of(type->parameters), scope_, cells_of(target),
                            cells_of(source));
        } else {
            out_.add(unknown_type("synapse", use, names(registry_.synapses()), registry_));
        }
        if (weighted)
            arrays_.weights(c, type, static_cast<int>(cells_of(source)), static_cast<int>(cells_of(target)));
        check_attenuation(c.attenuation);
        check_delay(c.delay);
    }

    /// Warns about functions that the original interprets in an unexpected way (see distance_functions.h).
    void check_attenuation(const DistanceFunction& f) {
        if (const auto* uniform = std::get_if<UniformFunction>(&f.form); uniform && uniform->value < 0)
            out_.warning(f.at,
                         fmt::format("a negative attenuation, {}, counts as 0", to_text(uniform->value)));
        check_sigma(f);
    }

    void check_delay(const DistanceFunction& f) {
        std::vector<double> bounds;
        std::visit(
            [&](const auto& form) {
                if constexpr (requires { form.value; })
                    bounds = {form.value};
                else if constexpr (requires { form.min; })
                    bounds = {form.min, form.max};
                else
                    bounds = {form.max};
            },
            f.form);
        for (const double v : bounds) {
            if (v > max_delay)
                out_.error(f.at, fmt::format("a delay of {} cycles is not possible", to_text(v)),
                           fmt::format("delays are at most {} cycles", max_delay));
            else if (v < 0)
                out_.warning(f.at, fmt::format("a delay cannot be negative: {}", to_text(v)),
                             "delays below 0 count as 0");
            else if (v != std::trunc(v))
                out_.warning(f.at, fmt::format("delays are whole cycles: {} counts as {}", to_text(v),
                                               to_text(std::trunc(v))));
        }
        check_sigma(f);
    }

    void check_sigma(const DistanceFunction& f) {
        const auto* gaussian = std::get_if<GaussianFunction>(&f.form);
        if (gaussian && gaussian->sigma == 0)
            out_.warning(f.at, "sigma = 0 counts as 0.0001: only distance 0 differs from the rest",
                         "sigma is the width in cells");
        else if (gaussian && gaussian->sigma < 0)
            out_.warning(
                f.at,
                fmt::format("sigma = {0} counts as {1}", to_text(gaussian->sigma), to_text(-gaussian->sigma)),
                "sigma is the width in cells");
    }

    const Group* end(const Connection& c, const std::string& id, const Location& at, std::string_view which) {
        const Group* group = groups_.find(id).group;
        if (!group && !follows_from_repeated_)
            out_.error(
                at, fmt::format("the {} '{}' of connection '{}' is not the id of a group", which, id, c.name),
                near_id(id));
        return group;
    }

    void check_feedback(const SynapseUse& use, const SynapseType& type, const Group* target) {
        const auto known = names_of(type.feedback);
        for (const auto& r : use.feedback)
            if (!contains(known, r.name))
                out_.unknown(r.at, fmt::format("{} has no feedback input '{}'", use.type, r.name),
                             known.empty() ? fmt::format("{} has none", use.type) : suggest(r.name, known));
        const NeuronType* neuron = target ? registry_.neuron(target->neuron.type) : nullptr;
        if (!neuron) return;
        const auto states = names_of(neuron->states);
        for (const auto& f : type.feedback) {
            if (f.own) {
                if (!f.state.empty() && !contains(states, f.state))
                    out_.error(use.at,
                               fmt::format("{} reads '{}' of its target: {} has no state '{}'", use.type,
                                           f.name, neuron->name, f.state),
                               suggest(f.state, states));
                continue;
            }
            const auto it = std::ranges::find(use.feedback, f.name, &CrossReference::name);
            if (it == use.feedback.end() || it->target.empty()) {
                if (f.required)
                    out_.add(
                        {Severity::error,
                         it == use.feedback.end() ? use.at : it->at,
                         fmt::format("the feedback input '{}' of {} is not set", f.name, use.type),
                         fmt::format("name a state of the target's {} in <XRefHolder name=\"Freedback\">: {}",
                                     neuron->name, separated(states, ", ")),
                         {},
                         f.name});
            } else if (!contains(states, it->target)) {
                out_.error(it->at, fmt::format("{} has no state '{}'", neuron->name, it->target),
                           suggest(it->target, states));
            }
        }
    }

    std::string near_id(const std::string& id) const {
        std::vector<std::string> ids, paths;  // what connections may lead to: groups, and ports of parts
        const auto add = [&](const Process& p, const Group& g, const std::string& own) {
            ids.push_back(own);
            paths.push_back(std::string(trim(p.name)) + "/" + std::string(trim(g.name)));
        };
        for (const auto& p : system_.processes) {
            const auto first = static_cast<std::ptrdiff_t>(ids.size());
            const bool is_part = p.linked() && !p.ports.empty();
            if (is_part && !p.within.empty()) continue;
            for (const auto& g : p.groups)
                if (!is_part) add(p, g, g.id);
            for (const auto& port : p.ports)
                if (const auto g = groups_.find(port.group); is_part && g.group)
                    add(*g.process, *g.group, p.id + "." + port.name);
            if (p.id == id || (is_part && trim(p.name) == id))
                return fmt::format(
                    "'{}' is a process; its {} are '{}'", id, is_part ? "ports" : "groups",
                    separated(std::span(ids).subspan(static_cast<std::size_t>(first)), "', '"));
            if (is_part && id.starts_with(p.id + "."))
                return fmt::format(
                    "the ports of '{}' are '{}'", p.path,
                    separated(std::span(ids).subspan(static_cast<std::size_t>(first)), "', '"));
        }
        for (std::size_t i = 0; i < paths.size(); ++i)
            if (paths[i] == id || paths[i].substr(paths[i].find('/') + 1) == id)
                return fmt::format("'{}' is a name; write '{}'", id, ids[i]);
        if (const auto near = nearest(id, ids); !near.empty()) return fmt::format("did you mean '{}'?", near);
        return "ids are the id attributes of <Group> elements";
    }

    const System& system_;
    const Registry& registry_;
    Diagnostics& out_;
    Environment* environment_;
    Constants constants_;
    ArrayCheck arrays_;
    const Process* scope_ = nullptr;  ///< whose constants hold in the item that is checked
    int found_by_modules_ = 0;        ///< errors
    int repeated_ids_ = 0;
    bool follows_from_repeated_ = false;  ///< whether references to unknown ids follow from repeated ones
    struct Unusual {
        Location where;
        std::string message, hint;
        int count = 0;
    };
    std::map<std::pair<std::string, std::string>, Unusual> unusual_;  ///< by file and hint
    struct Writer {
        const Process* process;
        const CrossReference* output;
        std::string path;  ///< of the group
    };
    std::map<std::string_view, Writer> writers_;  ///< the first of the enabled modules, by the group's id
    GroupIndex groups_;
};

}  // namespace

void check_time_constant(const std::string& name, std::string_view doc, double tau, double dt,
                         const Location& at, Diagnostics& out) {
    if (!(tau > 0))
        out.error(at, fmt::format("{} = {} is not possible", name, to_text(tau)),
                  fmt::format("{}{} is a time constant: more than 0 s", name, in_brackets(doc)));
    else if (tau < 2 * dt)
        out.warning(at,
                    fmt::format("{} = {} s is less than two cycles of {} s, so the cell cannot follow it",
                                name, to_text(tau), to_text(dt)),
                    fmt::format("set cylesPerSecond to at least {:.6g}", std::ceil(2 / tau)));
}

void validate(const System& system, const Registry& registry, Diagnostics& diagnostics,
              Environment* environment) {
    Validator(system, registry, diagnostics, environment).run();
}

void apply(const TypeUse& use, const std::vector<Parameter>& parameters, void* object) {
    for (const auto* settings : {&use.defaults, &use.settings})
        for (const auto& s : *settings)
            if (const Parameter* p = find_parameter(parameters, s.name))
                if (const auto value = parse_parameter(p->kind, s.in_force(p->kind)))
                    p->set(object, p->is_path ? ParameterValue(resolved(s.value, s.value_at)) : *value);
}

}  // namespace forage::model
