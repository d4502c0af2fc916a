// What a group receives at the end of a cycle: from modules, and through its connections.
#pragma once

#include "core/engine/plan/plan.h"

namespace forage::engine {

/// Notes which outputs of a module differ from what it wrote before.
void note_changes(ModulePlan& module);

/// Delivers what modules have written; before the first cycle.
void receive_from_modules(Plan& plan, GroupPlan& group);

/// Keeps a group's activity of `cycle` for the connections with a delay.
void remember(const GroupPlan& group, std::uint64_t cycle);

/// Delivers all that the group receives in the cycle after `cycle`; lets its synapses learn. To be called
/// when the group and all its sources are updated and remembered, and the modules that write to it, too.
void deliver_to(Plan& plan, GroupPlan& group, std::uint64_t cycle);

/// The same in parts: begin_delivery(); when `receives` is set after it, prepare_part() for each of
/// `group.parts`, by several threads at once; then the incoming connections one after the other, by
/// add_part() for each part of one that divides(), by deliver_through() for others.
void begin_delivery(Plan& plan, GroupPlan& group, std::uint64_t cycle);
void prepare_part(Plan& plan, GroupPlan& group, int part, std::uint64_t cycle);
bool divides(const GroupPlan& group, const ConnectionPlan& connection);
void add_part(Plan& plan, GroupPlan& group, ConnectionPlan& connection, int part, std::uint64_t cycle);
void deliver_through(Plan& plan, GroupPlan& group, ConnectionPlan& connection, std::uint64_t cycle);

/// Sets `delivery_cost` of all groups.
void estimate_deliveries(Plan& plan);

/// About how long all deliveries of the next cycle take on one thread, ns.
double delivery_cost(const Plan& plan);

}  // namespace forage::engine
