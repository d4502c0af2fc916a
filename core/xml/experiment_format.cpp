// The elements and attributes of experiment files.
#include "core/xml/format.h"

namespace forage::xml {
namespace {

AttributeRule text(std::string name, std::string doc, bool required = true) {
    return {std::move(name), ValueKind::text, required, std::move(doc), -1e300, 1e300, {}};
}
AttributeRule amount(std::string name, std::string doc, double low = 1) {
    return {std::move(name), ValueKind::whole, false, std::move(doc), low, 2e9, {}};
}
AttributeRule positive(std::string name, std::string doc) {
    return {std::move(name), ValueKind::number, false, std::move(doc), 1e-9, 1e9, {}};
}

constexpr int many = any_number;

Format make_table() {
    const AttributeRule parameter = text(
        "parameter", "'Process/Group.parameter', 'Process.parameter' of a module, 'Connection.parameter'");
    const std::vector<AttributeRule> manipulation = {
        text("group", "'Process/Group', whose activity it is"),
        text("cells", "a pattern: '(1,1)=0.5 (2,1)=1'", false),
        text("patterns", "a file with a list of patterns, as seen from this one", false),
        amount("every", "cycles from one pattern to the next"),
        amount("step", "only every so-manieth pattern of the list"),
        amount("times", "how often the list is played; for ever, if it does not say"),
        {"backwards", ValueKind::boolean, false, "from the last pattern to the first", 0, 1, {}},
        text("from", "a condition, when it begins", false),
        text("until", "a condition, when it ends", false)};
    return {
        {"experiment",
         "a system, run many times",
         {},
         {{"note"},
          {"system", 1, 1},
          {"world"},
          {"length", 1, 1},
          {"seeds"},
          {"set", 0, many},
          {"at", 0, many},
          {"clamp", 0, many},
          {"add", 0, many},
          {"multiply", 0, many},
          {"record", 0, many},
          {"plot", 0, many},
          {"measure", 0, many},
          {"sweep", 0, many}}},
        {"note", "a text for people", {}, {}, true},
        {"system", "what is run", {text("file", "an .iqr file, as seen from this one")}, {}},
        {"world",
         "where the robot lives",
         {text("file", "a .world file, as seen from this one"),
          positive("pace", "seconds of the world per second of the clock, instead of the world's own"),
          {"noise", ValueKind::boolean, false, "of motors and sensors", 0, 1, {}}},
         {}},
        {"length",
         "how long a run is: cycles, seconds or trials",
         {amount("cycles", "number of cycles"), positive("seconds", "seconds of the world"),
          amount("trials", "number of trials"),
          positive("longest-trial", "a run ends when a trial takes longer, in seconds of the world"),
          text("until", "a condition that ends a run before its time", false)},
         {}},
        {"seeds",
         "what decides everything random: every combination runs once with each",
         {amount("first", "the first seed", 0), amount("count", "how many, one after the other"),
          text("list", "or all of them, with blanks between", false)},
         {}},
        {"set", "a parameter in all runs", {parameter, text("value", "its value")}, {}},
        {"at",
         "a parameter that changes while the system runs",
         {text("when", "a condition; the change is made once, when it first holds"), parameter,
          text("value", "its new value")},
         {}},
        {"clamp", "patterns that a group's activity becomes, right after its update", manipulation, {}},
        {"add", "patterns that are added to a group's activity, right after its update", manipulation, {}},
        {"multiply",
         "patterns by which a group's activity is multiplied, right after its update",
         manipulation,
         {}},
        {"record",
         "a table of every run",
         {text("column", "'Process/Group' or 'Process/Group:state'"),
          amount("every", "only each k-th cycle")},
         {}},
        {"plot",
         "a picture of every run",
         {text("what",
               "'time:SOURCE', 'space:SOURCE@CYCLES', 'movie:SOURCE', 'connection:NAME', 'diagram' or "
               "'trajectory', as for --plot")},
         {}},
        {"measure",
         "a number that every run gives",
         {text("name", "its column in the table of results"),
          text("success", "share of the trials that reached the target: 'all', or 'last N' trials", false),
          text("duration", "mean seconds of a trial: of 'all', or of the 'last N' trials", false),
          text("first", "a condition: the number of cycles until it first held", false),
          text("final", "a cell, or mean, sum, min or max of a column, at the end", false)},
         {}},
        {"sweep",
         "a parameter that takes several values; several sweeps give every combination",
         {parameter, text("values", "with blanks between")},
         {}},
    };
}

}  // namespace

const Format& experiment_format() {
    static const Format table = make_table();
    return table;
}

}  // namespace forage::xml
