// All steps from a text to synapses, which the mutation test and the fuzzer do with each input.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "core/connectivity/connect.h"
#include "core/equations/declared_types.h"
#include "core/model/lookup.h"
#include "core/model/validate.h"
#include "core/xml/patch.h"
#include "core/xml/reader.h"
#include "neurons/neurons.h"
#include "synapses/synapses.h"

namespace forage::test {

struct PipelineResult {
    bool read = false;     ///< whether the text is a system
    bool checked = false;  ///< whether the system has no errors
    std::size_t synapses = 0;
};

inline void must(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

/// Edits the text. Throws when the edit does not read as what it is.
inline void edit(const std::string& text, const model::System& system) {
    must(xml::patched(text, system, system) == text, "a text that is not edited keeps its bytes");
    model::System edited = system;
    for (auto& p : edited.processes) {
        if (p.linked()) continue;
        p.name += " & <more>";
        p.icon = model::Icon{1, 2, 3, 4};
        if (!p.groups.empty()) p.groups.front().topology = model::SparseTopology{{{1, 1, {}}, {2, 3, {}}}};
    }
    if (!edited.connections.empty()) edited.connections.pop_back();
    const auto made = xml::patch("input.iqr", text, system, edited);
    must(made.system && xml::same_content(*made.system, edited), "an edited text reads as the edited system");
}

/// Reads, checks, edits and connects. Throws when a result is impossible.
inline PipelineResult run_pipeline(const std::string& text, const Registry& registry, bool lenient) {
    PipelineResult result;
    Diagnostics diagnostics;
    diagnostics.lenient = lenient;
    const auto system = xml::parse_system("input.iqr", text, diagnostics);
    result.read = system.has_value();
    must(result.read || diagnostics.failed(), "where there is no error, a system is read");
    Registry types = registry;
    if (system) {
        equations::add_types(*system, types, diagnostics);
        model::validate(*system, types, diagnostics);
    }
    result.checked = !diagnostics.failed();
    if (result.checked) {
        edit(text, *system);
        const model::GroupIndex groups(*system);
        for (const auto& c : system->connections) {
            const auto *source = groups.find(c.source).group, *target = groups.find(c.target).group;
            must(source && target, "the ends of a connection that was checked are groups");
            const auto s = connectivity::connect(c, source->topology, target->topology, 1, diagnostics, 1e5);
            const int sources = model::shape(source->topology).cells,
                      targets = model::shape(target->topology).cells;
            must(s.size() <= 100'000, "a connection is not larger than its limit");
            for (std::size_t i = 0; i < s.size(); ++i)
                must(s.pre[i] >= 0 && s.pre[i] < sources && s.post[i] >= 0 && s.post[i] < targets &&
                         s.distance[i] >= 0 && s.delay.at(i) >= 0,
                     "a synapse joins cells that there are");
            result.synapses += s.size();
        }
    }
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const auto& d : diagnostics.all()) {
        must(d.where.file && d.where.line >= 0 && d.where.line <= lines && d.where.column >= 0,
             "a diagnostic lies in its file");
        must(!d.message.empty(), "a diagnostic says something");
    }
    const std::string said = format(diagnostics);
    must(said.empty() == diagnostics.all().empty(), "what is wrong is said");
    return result;
}

inline Registry shipped_types() {
    Registry registry;
    add_neurons(registry);
    add_synapses(registry);
    return registry;
}

}  // namespace forage::test
