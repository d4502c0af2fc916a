// Constants, and what formulas in a system mean.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/formula/formula.h"
#include "core/model/lookup.h"
#include "core/model/system.h"

namespace forage::model {

/// The values of the constants of a system and its processes. It holds pointers into the system and is
/// invalid after an edit.
class Constants {
  public:
    explicit Constants(const System& system) : Constants(system, seconds_per_cycle(system)) {}
    /// `dt` is the time of a cycle, s; without one, formulas cannot use it.
    Constants(const System& system, std::optional<double> dt) : system_(system), dt_(dt) {}

    /// The value of a text that is a number, or a formula in braces of the constants that hold in a process
    /// (in the system as a whole when `process` is null): its own, those of the processes in whose files it
    /// is linked, then those of the system, and `dt`, the seconds per cycle. Throws FormulaError. Empty when
    /// a constant that it uses has no value; that is reported where the constant is defined.
    std::optional<double> value(std::string_view text, const Process* process);

    /// The value of the constant that a name says (find_constant()); empty when it has none.
    std::optional<double> value_of(std::string_view name);

    /// Reports all mistakes in the definitions of constants.
    void check(Diagnostics& diagnostics);

  private:
    struct Defined {
        const Constant* constant;
        const Process* process;  ///< null: the system's
    };
    Defined find(std::string_view name, const Process* process) const;
    /// The process whose constants hold in the formula of a constant of `process`.
    const Process* scope_of(const Constant& constant, const Process* process) const;
    double value_of(const Defined& defined);
    double evaluate(std::string_view text, const Process* process);
    void check(const std::vector<Constant>& all, const Process* process, Diagnostics& diagnostics);

    const System& system_;
    std::optional<double> dt_;
    std::map<const Constant*, std::optional<double>> known_;
    std::vector<const Constant*> open_;     ///< those that are being computed, to find circles
    std::set<const Constant*> in_circles_;  ///< those that check() has reported
};

/// The process whose constants hold in a connection: the innermost that has both its groups; null for none.
const Process* scope_of(const Connection& connection, const GroupIndex& groups);

/// Reads the arrays of a system that are not read yet, and computes all its formulas: sets the numbers that
/// have one, and Setting::computed. Reports mistakes in constants and in formulas of numbers; those of
/// parameters are reported by validate(), which knows their types. Returns whether all numbers have a value.
bool compute(System& system, Diagnostics& diagnostics);
/// The same, without reports: of a system whose mistakes are reported when it is read.
void compute(System& system);

/// Whether constants that have the same name in both have the same value.
bool agree(const std::vector<Constant>& a, const std::vector<Constant>& b);
/// Whether `all` has the constants `wanted`, with the same values.
bool has_all(const std::vector<Constant>& all, const std::vector<Constant>& wanted);

/// Writes out all formulas as the numbers that they have, and removes the constants.
void write_out_formulas(System& system);

/// Gives processes of parts the constants that hold in them, as numbers, so that they can stand in the
/// system's own file.
void settle_constants(System& system);

/// The constant that "name", or "Process.name" for one of a process, says; null when there is none.
const Constant* find_constant(const System& system, std::string_view name);
Constant* find_constant(System& system, std::string_view name);
/// The names of all constants, as find_constant() takes them.
std::vector<std::string> constant_names(const System& system);

/// The place of the byte `offset` of a value in a file.
Location inside(Location value, std::size_t offset);

}  // namespace forage::model
