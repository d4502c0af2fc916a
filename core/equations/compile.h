// Equations to a program: what each name means.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/equations/program.h"
#include "core/equations/statements.h"

namespace forage::equations {

/// What a program reads as a column.
struct Read {
    enum class Kind {
        state,  ///< a state of the type, before this cycle; "pre" is one, too
        exc,    ///< sums of inputs
        inh,
        mod,
        input,     ///< a further input
        draw,      ///< uniform random numbers
        pre_now,   ///< the source's output in this cycle
        post,      ///< a state of the target in the last cycle
        post_now,  ///< and in this one
    };
    Kind kind;
    std::size_t index = 0;   ///< of the state, input or draw
    std::string state = {};  ///< of the target; empty: its output
    friend bool operator==(const Read&, const Read&) = default;
};

/// Names that equations may use.
struct Vocabulary {
    bool synapse = false;                ///< the type is that of synapses
    std::vector<std::string> constants;  ///< of the type
    std::vector<std::string> states;     ///< those that the type declares
    std::vector<std::string> outer;      ///< constants of systems and processes
};

/// Equations, ready to run. The scalars of the program are `dt`, `t` and the constants.
struct Compiled {
    Program program;
    std::vector<Read> reads;             ///< by column that is read
    std::vector<std::string> constants;  ///< those of the type, then the outer ones that equations use
    std::vector<std::string> states;     ///< those that the type declares, then the others
    std::vector<std::string> inputs;     ///< further ones
    std::vector<std::size_t> written;    ///< the state of each column that is written
    std::vector<std::size_t> kept;       ///< states that no equation changes
    std::size_t output = 0;  ///< the state that is the output; as many as there are when it is missing
    std::size_t draws = 0;
    bool uses_time = false;
    std::vector<std::string> time_constants;  ///< constants tau of dx/dt = (... - x) / tau
    std::vector<std::string> unused;          ///< constants and states of the type that no equation names
    std::vector<FormulaError> warnings;
};

/// Compiles equations. Reports mistakes, at their places in the text.
Compiled compile(std::string_view text, const Vocabulary& names, const Report& report);

}  // namespace forage::equations
