#include <deque>

#include "core/plugin/rehearsal.h"
#include "core/plugin/stage.h"
#include "core/plugin/synapse_promises.h"

namespace forage::plugin {

std::string rehearse(const SynapseType& type) {
    if (type.has_gain) return {};
    std::deque<Fenced> stage;
    std::vector<Column> states;
    std::vector<ConstColumn> feedback;
    for (std::size_t i = 0; i < type.states.size(); ++i) states.push_back(stage.emplace_back(cells).column());
    for (std::size_t i = 0; i < type.feedback.size(); ++i)
        feedback.emplace_back(stage.emplace_back(cells).data(), cells);
    const ConstColumn pre(stage.emplace_back(cells).data(), cells);
    double* const sums = stage.emplace_back(cells).data();
    const std::string fault = watch(stage, [&] {
        const auto synapse = type.make();
        SynapseColumns columns(pre, states, feedback);
        for (int i = 0; i < updates; ++i) synapse->update(columns);
        const std::vector<ConstColumn> no_feedback;
        SynapseColumns told(pre, states, no_feedback), added(pre, states, feedback, sums);
        if (type.tells_output) synapse->output(told);
        if (type.adds_output) synapse->update_and_add(added);
    });
    return fault.empty() ? broken_promise(type) : fault;
}

}  // namespace forage::plugin
