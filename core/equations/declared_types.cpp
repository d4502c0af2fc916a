#include "core/equations/declared_types.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "core/base/number.h"
#include "core/base/sequence.h"
#include "core/equations/compile.h"
#include "core/model/constants.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"

namespace forage::equations {
namespace {

using Equations = std::shared_ptr<const Compiled>;

/// All equations of a type, with a line break between their pieces.
std::string text_of(const model::TypeDeclaration& d) {
    std::string out;
    for (const auto& piece : d.equations) out += (out.empty() ? "" : "\n") + piece.text;
    return out;
}

/// The scalars of a program, as the parameters of a type: dt, t, and the constants.
using Scalars = std::vector<double>;

double* scalar(void* parameters, std::size_t i) { return &(*static_cast<Scalars*>(parameters))[i]; }

class Neuron final : public NeuronInstance {
  public:
    Neuron(Equations equations, Scalars defaults)
        : equations_(std::move(equations)), scalars_(std::move(defaults)) {}
    void* parameters() override { return &scalars_; }

    void update(NeuronColumns& c) const override {
        const Compiled& e = *equations_;
        const auto old = [&](std::size_t state) { return c.past(static_cast<int>(state), 1).data(); };
        const double* read[largest];
        double* written[largest];
        for (std::size_t i = 0; i < e.reads.size(); ++i) switch (const Read& r = e.reads[i]; r.kind) {
                case Read::Kind::exc:
                    read[i] = c.excitation().data();
                    break;
                case Read::Kind::inh:
                    read[i] = c.inhibition().data();
                    break;
                case Read::Kind::mod:
                    read[i] = c.modulation().data();
                    break;
                case Read::Kind::input:
                    read[i] = c.input(static_cast<InputKind>(input_kinds + r.index)).data();
                    break;
                case Read::Kind::draw:
                    read[i] = c.uniform(static_cast<std::uint32_t>(r.index)).data();
                    break;
                default:
                    read[i] = old(r.index);
            }
        for (std::size_t i = 0; i < e.written.size(); ++i)
            written[i] = c.state(static_cast<int>(e.written[i])).data();
        if (!e.uses_time) {
            e.program.run(scalars_, {read, e.reads.size()}, {written, e.written.size()}, c.size());
        } else {
            Scalars now = scalars_;
            now[1] = static_cast<double>(c.cycle()) * now[0];
            e.program.run(now, {read, e.reads.size()}, {written, e.written.size()}, c.size());
        }
        for (const std::size_t s : e.kept)
            if (double* now = c.state(static_cast<int>(s)).data(); now != old(s))
                std::copy_n(old(s), c.size(), now);
    }

    /// The largest number of columns that a type reads or writes.
    static constexpr std::size_t largest = 256;

  private:
    Equations equations_;
    Scalars scalars_;
};

class Synapse final : public SynapseInstance {
  public:
    Synapse(Equations equations, Scalars defaults)
        : equations_(std::move(equations)), scalars_(std::move(defaults)) {}
    void* parameters() override { return &scalars_; }
    double gain() const override { return 1; }

    void update(SynapseColumns& c) const override {
        const Compiled& e = *equations_;
        const double* read[Neuron::largest];
        double* written[Neuron::largest];
        std::size_t feedback = 0;
        for (std::size_t i = 0; i < e.reads.size(); ++i) switch (const Read& r = e.reads[i]; r.kind) {
                case Read::Kind::pre_now:
                    read[i] = c.pre().data();
                    break;
                case Read::Kind::post:
                case Read::Kind::post_now:
                    read[i] = c.feedback(feedback++).data();
                    break;
                default:
                    read[i] = c.state(r.index).data();
            }
        for (std::size_t i = 0; i < e.written.size(); ++i) written[i] = c.state(e.written[i]).data();
        e.program.run(scalars_, {read, e.reads.size()}, {written, e.written.size()}, c.pre().size());
    }

  private:
    Equations equations_;
    Scalars scalars_;
};

/// Builds the types of a system.
class Builder {
  public:
    Builder(const model::System& system, Registry& registry, Diagnostics& out)
        : registry_(registry),
          out_(out),
          constants_(system),
          seconds_per_cycle_(model::seconds_per_cycle(system)) {
        for (const auto& c : system.constants) outer_.push_back(c.name);
        for (const auto& p : system.processes)
            for (const auto& c : p.constants) outer_.push_back(c.name);
    }

    void add(const model::TypeDeclaration& d, bool synapse) {
        errors_before_ = out_.errors();
        check_names(d, synapse);
        Equations equations = compile(d, synapse);
        const bool sound = out_.errors() == errors_before_;
        if (synapse)
            add_synapse(d, equations, sound);
        else
            add_neuron(d, equations, sound);
    }

  private:
    void check_names(const model::TypeDeclaration& d, bool synapse) {
        const char* kind = synapse ? "synapse" : "neuron";
        if (!is_formula_name(d.name))
            out_.error(d.name_at, fmt::format("'{}' cannot be the name of a type", d.name),
                       "letters, digits and _, not first a digit");
        if (synapse ? registry_.synapse(d.name) != nullptr : registry_.neuron(d.name) != nullptr)
            out_.error(d.name_at, fmt::format("there is already a {} type '{}'", kind, d.name),
                       "choose another name");
        std::vector<std::string> seen;
        const auto see = [&](const std::string& name, const Location& at, const char* what) {
            static const std::vector<std::string> inputs = {"exc", "inh", "mod", "pre", "post", "t", "dt"};
            if (!is_equation_name(name) || contains(inputs, name))
                out_.error(at, fmt::format("'{}' cannot be the name of a {}", name, what),
                           "letters, digits and _, not first a digit; exc, inh, mod, pre, post, t, dt and "
                           "the words of formulas and equations have a meaning of their own");
            if (contains(seen, name))
                out_.error(at, fmt::format("there is already a '{}' in this type", name),
                           "choose another name");
            seen.push_back(name);
        };
        for (const auto& c : d.constants) see(c.name, c.name_at, "constant");
        for (const auto& s : d.states) see(s.name, s.name_at, "state");
    }

    Equations compile(const model::TypeDeclaration& d, bool synapse) {
        const Vocabulary names{synapse, names_of(d.constants), names_of(d.states), outer_};
        auto out =
            std::make_shared<Compiled>(equations::compile(text_of(d), names, [&](const FormulaError& e) {
                out_.error(place(d, e.at), fmt::format("{}: {}", d.name, e.what()), e.hint);
            }));
        if (out_.errors() > errors_before_) return out;
        for (const auto& w : out->warnings)
            out_.warning(place(d, w.at), fmt::format("{}: {}", d.name, w.what()), w.hint);
        const auto warn_of_unused = [&](const auto& all, const char* what) {
            for (const auto& each : all)
                if (contains(out->unused, each.name))
                    out_.warning(each.at,
                                 fmt::format("{}: no equation uses the {} '{}'", d.name, what, each.name));
        };
        warn_of_unused(d.constants, "constant");
        warn_of_unused(d.states, "state");
        if (std::max(out->reads.size(), out->states.size() + 1) >= Neuron::largest)
            out_.error(d.at, fmt::format("{} has more than {} states", d.name, Neuron::largest - 1));
        return out;
    }

    double value(const std::string& text, const Location& at, const std::string& name) {
        try {
            if (const auto v = in_braces(text) ? constants_.value(text, nullptr) : parse_number<double>(text))
                return *v;
            if (!in_braces(text))
                out_.error(at, fmt::format("{} = '{}' is not a number", name, text),
                           "a formula stands in braces: {1 / tau}");
        } catch (const FormulaError& e) {
            out_.error(model::inside(at, e.at), fmt::format("{} = '{}': {}", name, text, e.what()), e.hint);
        }
        return 0;
    }

    void check_time_constant(const model::Constant& tau, double value) {
        if (tau.unit == "ms" || tau.unit == "us")
            out_.warning(tau.at,
                         fmt::format("'{}' is in {}, and derivatives are per second", tau.name, tau.unit),
                         "value=\"0.02\" unit=\"s\", or divide by a product with ms = 0.001");
        else
            model::check_time_constant(tau.name, tau.doc, value, seconds_per_cycle_, tau.value_at, out_);
    }

    std::vector<Parameter> parameters(const model::TypeDeclaration& d, const Compiled& equations,
                                      Scalars& defaults) {
        std::vector<Parameter> out;
        defaults = {0, 0};  // dt and t
        for (const auto& name : equations.constants) {
            const auto own = std::ranges::find(d.constants, name, &model::Constant::name);
            Parameter p;
            p.name = p.label = name;
            p.kind = ParameterKind::real;
            const std::size_t i = defaults.size();
            if (own != d.constants.end()) {
                defaults.push_back(value(own->value, own->value_at, name));
                p.doc = own->doc, p.unit = own->unit;
                p.is_time_constant = contains(equations.time_constants, name);
                if (p.is_time_constant) check_time_constant(*own, defaults.back());
                if (own->minimum || own->maximum)
                    p.range = {own->minimum.value_or(-std::numeric_limits<double>::infinity()),
                               own->maximum.value_or(std::numeric_limits<double>::infinity())};
            } else {
                defaults.push_back(constants_.value_of(name).value_or(0));
                p.doc = "The constant of the system.";
            }
            p.default_value = defaults.back();
            p.set = [i](void* object, const ParameterValue& v) { *scalar(object, i) = std::get<double>(v); };
            p.get = [i](const void* object) { return ParameterValue(*scalar(const_cast<void*>(object), i)); };
            out.push_back(std::move(p));
        }
        return out;
    }

    template <class Info>
    std::vector<Info> states(const model::TypeDeclaration& d, const Compiled& equations) {
        std::vector<Info> out;
        for (std::size_t s = 0; s < equations.states.size(); ++s) {
            Info info;
            info.name = info.label = equations.states[s];
            info.output = s == equations.output;
            const auto declared = std::ranges::find(d.states, info.name, &model::DeclaredState::name);
            if (declared != d.states.end()) {
                if (!declared->value.empty())
                    info.initial = value(declared->value, declared->value_at, info.name);
                if (!declared->doc.empty()) info.label = declared->doc;
            }
            out.push_back(std::move(info));
        }
        if (equations.output >= out.size()) {  // reported
            out.emplace_back();
            out.back().name = "output", out.back().output = true;
        }
        return out;
    }

    template <class Type>
    Type type(const model::TypeDeclaration& d) {
        Type out;
        out.name = out.label = d.name;
        out.doc = d.doc;
        out.declared = true;
        out.set_dt = [](void* object, double seconds) { *scalar(object, 0) = seconds; };
        return out;
    }

    template <class Type>
    void add(Type type) {
        try {
            registry_.add(std::move(type));
        } catch (const std::invalid_argument&) {  // reported
        }
    }

    void add_neuron(const model::TypeDeclaration& d, const Equations& equations, bool sound) {
        auto out = type<NeuronType>(d);
        Scalars defaults;
        out.parameters = parameters(d, *equations, defaults);
        out.states = states<StateInfo>(d, *equations);
        for (auto& s : out.states) s.feedback = true;
        out.elementwise = true;
        for (const auto& [input, kind] : {std::pair(Read::Kind::exc, InputKind::excitatory),
                                          std::pair(Read::Kind::inh, InputKind::inhibitory),
                                          std::pair(Read::Kind::mod, InputKind::modulatory)})
            out.reads[static_cast<std::size_t>(kind)] = !sound || contains(equations->reads, Read{input});
        out.inputs = equations->inputs;
        for (std::size_t i = 0; i < out.inputs.size(); ++i) out.reads[input_kinds + i] = true;
        out.make = [equations, defaults] { return std::make_unique<Neuron>(equations, defaults); };
        add(std::move(out));
    }

    void add_synapse(const model::TypeDeclaration& d, const Equations& equations, bool sound) {
        auto out = type<SynapseType>(d);
        Scalars defaults;
        out.parameters = parameters(d, *equations, defaults);
        out.states = states<SynapseStateInfo>(d, *equations);
        if (sound)
            for (const auto& r : equations->reads)
                if (r.kind == Read::Kind::post || r.kind == Read::Kind::post_now) {
                    const bool now = r.kind == Read::Kind::post_now;
                    const auto name = (r.state.empty() ? "post" : "post." + r.state) + (now ? "'" : "");
                    out.feedback.push_back({name, name, false, true, r.state, now ? 0 : 1});
                }
        out.make = [equations, defaults] { return std::make_unique<Synapse>(equations, defaults); };
        add(std::move(out));
    }

    Registry& registry_;
    Diagnostics& out_;
    model::Constants constants_;
    double seconds_per_cycle_;
    std::vector<std::string> outer_;
    int errors_before_ = 0;  ///< of the type
};

}  // namespace

Location place(const model::TypeDeclaration& d, std::size_t at) {
    for (const auto& piece : d.equations) {
        if (at > piece.text.size()) {
            at -= piece.text.size() + 1;
            continue;
        }
        Location out = piece.at;
        std::size_t line = 0;  // where it begins
        for (std::size_t i = 0; i < at; ++i)
            if (piece.text[i] == '\n') ++out.line, out.column = 1, line = i + 1;
        for (std::size_t i = line; i < at; ++i)  // as the file has it
            out.column += piece.text[i] == '<' ? 4 : piece.text[i] == '&' ? 5 : 1;
        return out;
    }
    return d.at;
}

std::vector<EquationLine> lines(const model::TypeDeclaration& type) {
    const std::string text = text_of(type);
    const auto statements = read_statements(text, [](const FormulaError&) {});
    std::vector<EquationLine> out;
    for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
        end = std::min(text.find('\n', begin), text.size());
        const auto written = model::trim(std::string_view(text).substr(begin, end - begin));
        if (written.empty()) continue;
        auto& line = out.emplace_back(EquationLine{std::string(written), place(type, begin).line, {}});
        for (const auto& s : statements)
            if (s.at >= begin && s.at < end && !contains(line.computes, s.name))
                line.computes.push_back(s.name);
    }
    return out;
}

void add_types(const model::System& system, Registry& registry, Diagnostics& diagnostics) {
    registry.remove_declared();
    if (system.neuron_types.empty() && system.synapse_types.empty()) return;
    Builder builder(system, registry, diagnostics);
    for (const auto& d : system.neuron_types) builder.add(d, false);
    for (const auto& d : system.synapse_types) builder.add(d, true);
}

}  // namespace forage::equations
