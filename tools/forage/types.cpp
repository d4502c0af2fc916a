#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <forage/system.h>

#include "core/base/print.h"
#include "core/xml/schema.h"
#include "tools/forage/commands.h"
#include "tools/forage/options.h"

namespace forage::tool {
namespace {

/// Rows of a name and its description, in two columns.
class Rows {
  public:
    explicit Rows(std::string title) : title_(std::move(title)) {}
    void add(std::string name, std::string text) {
        width_ = std::max(width_, name.size());
        rows_.emplace_back(std::move(name), std::move(text));
    }
    void print() const {
        if (rows_.empty()) return;
        forage::print("\n{}\n", title_);
        for (const auto& [name, text] : rows_) forage::print("  {:<{}}  {}\n", name, width_, text);
    }

  private:
    std::string title_;
    std::size_t width_ = 0;
    std::vector<std::pair<std::string, std::string>> rows_;
};

template <class Type>
void describe(const Type& type) {
    print("{}{}\n", type.name, type.label == type.name ? "" : fmt::format(" ({})", type.label));
    if (!type.doc.empty()) print("{}\n", type.doc);
    Rows rows("Parameters");
    for (const auto& p : type.parameters) {
        const std::string value = to_text(p.default_value);
        rows.add(p.name, fmt::format("{} Default {}{}{}{}.", p.doc,
                                     p.kind == ParameterKind::text ? "'" + value + "'" : value,
                                     p.unit.empty() ? "" : " " + p.unit,
                                     p.range ? fmt::format(", usual range {} to {}", to_text(p.range->low),
                                                           to_text(p.range->high))
                                             : "",
                                     p.at_start ? "; read at start" : "") +
                             (p.is_path ? " Relative to the folder of the file that sets it." : ""));
    }
    rows.print();
}

template <class Type>
void describe_states(const Type& type) {
    Rows rows("States");
    for (const auto& s : type.states) {
        std::string text = s.label + (s.output ? " (output)" : "");
        if constexpr (requires { s.feedback; }) text += s.feedback ? "; synapses may read it back" : "";
        rows.add(s.name, text);
    }
    rows.print();
}

void describe_inputs(const NeuronType& type) {
    constexpr std::pair<const char*, const char*> inputs[] = {
        {"excIn", "Excitation"}, {"inhIn", "Inhibition"}, {"modIn", "Modulation"}};
    Rows rows("Inputs");
    for (std::size_t i = 0; i < input_kinds; ++i)
        rows.add(inputs[i].first, std::string(inputs[i].second) + (type.reads[i] ? "" : " (not read)"));
    for (const auto& input : type.inputs)
        rows.add(input, "Further input, of connections with input=\"" + input + "\"");
    rows.print();
}

void describe_ports(const ModuleType& type) {
    for (const bool outputs : {false, true}) {
        Rows rows(outputs ? "Writes to groups" : "Reads from groups");
        for (const auto& p : type.ports) {
            if (p.is_output != outputs) continue;
            rows.add(p.name,
                     fmt::format("{}: {}{}.{}{}", p.label, p.size.text.empty() ? "any size" : p.size.text,
                                 p.optional ? " (optional)" : "", p.doc.empty() ? "" : " ", p.doc));
        }
        rows.print();
    }
    if (type.any_ports) print("\nCross references of any name.\n");
}

void describe_all(const NeuronType& type) {
    describe(type);
    describe_inputs(type);
    describe_states(type);
}

void describe_all(const SynapseType& type) {
    describe(type);
    describe_states(type);
    Rows rows("Cross references to states of the target");
    for (const auto& f : type.feedback)
        if (!f.own) rows.add(f.name, f.label + (f.required ? "" : " (optional)"));
    rows.print();
}

void describe_all(const ModuleType& type) {
    describe(type);
    describe_ports(type);
}

/// Describes the types that a system declares.
int types_of_file(const std::string& path, const std::vector<std::string>& plugins) {
    const SystemFile file = read_system(path, plugins);
    const char* between = "";
    const auto one = [&](const auto* type) {
        print("{}", std::exchange(between, "\n"));
        describe_all(*type);
    };
    for (const auto& t : file.model.neuron_types) one(file.types->neuron(t.name));
    for (const auto& t : file.model.synapse_types) one(file.types->synapse(t.name));
    if (!*between) print("{} declares no types.\n", path);
    return fine;
}

template <class Map>
void list(std::string_view kind, const Map& types) {
    print("{}\n", kind);
    for (const auto& [name, type] : types) print("  {:<28} {}\n", name, type.doc);
}

/// The types that ship with Forage and those of plugins. Prints an error and returns nothing when a plugin
/// cannot be loaded.
std::optional<Registry> registry_with(const std::vector<std::string>& plugins) {
    Diagnostics diagnostics;
    const auto loaded = plugins_to_read(plugins, "", diagnostics);
    print(stderr, "{}", format(diagnostics));
    if (diagnostics.failed()) return std::nullopt;
    return known_types(loaded);
}

struct SchemaOptions {
    bool of_experiments = false;  ///< the schema of experiment files instead of system files
    bool markdown = false;        ///< tables for the reference instead of a schema
    std::vector<std::string> plugins;
};

int schema(const SchemaOptions& options) {
    if (options.of_experiments) return print("{}", xml::relax_ng_of_experiments()), fine;
    const auto registry = registry_with(options.plugins);
    if (!registry) return bad_input;
    print("{}", options.markdown ? xml::markdown_tables(*registry) : xml::relax_ng(*registry));
    return fine;
}

struct TypesOptions {
    std::string name;  ///< of a type, or of a system file; empty: list the types
    std::vector<std::string> plugins;
};

int types(const TypesOptions& o) {
    if (o.name.ends_with(".iqr")) try {
            return types_of_file(o.name, o.plugins);
        } catch (const InputError& e) {
            print(stderr, "{}", e.what());
            return bad_input;
        }
    const auto found = registry_with(o.plugins);
    if (!found) return bad_input;
    const Registry& registry = *found;
    if (o.name.empty()) {
        list("Neurons", registry.neurons());
        list("Synapses", registry.synapses());
        list("Modules", registry.modules());
        print("'forage types NAME' describes one.\n");
        return fine;
    }
    if (const auto* neuron = registry.neuron(o.name)) return describe_all(*neuron), fine;
    if (const auto* synapse = registry.synapse(o.name)) return describe_all(*synapse), fine;
    if (const auto* module = registry.module(o.name)) return describe_all(*module), fine;
    std::vector<std::string> all = names(registry.neurons());
    for (const auto& n : names(registry.synapses())) all.push_back(n);
    for (const auto& n : names(registry.modules())) all.push_back(n);
    return refused(fmt::format("there is no type '{}'", o.name), suggest(o.name, all));
}

}  // namespace

void add_types(Program& program) {
    const auto [command, o] = program.add(
        "types",
        "List the neuron, synapse and module types, or describe one, or those that a system declares", types,
        "Example:\n  forage types neuronLinearThreshold\n  forage types model.iqr");
    add_value(command, "NAME", o.name, " ", "The type to describe, or a system file (.iqr)");
    add_plugins(command, o.plugins);
}

void add_schema(Program& program) {
    const auto [command, o] = program.add("schema", "Print a RELAX NG schema of system files, for editors",
                                          schema, "Example:\n  forage schema > iqr.rng");
    command.add_flag("--experiment", o.of_experiments, "The schema of experiment files instead");
    command.add_flag("--markdown", o.markdown,
                     "The elements of system files and the types, as tables in Markdown, instead");
    add_plugins(command, o.plugins);
}

}  // namespace forage::tool
